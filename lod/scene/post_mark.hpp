#pragma once

#include <cstdint>

namespace relevo::lod {

/// What there is at a post. Validity is this and nothing else: no height is a code for void.
enum class PostClass : std::uint8_t { void_post = 0, land = 1, sea = 2 };

/// What is known of a post besides its height, in 16 bits: its class, whether its height was interpolated
/// over a void or modelled (a sea bed that nobody surveyed), and the source that it came from.
class PostMark {
  public:
    /// Sources beyond this many share one number, which means "not recorded".
    static constexpr int kUnknownSource = 0xfff;

    PostMark() = default;
    explicit PostMark(std::uint16_t bits) : bits_(bits) {}
    PostMark(PostClass post_class, int source)
        : bits_(static_cast<std::uint16_t>(
              static_cast<unsigned>(post_class) |
              static_cast<unsigned>(source < kUnknownSource ? source : kUnknownSource) << kSourceShift)) {}

    PostClass post_class() const { return static_cast<PostClass>(bits_ & kClassBits); }
    bool is_void() const { return post_class() == PostClass::void_post; }
    bool filled() const { return (bits_ & kFilledBit) != 0; }
    bool modelled() const { return (bits_ & kModelledBit) != 0; }
    /// Index in SceneInfo::sources, or kUnknownSource.
    int source() const { return bits_ >> kSourceShift; }

    void set_class(PostClass post_class) {
        bits_ = static_cast<std::uint16_t>((bits_ & ~kClassBits) | static_cast<unsigned>(post_class));
    }
    void set_filled() { bits_ |= kFilledBit; }
    void set_modelled() { bits_ |= kModelledBit; }

    std::uint16_t bits() const { return bits_; }
    friend bool operator==(const PostMark&, const PostMark&) = default;

  private:
    static constexpr unsigned kClassBits = 0x3;
    static constexpr unsigned kFilledBit = 0x4;
    static constexpr unsigned kModelledBit = 0x8;
    static constexpr int kSourceShift = 4;

    std::uint16_t bits_ = 0;  // a void of source 0
};

}  // namespace relevo::lod
