#include "engine/recognition/step_follower.h"

#include <algorithm>

namespace etude {

StepFollower::StepFollower(PoseParts parts, const SightWeights& weights, std::size_t moves, double rate_hz)
    : describer_(parts, weights, rate_hz), spotted_(moves, 0.0) {}

void StepFollower::Ask(std::optional<std::size_t> move) {
  asked_ = move;
  best_ = 0;
  Open(move);
}

Evidence StepFollower::Update(const SeenFrame& frame) {
  const int completed = describer_.Update(frame);
  if (completed > 0) std::ranges::fill(spotted_, 0.0);
  for (int i = 0; i < completed && describer_.Step(); ++i) {
    best_ = std::max(best_, Take(*describer_.Step(), spotted_));
  }
  return {.asked = best_, .spotted = spotted_};
}

}  // namespace etude
