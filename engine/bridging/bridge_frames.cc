#include "engine/bridging/bridge_frames.h"

#include <cmath>
#include <cstdint>
#include <map>

namespace etude {
namespace {

using enum Role;

/// The unit direction of the neck in the trunk's own frame (left, up, front), so that a body that
/// turns as a whole keeps its head still.
glm::dvec3 NeckInTrunk(const BodyPose& pose) {
  const auto unit = [](const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0 ? v / length : glm::dvec3(0);
  };
  const glm::dvec3 up = unit(pose[kShoulderCentre] - pose[kHipCentre]);
  const glm::dvec3 across = pose[kLeftShoulder] - pose[kRightShoulder];
  const glm::dvec3 left = unit(across - glm::dot(across, up) * up);
  const glm::dvec3 neck = unit(pose[kHead] - pose[kShoulderCentre]);
  return {glm::dot(neck, left), glm::dot(neck, up), glm::dot(neck, glm::cross(left, up))};
}

/// The ten tags as one number; no feature has more than four terms.
std::uint32_t TagKey(const Tags& tags) {
  std::uint32_t key = 0;
  for (std::uint8_t tag : tags) key = key * 4 + tag;
  return key;
}

struct Occurrence {
  int clips = 0;
  std::size_t last_clip = 0;
};

/// In how many clips each combination of tags occurs.
std::map<std::uint32_t, Occurrence> CountClips(const std::vector<TaggedClip>& clips) {
  std::map<std::uint32_t, Occurrence> occurrences;
  for (std::size_t c = 0; c < clips.size(); ++c) {
    for (const Tags& tags : clips[c].tags) {
      Occurrence& occurrence = occurrences[TagKey(tags)];
      if (occurrence.clips > 0 && occurrence.last_clip == c) continue;
      ++occurrence.clips;
      occurrence.last_clip = c;
    }
  }
  return occurrences;
}

}  // namespace

std::vector<bool> FindQuietHeads(const BodyMotion& motion, const HeadRule& rule) {
  const int count = static_cast<int>(motion.poses.size());
  std::vector<glm::dvec3> necks;
  necks.reserve(motion.poses.size());
  for (const BodyPose& pose : motion.poses) necks.push_back(NeckInTrunk(pose));
  std::vector<bool> quiet(motion.poses.size());
  for (int f = 0; f < count; ++f) {
    const int before = std::max(f - 1, 0), after = std::min(f + 1, count - 1);
    const double seconds = (after - before) / motion.rate_hz;
    const double turned = AngleBetween(necks[before], necks[after]);
    const double bend = AngleBetween(necks[f], {0, 1, 0});
    quiet[f] = bend <= rule.max_bend && turned <= rule.max_turn_speed * seconds;
  }
  return quiet;
}

std::vector<TaggedClip> TagClips(std::span<const BodyMotion> clips, double standing_hip_height, const TagRules& rules) {
  std::vector<TaggedClip> tagged;
  tagged.reserve(clips.size());
  for (const BodyMotion& motion : clips) {
    TaggedClip& clip = tagged.emplace_back();
    clip.rate_hz = motion.rate_hz;
    for (const BodyPose& pose : motion.poses) {
      clip.grades.push_back(Fuzzify(ComputeFeatures(pose, standing_hip_height), rules.memberships));
      clip.tags.push_back(ChooseTags(clip.grades.back()));
    }
  }
  const std::map<std::uint32_t, Occurrence> occurrences = CountClips(tagged);
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const std::vector<bool> quiet = FindQuietHeads(clips[c], rules.head);
    for (int f = 0; f < tagged[c].FrameCount(); ++f) {
      const bool is_frequent = occurrences.at(TagKey(tagged[c].tags[f])).clips >= rules.min_clips;
      if (quiet[f] && is_frequent) tagged[c].bridge_frames.push_back(f);
    }
  }
  return tagged;
}

}  // namespace etude
