#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relevo::lod {

/// Whole numbers, small ones in few bytes: seven bits a byte, the sign in the lowest bit.
class NumberWriter {
  public:
    void add(std::int64_t value) {
        auto bits = (static_cast<std::uint64_t>(value) << 1) ^ static_cast<std::uint64_t>(value >> 63);
        for (; bits > 0x7F; bits >>= 7) bytes_.push_back(static_cast<std::byte>(bits | 0x80));
        bytes_.push_back(static_cast<std::byte>(bits));
    }
    void add_bytes(std::span<const std::byte> bytes) {
        bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    }
    const std::vector<std::byte>& bytes() const { return bytes_; }

  private:
    std::vector<std::byte> bytes_;
};

class NumberReader {
  public:
    explicit NumberReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

    /// 0 and failed() from the first on that is not there.
    std::int64_t next() {
        std::uint64_t bits = 0;
        for (int shift = 0; shift < 64; shift += 7) {
            if (at_ == bytes_.size()) break;
            const auto byte = static_cast<std::uint64_t>(bytes_[at_++]);
            bits |= (byte & 0x7F) << shift;
            if (byte < 0x80)
                return static_cast<std::int64_t>(bits >> 1) ^ -static_cast<std::int64_t>(bits & 1);
        }
        failed_ = true;
        return 0;
    }
    /// None, and failed(), where there are fewer.
    std::span<const std::byte> next_bytes(std::size_t count) {
        if (count > bytes_.size() - at_) {
            failed_ = true;
            return {};
        }
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }
    bool failed() const { return failed_; }
    bool at_end() const { return at_ == bytes_.size(); }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
    bool failed_ = false;
};

}  // namespace relevo::lod
