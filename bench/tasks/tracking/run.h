#pragma once

#include <optional>
#include <vector>

#include "bench/tasks/tracking/options.h"
#include "bench/tasks/tracking/world.h"

namespace etude {

/// What a method makes of a motion, one entry per frame.
struct TrackingAnswer {
  std::vector<std::vector<double>> angles;  ///< radians
  std::optional<std::vector<int>> iterations;
};

/// Lets a solver follow the motion: every frame within the method's budget, from where its `start` says. A frame that
/// it did not solve is left as it is, and a warm one goes on from there. Fails, naming the frame, when the solver finds
/// fault with a problem.
Result<TrackingAnswer> Follow(const TrackingWorld& world, const TrackingMethod& method);

}  // namespace etude
