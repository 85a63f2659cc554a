#pragma once

#include <vector>

#include "lod/lstr/number_stream.hpp"
#include "lod/lstr/planar_mesh.hpp"

namespace relevo::lod {

// Triangles as numbers, in their order. Two ways, of which a mesh has the one that makes it smaller:
//
// - a list: three numbers a triangle;
// - strips: a byte says which of the last 15 open edges a triangle continues from, and which of the last 14
//   vertices is its third corner; a number follows where it is none of them. So a strip may turn, and fan
//   out, and be gone on with after another (meshoptimizer codes edges so; Kapoulkine 2017). A triangle may
//   come back with another of its corners first.

void write_list(const std::vector<IndexTriangle>& triangles, NumberWriter& numbers);
void write_strips(const std::vector<IndexTriangle>& triangles, NumberWriter& numbers);

/// Fill a list of triangles. False where one has a corner that is no vertex.
bool read_list(NumberReader& numbers, std::int64_t vertices, std::vector<IndexTriangle>& triangles);
bool read_strips(NumberReader& numbers, std::int64_t vertices, std::vector<IndexTriangle>& triangles);

}  // namespace relevo::lod
