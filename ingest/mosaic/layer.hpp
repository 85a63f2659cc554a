#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "geo/result.hpp"
#include "ingest/mosaic/extent_index.hpp"
#include "ingest/mosaic/grid_map.hpp"
#include "ingest/reference/operation.hpp"
#include "ingest/resample/resample.hpp"
#include "ingest/source/source_pool.hpp"

namespace relevo::ingest {

/// A part of a layer in memory.
struct LayerPart {
    SourcePart posts;
    lod::Raster<std::uint16_t> sources;  ///< of each post; empty where all are of `source`
    int source = 0;

    /// The source of a post of the layer. \pre it is in the part
    int source_at(int column, int row) const {
        return sources.columns() == 0 ? source
                                      : sources.at(column - posts.window.column, row - posts.window.row);
    }
};

/// Sources on one lattice of posts (same CRS, steps and vertical datum, offsets of whole steps) as one
/// raster: interpolation goes on from one into the next, and where tiles share posts the first that is valid
/// counts.
class Layer {
  public:
    struct Member {
        int source = 0;
        Window window;  ///< of the layer's posts
    };

    /// \param members  in order of priority, in windows of the lattice; \pre not empty. The layer's own post
    /// (0, 0) is the north-west corner (in the lattice's sense) of them all
    Layer(const SourcePool& pool, const Affine& lattice, std::vector<Member> members,
          std::shared_ptr<const Operation> operation);

    /// Its first source's, for messages.
    const std::string& name() const { return pool_->facts(members_[0].source).name; }
    const Crs& crs() const { return *crs_; }
    const Operation& operation() const { return *operation_; }
    const Affine& posts() const { return posts_; }
    int columns() const { return columns_; }
    int rows() const { return rows_; }
    const std::vector<Member>& members() const { return members_; }
    const lod::VerticalReference& vertical() const {
        return pool_->facts(members_[0].source).heights.reference;
    }

    /// Columns of a full turn of longitudes where the layer goes all round the earth, else 0: its columns
    /// then are those modulo this.
    int turn() const { return turn_; }

    /// Is a place within half a post of the layer's posts?
    bool holds(Place p) const {
        return p.y >= -0.5 && p.y <= rows_ - 0.5 && (turn_ > 0 || (p.x >= -0.5 && p.x <= columns_ - 0.5));
    }

    /// Its posts and places on earth; of all of it, or of a member.
    SourceMap map() const { return {*operation_, *crs_, posts_, columns_, rows_}; }
    SourceMap map_of(const Member& member) const;

    /// Mean distance between its posts on the ground, metres; infinite where it has no place on earth.
    double spacing_m() const { return spacing_m_; }

    /// Has any member posts in the window?
    bool has_posts_in(Window window) const;

    /// Heights of a window, void = NaN, also outside the members.
    Result<LayerPart> read(Window window) const;

  private:
    /// A window cut where the columns of a full turn begin again, with the columns that each piece has in it.
    struct Piece {
        Window window;   ///< in [0, turn) x [0, rows)
        int column = 0;  ///< of the asked window
    };
    std::vector<Piece> pieces(Window window) const;
    Result<void> read_piece(const Piece& piece, LayerPart& into) const;

    const SourcePool* pool_;
    std::shared_ptr<const Crs> crs_;
    std::shared_ptr<const Operation> operation_;
    Affine posts_;
    int columns_ = 0;
    int rows_ = 0;
    int turn_ = 0;
    double spacing_m_ = 0;
    std::vector<Member> members_;
    ExtentIndex index_;
};

/// The layers of a mosaic, the most important first: by distance of posts (those within 2 % of each other in
/// the order of the inputs), or, where `in_order`, by the order of the inputs alone; then only sources that
/// follow each other become one layer.
Result<std::vector<Layer>> make_layers(const SourcePool& pool, bool in_order);

}  // namespace relevo::ingest
