#include "lod/scene/deflate.hpp"

#include <memory>
#include <new>

#include <cpl_conv.h>
#include <fmt/format.h>

namespace relevo::lod {

std::vector<std::byte> deflated(std::span<const std::byte> bytes) {
    constexpr int kUsualLevel = 6;
    std::size_t size = 0;
    const std::unique_ptr<void, decltype(&VSIFree)> made(
        CPLZLibDeflate(bytes.data(), bytes.size(), kUsualLevel, nullptr, 0, &size), VSIFree);
    if (!made) throw std::bad_alloc();  // it fails for no other reason
    const auto* first = static_cast<const std::byte*>(made.get());
    return {first, first + size};
}

Result<std::vector<std::byte>> inflated(std::span<const std::byte> bytes, std::size_t size,
                                        const std::string& name) {
    std::vector<std::byte> made(size);
    std::size_t got = 0;
    if (CPLZLibInflate(bytes.data(), bytes.size(), made.data(), made.size(), &got) == nullptr || got != size)
        return Error{ErrorKind::damaged, fmt::format("{}: cannot be decompressed", name)};
    return made;
}

}  // namespace relevo::lod
