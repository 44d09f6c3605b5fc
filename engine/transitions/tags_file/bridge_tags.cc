#include "engine/transitions/tags_file/bridge_tags.h"

#include <cmath>

#include "engine/base/digest.h"
#include "engine/transitions/bridge_frames/frame_ratings.h"

namespace etude {
namespace {

/// 30, not 29.999999999999996.
double RoundedDegrees(double radians) {
  constexpr double kSteps = 1e9;
  return std::round(Degrees(radians) * kSteps) / kSteps;
}

}  // namespace

std::string MembershipsDigest(const FuzzySystem& system) {
  const FuzzySystem memberships_only{.memberships = system.memberships};
  return Digest().Add(WriteFuzzySystem(memberships_only)).Hex();
}

BridgeTags CollectTags(const MotionLibrary& library, std::span<const std::string> sources, const FuzzySystem& system,
                       const TagRules& tag_rules, const MatchRules& match_rules) {
  BridgeTags tags{.system = system.name,
                  .memberships_digest = MembershipsDigest(system),
                  .weights = match_rules.weights,
                  .threshold = match_rules.threshold,
                  .within_class = match_rules.within_class,
                  .min_clips = tag_rules.min_clips,
                  .most_per_class = tag_rules.most_per_class,
                  .max_neck_bend_deg = RoundedDegrees(tag_rules.head.max_bend),
                  .max_neck_turn_deg_per_s = RoundedDegrees(tag_rules.head.max_turn_speed),
                  .standing_hip_height_m = library.proportions.standing_hip_height,
                  .clips = {},
                  .keys = {}};
  const std::vector<std::vector<FrameRating>> ratings = RateFrames(library.tagged, match_rules.weights);
  for (std::size_t c = 0; c < library.tagged.size(); ++c) {
    const TaggedClip& clip = library.tagged[c];
    ClipTags& of_clip = tags.clips.emplace_back();
    of_clip.name = library.names[c];
    of_clip.source = sources[c];
    of_clip.frames = clip.FrameCount();
    of_clip.rate_hz = clip.rate_hz;
    for (int frame : clip.bridge_frames) {
      const FrameRating& rating = ratings[c][frame];
      of_clip.bridge_frames.push_back({.frame = frame,
                                       .tags = clip.tags[frame],
                                       .grades = clip.grades[frame],
                                       .clips = rating.clips,
                                       .difference = rating.difference});
    }
  }
  for (const InBetweenNet::Key& key : library.in_betweens.keys) {
    tags.keys.push_back({library.names[key.clip], key.frame});
  }
  return tags;
}

}  // namespace etude
