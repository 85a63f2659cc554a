#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <functional>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "geo/result.hpp"
#include "lod/background_thread.hpp"

namespace relevo::lod {

/// Loads pieces in threads of its own, the most urgent first. What it holds is bounded: each thread one piece
/// that it works on, and a few that nobody has taken yet. Its functions are for one thread.
template <class Key, class Piece>
class BackgroundLoader {
  public:
    /// \param load  called from several threads at a time
    BackgroundLoader(std::function<Result<Piece>(const Key&)> load, int threads) : load_(std::move(load)) {
        for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
    }
    ~BackgroundLoader() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        may_work_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }
    BackgroundLoader(const BackgroundLoader&) = delete;
    BackgroundLoader& operator=(const BackgroundLoader&) = delete;

    /// What shall be loaded, the most urgent first, instead of all that was asked for and is not begun.
    void request(std::vector<Key> keys) {
        {
            const std::lock_guard lock(mutex_);
            waiting_.clear();
            std::copy_if(keys.begin(), keys.end(), std::back_inserter(waiting_),
                         [&](const Key& key) { return !is_known(key); });
            if (waiting_.empty()) return;  // waking threads for nothing costs a small picture a tenth
        }
        may_work_.notify_all();
    }

    /// Is the piece asked for and not begun?
    bool is_waiting(const Key& key) {
        const std::lock_guard lock(mutex_);
        return std::find(waiting_.begin(), waiting_.end(), key) != waiting_.end();
    }

    struct Loaded {
        Key key;
        Result<Piece> piece;
    };
    /// A piece that is ready, in the order in which they became so; none if there is none now.
    std::optional<Loaded> take() {
        std::optional<Loaded> taken;
        {
            const std::lock_guard lock(mutex_);
            if (ready_.empty()) return std::nullopt;
            taken.emplace(std::move(ready_.front()));
            ready_.pop_front();
        }
        may_work_.notify_one();
        return taken;
    }
    /// Waits for one; none if nothing was asked for that has not been taken.
    std::optional<Loaded> wait() {
        {
            std::unique_lock lock(mutex_);
            something_ready_.wait(lock,
                                  [&] { return !ready_.empty() || (waiting_.empty() && begun_.empty()); });
        }
        return take();
    }

  private:
    static constexpr std::size_t kMostReady = 16;

    void work() {
        stand_back();
        std::unique_lock lock(mutex_);
        while (true) {
            // A piece that is begun will be ready: it counts.
            may_work_.wait(lock, [&] {
                return stopping_ || (!waiting_.empty() && ready_.size() + begun_.size() < kMostReady);
            });
            if (stopping_) return;
            const Key key = waiting_.front();
            waiting_.pop_front();
            begun_.push_back(key);
            lock.unlock();
            Result<Piece> piece = load_(key);
            lock.lock();
            begun_.erase(std::find(begun_.begin(), begun_.end(), key));
            ready_.push_back({key, std::move(piece)});
            something_ready_.notify_one();
        }
    }

    /// Begun, or ready.
    bool is_known(const Key& key) const {
        return std::find(begun_.begin(), begun_.end(), key) != begun_.end() ||
               std::any_of(ready_.begin(), ready_.end(),
                           [&](const Loaded& loaded) { return loaded.key == key; });
    }

    std::function<Result<Piece>(const Key&)> load_;
    std::mutex mutex_;
    std::condition_variable may_work_;
    std::condition_variable something_ready_;
    std::deque<Key> waiting_;
    std::vector<Key> begun_;
    std::deque<Loaded> ready_;
    bool stopping_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace relevo::lod
