#include <etude/fuzzy.h>

#include <cmath>

#include "engine/api/checks.h"
#include "engine/fuzzy/distance.h"
#include "engine/fuzzy/membership.h"
#include "engine/transitions/library/body_proportions.h"
#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/library/transition_points.h"

namespace etude::engine {
namespace {

Grades GradesOf(const PoseFeatures& features) {
  for (const double value : features.values) {
    if (!std::isfinite(value)) throw BadInput("a feature of the pose is not finite");
  }
  return Fuzzify(features);
}

}  // namespace

std::vector<PoseFeatures> ComputeFeatures(const BodyMotion& motion) {
  std::vector<PoseFeatures> features;
  if (Checked(motion).poses.empty()) return features;
  const double hips = StandingHipsOf(motion.poses.front());
  for (const BodyPose& pose : motion.poses) features.push_back(etude::ComputeFeatures(pose, hips));
  return features;
}

double FuzzyDistance(const PoseFeatures& a, const PoseFeatures& b) {
  return ComputeDistance(GradesOf(a), GradesOf(b), PaperWeights()).value;
}

struct Bridges::Library {
  std::vector<TaggedClip> tagged;
  MatchRules rules;

  const TaggedClip& Of(int clip) const {
    if (clip >= 0 && clip < static_cast<int>(tagged.size())) return tagged[clip];
    throw BadInput(fmt::format("clip {}; allowed: 0 to {}", clip, tagged.size() - 1));
  }
};

Bridges::Bridges(std::span<const BodyMotion> clips, const BridgeOptions& options)
    : library_(std::make_unique<Library>()) {
  if (options.min_clips < 1) throw BadInput(fmt::format("min_clips is {}; allowed: 1 or more", options.min_clips));
  if (!(options.threshold > 0 && options.threshold <= kFarthestFuzzy)) {
    throw BadInput(fmt::format("threshold is {}; allowed: above 0, up to {}", options.threshold, kFarthestFuzzy));
  }
  CheckClips(clips);
  StandingHipsOf(clips.front().poses.front());
  const BodyProportions proportions = MedianProportions(clips.front().poses);
  const double hips = proportions.standing_hip_height;
  TagRules rules;
  rules.min_clips = options.min_clips;
  library_->tagged = TagClips(PerformedBy(proportions, clips), hips, rules);
  library_->rules.threshold = options.threshold;
}

Bridges::Bridges(Bridges&&) noexcept = default;
Bridges& Bridges::operator=(Bridges&&) noexcept = default;
Bridges::~Bridges() = default;

std::span<const int> Bridges::FramesOf(int clip) const { return library_->Of(clip).bridge_frames; }

std::optional<TransitionPoint> Bridges::Find(int from, int frame, int to, double budget_s) const {
  const TaggedClip& playing = library_->Of(from);
  const TaggedClip& next = library_->Of(to);
  if (frame < 0 || frame >= playing.FrameCount()) {
    throw BadInput(fmt::format("found frame {} for clip {}; allowed: 0 to {}", frame, from, playing.FrameCount() - 1));
  }
  CheckBudget(budget_s);
  const auto found = FindTransitionPoint(playing, WaitWindow(playing, frame, budget_s), next, library_->rules);
  if (!found) return std::nullopt;
  return TransitionPoint{found->from, found->to, found->distance.value};
}

}  // namespace etude::engine
