#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace relevo::lod {

/// A vertex as it goes to the GPU.
struct MeshVertex {
    float x, y, z;         ///< drawn position relative to the eye, ECEF axes, metres
    std::uint16_t column;  ///< place in the padded grid
    std::uint16_t row;
};

/// Leaves numbers unset where a vector grows: meshes are made anew every frame, and filling them with zeros
/// first would take as long as a tenth of making them.
template <class T>
struct UnsetAllocator : std::allocator<T> {
    template <class U>
    struct rebind {
        using other = UnsetAllocator<U>;
    };
    template <class U>
    void construct(U* at) {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U{std::forward<Arguments>(arguments)...};
    }
};

/// A drawn mesh: indexed triangles, counter-clockwise seen from above. The last index of a triangle is its
/// newest vertex (the right angle), so that flat attributes can show its level.
struct Mesh {
    using Vertices = std::vector<MeshVertex, UnsetAllocator<MeshVertex>>;
    using Indices = std::vector<std::uint32_t, UnsetAllocator<std::uint32_t>>;

    Vertices vertices;
    Indices indices;

    std::size_t triangles() const { return indices.size() / 3; }
    void clear() {
        vertices.clear();
        indices.clear();
    }
};

}  // namespace relevo::lod
