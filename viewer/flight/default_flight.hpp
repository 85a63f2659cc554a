#pragma once

#include "lod/measure/height_sampler.hpp"
#include "viewer/flight/flight_path.hpp"

namespace relevo::viewer {

/// A minute over a scene, for when there is no other flight: from the south at a height that goes with the
/// relief and the size of the data, gliding down to near the ground in the middle, low over it, round by a
/// half turn and up again. Distances and heights fall and grow by equal parts in equal times, so that the
/// ground goes by at a speed that fits the height. Heights are of the scene's own ground under the path.
Result<FlightPath> default_flight(lod::HeightSampler& sampler);

}  // namespace relevo::viewer
