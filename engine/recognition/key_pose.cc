#include "engine/recognition/key_pose.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/recognition/pose_sequence.h"
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

std::vector<std::optional<int>> WhenReached(std::span<const TaughtPose> poses, std::span<const FeatureFrame> frames,
                                            const SightWeights& weights, const KeyPoseOptions& options) {
  constexpr double kMet = 0.5;
  std::vector<std::optional<int>> reached;
  for (std::size_t count = 1; count <= poses.size(); ++count) {
    PoseSequence sequence(count, options.hold_frames, 0);
    sequence.Open();
    auto& when = reached.emplace_back();
    for (std::size_t frame = 0; frame < frames.size() && !when; ++frame) {
      std::vector<double> matches;
      for (std::size_t k = 0; k < count && frames[frame].body_seen; ++k) {
        matches.push_back(MatchOf(frames[frame], poses[k], weights, options));
      }
      sequence.Update(matches);
      if (sequence.Asked() >= kMet) when = static_cast<int>(frame);
    }
  }
  return reached;
}

}  // namespace etude
