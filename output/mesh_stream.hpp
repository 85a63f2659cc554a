#pragma once

#include <algorithm>
#include <atomic>
#include <cstring>
#include <mutex>
#include <optional>
#include <vector>

#include "output/mesh_file.hpp"
#include <tbb/parallel_pipeline.h>

namespace relevo::output {

using Bytes = std::vector<std::byte>;

/// Adds a number as it lies in memory (little-endian, as every machine we run on).
template <class T>
void append(Bytes& bytes, T value) {
    const std::size_t size = bytes.size();
    bytes.resize(size + sizeof(T));
    std::memcpy(bytes.data() + size, &value, sizeof(T));
}

inline void append(Bytes& bytes, const std::string& text) {
    const auto* data = reinterpret_cast<const std::byte*>(text.data());
    bytes.insert(bytes.end(), data, data + text.size());
}

/// Calls make(i), which yields bytes, for all i in [0, count) on all cores, and use(bytes) in their order, a
/// few at a time in memory. Stops at the first failure of either.
template <class Make, class Use>
Result<void> in_order(std::size_t count, const Make& make, const Use& use) {
    struct Part {
        Result<Bytes> bytes;
    };
    std::size_t next = 0;
    std::atomic<bool> stopped = false;
    Result<void> outcome;
    const auto give = [&](tbb::flow_control& control) -> std::size_t {
        if (next == count || stopped) control.stop();
        return next++;
    };
    const auto work = [&](std::size_t i) { return std::make_shared<Part>(Part{make(i)}); };
    const auto take = [&](const std::shared_ptr<Part>& part) {
        if (stopped) return;
        Result<void> done = part->bytes ? use(*part->bytes) : Result<void>(part->bytes.error());
        if (done) return;
        outcome = done;
        stopped = true;
    };
    constexpr std::size_t kAtOnce = 16;
    tbb::parallel_pipeline(
        kAtOnce, tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, give) &
                     tbb::make_filter<std::size_t, std::shared_ptr<Part>>(tbb::filter_mode::parallel, work) &
                     tbb::make_filter<std::shared_ptr<Part>, void>(tbb::filter_mode::serial_in_order, take));
    return outcome;
}

/// Rows of posts that are dealt with together: about as many posts in all cases.
class RowBands {
  public:
    explicit RowBands(const lod::Raster<float>& heights)
        : rows_(heights.rows()), height_(std::max(1, (1 << 15) / heights.columns())) {}
    std::size_t count() const { return static_cast<std::size_t>((rows_ + height_ - 1) / height_); }
    int first(std::size_t band) const { return static_cast<int>(band) * height_; }
    int end(std::size_t band) const { return std::min(rows_, first(band) + height_); }

  private:
    int rows_;
    int height_;
};

/// Calls visit(place) for the vertices in a band of rows, in their order.
template <class Visit>
Result<void> for_each_vertex(const MeshFile& from, const RowBands& bands, std::size_t band,
                             const Visit& visit) {
    std::optional<Error> error;
    for (int row = bands.first(band); row < bands.end(band) && !error; ++row) {
        from.mesh.vertex_posts().for_each_in_row(row, [&](int column) {
            if (error) return;
            const auto place = from.places.at(column, row, from.heights.at(column, row));
            if (place) {
                visit(*place);
            } else {
                error = place.error();
            }
        });
    }
    if (error) return *error;
    return {};
}

/// Tells the progress from `begin` to `end` over a number of parts; fails where the export shall stop.
class PartsDone {
  public:
    PartsDone(const MeshFile& from, std::size_t count, double begin, double end)
        : from_(from), count_(count), begin_(begin), end_(end) {}
    Result<void> operator()() {
        const double part = static_cast<double>(++done_) / static_cast<double>(count_);
        if (from_.progress(begin_ + part * (end_ - begin_))) return {};
        return Error{ErrorKind::internal, "stopped: nothing was written"};
    }

  private:
    const MeshFile& from_;
    std::size_t count_;
    double begin_;
    double end_;
    std::size_t done_ = 0;
};

/// Writes encode(place, bytes) of every vertex.
template <class Encode>
Result<void> write_vertices(const MeshFile& from, PartialFile& file, const Encode& encode) {
    const RowBands bands(from.heights);
    PartsDone told(from, bands.count(), 0, 0.5);
    return in_order(
        bands.count(),
        [&](std::size_t band) -> Result<Bytes> {
            Bytes bytes;
            const auto done =
                for_each_vertex(from, bands, band, [&](const glm::dvec3& place) { encode(place, bytes); });
            if (!done) return done.error();
            return bytes;
        },
        [&](const Bytes& bytes) {
            const auto done = file.write(bytes);
            return done ? told() : done;
        });
}

/// Writes encode(numbers of the three vertices, bytes) of every triangle.
template <class Encode>
Result<void> write_triangles(const MeshFile& from, PartialFile& file, const Encode& encode) {
    // Batches are small (a thousand triangles, or two): some at a time are a good write.
    constexpr std::size_t kTogether = 16;
    const std::size_t count = (from.mesh.batches() + kTogether - 1) / kTogether;
    PartsDone told(from, count, 0.5, 1);
    return in_order(
        count,
        [&](std::size_t i) -> Result<Bytes> {
            Bytes bytes;
            std::vector<lod::PostTriangle> triangles;
            const std::size_t end = std::min(from.mesh.batches(), (i + 1) * kTogether);
            for (std::size_t batch = i * kTogether; batch < end; ++batch)
                from.mesh.append_batch(batch, triangles);
            for (const lod::PostTriangle& t : triangles) {
                encode(std::array<std::uint32_t, 3>{from.mesh.number(t[0]), from.mesh.number(t[1]),
                                                    from.mesh.number(t[2])},
                       bytes);
            }
            return bytes;
        },
        [&](const Bytes& bytes) {
            const auto done = file.write(bytes);
            return done ? told() : done;
        });
}

/// A value of `about` on one line.
inline std::string line_of(const nlohmann::ordered_json& value) {
    std::string text = value.is_string()
                           ? value.get<std::string>()
                           : value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < ' '; }, ' ');
    return text;
}

}  // namespace relevo::output
