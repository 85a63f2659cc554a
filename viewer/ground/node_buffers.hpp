#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "lod/lstr/chunk_picture.hpp"
#include "lod/view.hpp"
#include "viewer/gl/gl_object.hpp"

namespace relevo::viewer {

/// Keeps the quadtree's nodes in graphics memory, as they are drawn beside finer ones or not. What is sent
/// each frame is what was not drawn lately, and how far each node has moved (shaders/terrain.vert with
/// NODES).
class NodeBuffers {
  public:
    /// Of a vertex, with what it moves with.
    static constexpr std::size_t kVertexBytes = sizeof(lod::PlacedChunk::Vertex) + sizeof(std::uint8_t);

    NodeBuffers();

    /// Sends what a picture has and is not there; it is drawn until the next one comes. Lets go of what was
    /// drawn the longest ago, beyond as much again as this picture draws.
    void upload(const lod::ChunkPicture& picture);

    bool empty() const { return drawn_.empty(); }

    /// Draws, one call a node, in the picture's order. \pre a program with NODES is in use
    /// \return  calls
    int draw(const lod::View& view) const;

    struct Figures {
        std::size_t nodes = 0;
        std::uint64_t bytes = 0;
        std::uint64_t sent_bytes = 0;  ///< for the last picture
    };
    const Figures& figures() const { return figures_; }

  private:
    /// A node beside finer ones has their vertices on its sides too.
    struct Key {
        lod::ChunkId id;
        std::array<bool, lod::kSides> beside_finer{};
        friend auto operator<=>(const Key&, const Key&) = default;
    };
    struct Node {
        GlBuffer buffer;  ///< vertices, the part of each, indices
        std::uint64_t bytes = 0;
        std::intptr_t parts_at = 0;
        std::intptr_t indices_at = 0;
        int index_count = 0;
        std::uint64_t last_drawn = 0;
    };
    struct Drawn {
        const Node* node = nullptr;
        float moved = 0;
        std::array<float, lod::kSides> moved_on_side{};
    };

    static Node send(const lod::SelectedChunk& chunk);
    void make_room(std::uint64_t drawn_bytes);

    GlVertexArray vertex_array_;
    std::map<Key, Node> nodes_;
    std::vector<Drawn> drawn_;
    lod::FixedFrame frame_;
    std::uint64_t edition_ = 0;
    std::uint64_t pictures_ = 0;
    Figures figures_;
};

}  // namespace relevo::viewer
