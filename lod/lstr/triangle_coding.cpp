#include "lod/lstr/triangle_coding.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace relevo::lod {

namespace {

/// The last few of something, the latest first.
template <class T, std::size_t kMost>
class Latest {
  public:
    std::size_t size() const { return size_; }
    const T& operator[](std::size_t i) const { return kept_[i]; }
    void push(const T& value) {
        size_ = std::min(size_ + 1, kMost);
        std::copy_backward(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(size_ - 1),
                           kept_.begin() + static_cast<std::ptrdiff_t>(size_));
        kept_[0] = value;
    }
    void erase(std::size_t i) {
        std::copy(kept_.begin() + static_cast<std::ptrdiff_t>(i + 1),
                  kept_.begin() + static_cast<std::ptrdiff_t>(size_),
                  kept_.begin() + static_cast<std::ptrdiff_t>(i));
        --size_;
    }
    /// size(): it is not there.
    std::size_t find(const T& value) const {
        return static_cast<std::size_t>(
            std::find(kept_.begin(), kept_.begin() + static_cast<std::ptrdiff_t>(size_), value) -
            kept_.begin());
    }

  private:
    std::array<T, kMost> kept_{};
    std::size_t size_ = 0;
};

/// What a triangle may continue from. Writing and reading go through the same states.
struct Recent {
    using Edge = std::array<std::uint32_t, 2>;  // as the triangle that continues from it has it
    Latest<Edge, 15> edges;
    Latest<std::uint32_t, 14> vertices;

    void touch(std::uint32_t vertex) {
        const std::size_t known = vertices.find(vertex);
        if (known < vertices.size()) vertices.erase(known);
        vertices.push(vertex);
    }
    void begin(const IndexTriangle& t) {
        for (std::size_t i = 0; i < 3; ++i) edges.push({t[(i + 1) % 3], t[i]});
        for (const std::uint32_t v : t) touch(v);
    }
    void go_on(std::size_t edge, std::uint32_t third) {
        const auto [a, b] = edges[edge];
        edges.erase(edge);
        edges.push({third, b});
        edges.push({a, third});
        touch(third);
    }
};

// A byte: the edge in the upper half, the third corner in the lower one.
constexpr std::size_t kOtherVertex = 14;
constexpr std::size_t kNoEdge = 15;

}  // namespace

void write_list(const std::vector<IndexTriangle>& triangles, NumberWriter& numbers) {
    std::int64_t last_a = 0;
    for (const auto& [a, b, c] : triangles) {
        numbers.add(static_cast<std::int64_t>(a) - last_a);
        numbers.add(static_cast<std::int64_t>(b) - a);
        numbers.add(static_cast<std::int64_t>(c) - b);
        last_a = a;
    }
}

bool read_list(NumberReader& numbers, std::int64_t vertices, std::vector<IndexTriangle>& triangles) {
    const auto is_vertex = [&](std::int64_t i) { return i >= 0 && i < vertices; };
    std::int64_t a = 0;
    for (IndexTriangle& t : triangles) {
        a += numbers.next();
        const std::int64_t b = a + numbers.next();
        const std::int64_t c = b + numbers.next();
        if (!is_vertex(a) || !is_vertex(b) || !is_vertex(c)) return false;
        t = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
    }
    return true;
}

void write_strips(const std::vector<IndexTriangle>& triangles, NumberWriter& numbers) {
    std::vector<std::byte> steps;
    steps.reserve(triangles.size());
    NumberWriter others;
    Recent recent;
    std::int64_t last_begin = 0;
    for (const IndexTriangle& t : triangles) {
        std::size_t edge = recent.edges.size();
        std::size_t third = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t known = recent.edges.find({t[i], t[(i + 1) % 3]});
            if (known >= edge) continue;
            edge = known;
            third = t[(i + 2) % 3];
        }
        if (edge == recent.edges.size()) {
            steps.push_back(static_cast<std::byte>(kNoEdge << 4));
            others.add(t[0] - last_begin);
            others.add(static_cast<std::int64_t>(t[1]) - t[0]);
            others.add(static_cast<std::int64_t>(t[2]) - t[0]);
            last_begin = t[0];
            recent.begin(t);
            continue;
        }
        const auto vertex = static_cast<std::uint32_t>(third);
        std::size_t known = recent.vertices.find(vertex);
        if (known == recent.vertices.size()) {
            known = kOtherVertex;
            others.add(static_cast<std::int64_t>(vertex) - recent.edges[edge][1]);
        }
        steps.push_back(static_cast<std::byte>(edge << 4 | known));
        recent.go_on(edge, vertex);
    }
    numbers.add_bytes(steps);
    numbers.add_bytes(others.bytes());
}

bool read_strips(NumberReader& numbers, std::int64_t vertices, std::vector<IndexTriangle>& triangles) {
    const std::span<const std::byte> steps = numbers.next_bytes(triangles.size());
    if (numbers.failed()) return false;
    const auto is_vertex = [&](std::int64_t i) { return i >= 0 && i < vertices; };
    Recent recent;
    std::int64_t a = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto edge = static_cast<std::size_t>(steps[i]) >> 4;
        const auto known = static_cast<std::size_t>(steps[i]) & 15;
        IndexTriangle& t = triangles[i];
        if (edge == kNoEdge) {
            a += numbers.next();
            const std::int64_t b = a + numbers.next();
            const std::int64_t c = a + numbers.next();
            if (!is_vertex(a) || !is_vertex(b) || !is_vertex(c)) return false;
            t = {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
            recent.begin(t);
            continue;
        }
        if (edge >= recent.edges.size() || known > kOtherVertex) return false;
        std::uint32_t third = 0;
        if (known == kOtherVertex) {
            const std::int64_t other = recent.edges[edge][1] + numbers.next();
            if (!is_vertex(other)) return false;
            third = static_cast<std::uint32_t>(other);
        } else {
            if (known >= recent.vertices.size()) return false;
            third = recent.vertices[known];
        }
        t = {recent.edges[edge][0], recent.edges[edge][1], third};
        recent.go_on(edge, third);
    }
    return true;
}

}  // namespace relevo::lod
