#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace relevo::lod {

/// Reads the fields of a JSON object that may be damaged: every value is checked for presence, type and
/// range. The first thing that is wrong is kept in `problem` and the rest of the values are empty, so that
/// one test at the end is enough.
class JsonFields {
  public:
    /// \param where    of the object, for messages: "frame", "heights[3]"
    /// \param problem  shared by all objects of a document
    JsonFields(const nlohmann::json& object, std::string where, std::string& problem)
        : object_(object), where_(std::move(where)), problem_(problem) {
        if (!object_.is_object()) wrong("is not an object");
    }

    double number(const char* key, double low = -std::numeric_limits<double>::max(),
                  double high = std::numeric_limits<double>::max()) {
        const nlohmann::json* value = find(key);
        if (value == nullptr) return 0;
        if (!value->is_number()) return wrong(key, "is not a number"), 0;
        const double result = value->get<double>();
        if (!(result >= low && result <= high)) return wrong(key, "is out of range"), 0;
        return result;
    }

    std::optional<double> optional_number(const char* key) {
        const nlohmann::json* value = find(key);
        if (value == nullptr || value->is_null()) return std::nullopt;
        return number(key);
    }

    std::uint64_t count(const char* key, std::uint64_t high = std::numeric_limits<std::uint64_t>::max()) {
        const nlohmann::json* value = find(key);
        if (value == nullptr) return 0;
        const bool negative =
            !value->is_number_unsigned() && value->is_number_integer() && value->get<std::int64_t>() < 0;
        if (!value->is_number_integer() || negative) return wrong(key, "is not a whole number from 0 on"), 0;
        const auto result = value->get<std::uint64_t>();
        if (result > high) return wrong(key, "is out of range"), 0;
        return result;
    }

    int integer(const char* key, int low, int high) {
        const auto result = static_cast<int>(count(key, static_cast<std::uint64_t>(high)));
        if (result < low) wrong(key, "is out of range");
        return result;
    }

    std::string text(const char* key) {
        const nlohmann::json* value = find(key);
        if (value == nullptr) return {};
        if (!value->is_string()) return wrong(key, "is not text"), std::string{};
        return value->get<std::string>();
    }

    std::vector<std::string> texts(const char* key) {
        const nlohmann::json* value = find(key);
        if (value == nullptr) return {};
        const bool right = value->is_array() && std::all_of(value->begin(), value->end(),
                                                            [](const auto& one) { return one.is_string(); });
        if (!right) return wrong(key, "is not a list of texts"), std::vector<std::string>{};
        return value->get<std::vector<std::string>>();
    }

    bool flag(const char* key) {
        const nlohmann::json* value = find(key);
        if (value == nullptr) return false;
        if (!value->is_boolean()) return wrong(key, "is neither true nor false"), false;
        return value->get<bool>();
    }

    bool is_null(const char* key) {
        const nlohmann::json* value = find(key);
        return value == nullptr || value->is_null();
    }

    /// Calls read(JsonFields&) for each object of a list.
    template <class Read>
    void each(const char* key, const Read& read) {
        const nlohmann::json* value = find(key);
        if (value == nullptr) return;
        if (!value->is_array()) return wrong(key, "is not a list");
        for (std::size_t i = 0; i < value->size() && problem_.empty(); ++i) {
            JsonFields fields((*value)[i], fmt::format("{}[{}]", path(key), i), problem_);
            read(fields);
        }
    }

    /// The object under a key.
    JsonFields object(const char* key) {
        static const nlohmann::json kNone = nlohmann::json::object();
        const nlohmann::json* value = find(key);
        return {value == nullptr ? kNone : *value, path(key), problem_};
    }

    /// Records what is wrong with a value that is well-formed but makes no sense.
    void wrong(const char* key, const std::string& what) {
        if (problem_.empty()) problem_ = fmt::format("{} {}", path(key), what);
    }

  private:
    void wrong(const std::string& what) {
        if (problem_.empty()) problem_ = fmt::format("{} {}", where_.empty() ? "the document" : where_, what);
    }

    std::string path(const char* key) const { return where_.empty() ? key : where_ + "." + key; }

    const nlohmann::json* find(const char* key) {
        if (!problem_.empty()) return nullptr;
        const auto found = object_.find(key);
        if (found == object_.end()) {
            wrong(key, "is missing");
            return nullptr;
        }
        return &*found;
    }

    const nlohmann::json& object_;
    std::string where_;
    std::string& problem_;
};

}  // namespace relevo::lod
