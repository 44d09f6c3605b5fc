#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/tags_file/tags_file.h"

namespace etude {
namespace {

/// Returns degrees without the error of the conversion: 30, not 29.999999999999996.
double RoundedDegrees(double radians) {
  constexpr double kSteps = 1e9;
  return std::round(Degrees(radians) * kSteps) / kSteps;
}

}  // namespace

std::string MembershipsDigest(const FuzzySystem& system) {
  const FuzzySystem memberships_only{.memberships = system.memberships};
  return Digest().Add(WriteFuzzySystem(memberships_only)).Hex();
}

BridgeTags CollectTags(const TaggedLibrary& library, std::span<const std::string> sources, const FuzzySystem& system,
                       const TagRules& tag_rules, const MatchRules& match_rules) {
  // Store the rules.
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
  // Store each clip's bridge frames, then the keys of the in-betweens.
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

namespace {

constexpr double kRounding = 1e-9;

bool IsSame(const TaggedFrame& a, const TaggedFrame& b) {
  if (a.tags != b.tags || a.clips != b.clips || std::abs(a.difference - b.difference) > kRounding) return false;
  return std::equal(a.grades.begin(), a.grades.end(), b.grades.begin(),
                    [](double x, double y) { return std::abs(x - y) <= kRounding; });
}

void CompareClips(const ClipTags& file, const ClipTags& now, TagsComparison& comparison) {
  const std::string name = Quote(file.name);
  if (file.frames != now.frames || file.rate_hz != now.rate_hz) {
    comparison.differences.push_back(
        fmt::format("clip {} has {} frames at {} Hz in the file, but {} frames at {} Hz now", name, file.frames,
                    file.rate_hz, now.frames, now.rate_hz));
    return;
  }
  // Compare the bridge frames that are in both sets of tags, and report the others.
  std::map<int, const TaggedFrame*> frames_now;
  for (const TaggedFrame& frame : now.bridge_frames) frames_now[frame.frame] = &frame;
  for (const TaggedFrame& frame : file.bridge_frames) {
    const auto found = frames_now.find(frame.frame);
    if (found == frames_now.end()) {
      comparison.differences.push_back(fmt::format("clip {}: frame {} is no longer a bridge frame", name, frame.frame));
      continue;
    }
    ++comparison.bridge_frames;
    if (!IsSame(frame, *found->second)) {
      comparison.differences.push_back(
          fmt::format("clip {}: the tags or grades of frame {} are now different", name, frame.frame));
    }
    frames_now.erase(found);
  }
  for (const auto& [frame, tagged] : frames_now) {
    comparison.differences.push_back(fmt::format("clip {}: frame {} is now also a bridge frame", name, frame));
  }
}

}  // namespace

TagsComparison CompareTags(const BridgeTags& file, const BridgeTags& now) {
  TagsComparison comparison;
  // Compare the rules.
  const auto compare = [&](const char* what, const auto& in_file, const auto& found) {
    if (in_file != found) comparison.differences.push_back(fmt::format("{} is now different", what));
  };
  compare("the fuzzy system's name", file.system, now.system);
  compare("the set of membership functions", file.memberships_digest, now.memberships_digest);
  compare("the set of weights", file.weights, now.weights);
  compare("the body's height", file.standing_hip_height_m, now.standing_hip_height_m);

  // Report missing clips first, because without a clip other poses are frequent, so the other clips have other bridge
  // frames.
  std::map<std::string, const ClipTags*> clips_now;
  for (const ClipTags& clip : now.clips) clips_now[clip.name] = &clip;
  std::vector<std::pair<const ClipTags*, const ClipTags*>> in_both;
  for (const ClipTags& clip : file.clips) {
    const auto found = clips_now.find(clip.name);
    if (found == clips_now.end()) {
      comparison.differences.push_back(fmt::format("clip {} is only in the file", Quote(clip.name)));
      continue;
    }
    in_both.emplace_back(&clip, found->second);
    clips_now.erase(found);
  }
  for (const auto& [name, clip] : clips_now) {
    comparison.differences.push_back(fmt::format("clip {} is not in the file", Quote(name)));
  }
  comparison.clips = static_cast<int>(in_both.size());
  // Compare the clips that are in both sets of tags, then the keys.
  for (const auto& [clip, clip_now] : in_both) CompareClips(*clip, *clip_now, comparison);
  compare("the choice of keys", file.keys, now.keys);
  return comparison;
}

}  // namespace etude
