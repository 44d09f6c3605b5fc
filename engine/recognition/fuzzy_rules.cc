#include "engine/recognition/fuzzy_rules.h"

#include <algorithm>

#include "engine/recognition/pose_sequence_recogniser.h"

namespace etude {
namespace {

/// Of the feature's terms, at two inputs.
double Overlap(Feature feature, double seen, double taught, const Memberships& memberships) {
  const Universe& universe = memberships.universes[static_cast<std::size_t>(feature)];
  const std::size_t first = FirstTermOf(feature), last = first + TermsOf(feature).size();
  double common = 0, all = 0;
  for (std::size_t term = first; term < last; ++term) {
    const Shape& shape = memberships.shapes[term];
    const double a = GradeOf(shape, std::clamp(seen, universe.low, universe.high));
    const double b = GradeOf(shape, std::clamp(taught, universe.low, universe.high));
    common += std::min(a, b);
    all += std::max(a, b);
  }
  return all > 0 ? common / all : 1.0;
}

}  // namespace

double RuleStrength(const FeatureFrame& frame, const TaughtPose& pose, const SightWeights& weights,
                    const Memberships& memberships) {
  double strength = 1, most = 0;
  for (const PoseTarget& target : pose.targets) {
    const double weight = weights.Of(frame.StateOf(target.feature));
    const double overlap = Overlap(target.feature, frame.features[target.feature], target.degrees, memberships);
    strength = std::min(strength, std::max(overlap, 1.0 - weight));
    most = std::max(most, weight);
  }
  return most > 0 ? strength : 0.0;
}

std::unique_ptr<Recogniser> MakeFuzzyRulesRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                     const FuzzyRulesOptions& options) {
  return MakePoseSequenceRecogniser(taught, options.hold_frames,
                                    [weights](const FeatureFrame& frame, const TaughtPose& pose) {
                                      return RuleStrength(frame, pose, weights, PaperMemberships());
                                    });
}

}  // namespace etude
