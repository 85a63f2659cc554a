#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>

namespace relevo {

/// What went wrong, as far as a caller may want to tell it apart. The command line turns it into an exit
/// status.
enum class ErrorKind {
    usage,     ///< the request itself makes no sense (exit status 2)
    input,     ///< an input cannot be used as it is (exit status 3)
    damaged,   ///< a scene is damaged (exit status 4)
    internal,  ///< anything else: the machine, the disk, a bug (exit status 1)
};

/// A failure as a value. The message is for people: which file, what is wrong, what to do.
struct Error {
    ErrorKind kind = ErrorKind::internal;
    std::string message;
};

/// Either a value or the reason why there is none. Bad data is reported with it; misuse is an assertion.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    explicit operator bool() const { return state_.index() == 0; }

    /// \pre the result holds a value
    T& operator*() & { return value(); }
    const T& operator*() const& { return const_cast<Result*>(this)->value(); }
    T&& operator*() && { return std::move(value()); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &const_cast<Result*>(this)->value(); }

    /// \pre the result holds an error
    const Error& error() const {
        assert(state_.index() == 1);
        return *std::get_if<1>(&state_);
    }

  private:
    T& value() {
        assert(state_.index() == 0);
        return *std::get_if<0>(&state_);
    }

    std::variant<T, Error> state_;
};

/// The result of an action that yields nothing but may fail: `return {};` is success.
template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : error_(std::move(error)), failed_(true) {}

    explicit operator bool() const { return !failed_; }

    /// \pre the result holds an error
    const Error& error() const {
        assert(failed_);
        return error_;
    }

  private:
    Error error_;
    bool failed_ = false;
};

}  // namespace relevo
