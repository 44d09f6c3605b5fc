#include "engine/recognition/key_pose.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/recognition/pose_sequence_recogniser.h"

namespace etude {

double MatchOf(const FeatureFrame& frame, const TaughtPose& pose, const SightWeights& weights,
               const KeyPoseOptions& options) {
  struct Angle {
    double error;  // of its tolerance
    double weight;
  };
  std::array<Angle, kFeatureCount> angles;
  assert(pose.targets.size() <= angles.size());
  double total = 0;
  std::size_t count = 0;
  for (const PoseTarget& target : pose.targets) {
    const double tolerance = target.tolerance_deg * options.tolerance_scale;
    const double weight = weights.Of(frame.StateOf(target.feature));
    angles[count++] = {std::abs(frame.features[target.feature] - target.degrees) / tolerance, weight};
    total += weight;
  }
  if (!(total > 0)) return 0.0;
  std::sort(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Angle& a, const Angle& b) { return a.error < b.error; });
  constexpr double kRounding = 1e-9;  // a share of exactly the one wanted counts, whatever the weights
  double within = 0, factor = 0;
  for (std::size_t i = 0; i < count && within < (options.pose_share - kRounding) * total; ++i) {
    within += angles[i].weight;
    factor = angles[i].error;
  }
  return 1.0 / (1.0 + factor * factor);
}

std::unique_ptr<Recogniser> MakeKeyPoseRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                  const KeyPoseOptions& options) {
  return MakePoseSequenceRecogniser(taught, options.hold_frames,
                                    [weights, options](const FeatureFrame& frame, const TaughtPose& pose) {
                                      return MatchOf(frame, pose, weights, options);
                                    });
}

}  // namespace etude
