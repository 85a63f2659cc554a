#pragma once

namespace relevo::lod {

/// Which object-space error drives the refinement.
enum class ErrorMetric { bounded, incremental };

}  // namespace relevo::lod
