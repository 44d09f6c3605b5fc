#include "bench/tasks/pose_distance/world.h"

#include <algorithm>
#include <cassert>
#include <functional>

#include "bench/tasks/pose_distance/blind_spots.h"
#include "engine/transitions/alignment.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

SeenPair MakePair(const BodyPose& a, const BodyPose& b, double standing_hip_height) {
  return {{a, ComputeFeatures(a, standing_hip_height)}, {b, ComputeFeatures(b, standing_hip_height)}, PoseGap(a, b)};
}

const BodyPose& DrawFrame(const BodyMotion& motion, RandomStream& dice) {
  return motion.poses[dice.IndexBelow(motion.poses.size())];
}

std::pair<std::size_t, std::size_t> DrawClips(const DancedClips& clips, int trial, RandomStream& dice) {
  const std::size_t first = static_cast<std::size_t>(trial) % clips.motions.size();
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < clips.motions.size(); ++i) {
    if (clips.identities[i] != clips.identities[first]) others.push_back(i);
  }
  assert(!others.empty());
  return {first, others[dice.IndexBelow(others.size())]};
}

}  // namespace

DancedClips DanceClips(const ClipLibrary& library) {
  const BodyPose standing = PoseOf(Controls{});
  DancedClips clips{.proportions = MakeBodyProportions(standing, StandingHipHeight(standing)),
                    .names = {},
                    .identities = {},
                    .motions = {}};
  std::vector<BodyMotion> motions;
  for (const LibraryClip& clip : library.clips) {
    clips.names.push_back(clip.name);
    clips.identities.push_back(clip.source);
    motions.push_back(clip.motion);
  }
  clips.motions = PerformedBy(clips.proportions, motions);
  return clips;
}

bool HoldsTwoDances(const DancedClips& clips) {
  return std::adjacent_find(clips.identities.begin(), clips.identities.end(), std::not_equal_to<>()) !=
         clips.identities.end();
}

PairWorld ShowBlindSpot(int trial) {
  const BlindSpot& spot = BlindSpots()[static_cast<std::size_t>(trial) % BlindSpots().size()];
  const double standing_hip_height = StandingHipHeight(PoseOf(Controls{}));
  return {std::string(spot.name), "", "", {MakePair(PoseOf(spot.a), PoseOf(spot.b), standing_hip_height)}};
}

std::pair<std::size_t, std::size_t> DrawClips(const DancedClips& clips, const WorldKey& key) {
  RandomStream dice(key, "pose-pairs");
  return DrawClips(clips, key.trial, dice);
}

PairWorld DrawFramePairs(const DancedClips& clips, int count, const WorldKey& key) {
  RandomStream dice(key, "pose-pairs");
  const auto [first, second] = DrawClips(clips, key.trial, dice);
  PairWorld world{.name = "", .clip_a = clips.identities[first], .clip_b = clips.identities[second], .pairs = {}};
  for (int i = 0; i < count; ++i) {
    const BodyPose& a = DrawFrame(clips.motions[first], dice);
    const BodyPose& b = DrawFrame(clips.motions[second], dice);
    world.pairs.push_back(MakePair(a, b, clips.proportions.standing_hip_height));
  }
  return world;
}

}  // namespace etude
