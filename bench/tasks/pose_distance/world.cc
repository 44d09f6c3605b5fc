#include "bench/tasks/pose_distance/world.h"

#include <cassert>
#include <initializer_list>

#include "engine/base/angles.h"
#include "engine/motion/body.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using enum SideControl;

struct Setting {
  SideControl control;
  double degrees;
};

/// Returns the controls of a standing body with these settings for its right limbs.
Controls Right(std::initializer_list<Setting> settings) {
  Controls controls;
  for (const Setting& setting : settings) controls.Of(Side::kRight, setting.control) = Radians(setting.degrees);
  return controls;
}

/// Returns the controls of a body that stands on its left leg, with these settings for its right leg.
Controls RightLeg(std::initializer_list<Setting> settings) {
  Controls controls = Right(settings);
  controls.Of(Side::kRight, kLegFree) = 1;
  return controls;
}

Controls BothArms(SideControl control, double degrees) {
  Controls controls = Right({{control, degrees}});
  controls.Of(Side::kLeft, control) = Radians(degrees);
  return controls;
}

Controls Twisted(double degrees) {
  Controls controls;
  controls[MiddleControl::kTrunkTurn] = Radians(degrees);
  return controls;
}

std::vector<BlindSpot> MakeBlindSpots() {
  return {
      {"arm forward or sideways", Right({{kArmForward, 90}}), Right({{kArmSide, 90}})},
      {"both arms forward or T", BothArms(kArmForward, 90), BothArms(kArmSide, 90)},
      {"elbow at 90°, hand up or down", Right({{kArmForward, 90}, {kElbow, 90}}),
       Right({{kArmForward, 90}, {kArmTwist, 180}, {kElbow, 90}})},
      {"straight leg at 40°, front or side", RightLeg({{kLegForward, 40}}), RightLeg({{kLegSide, 40}})},
      {"straight leg at 40° or 90°", RightLeg({{kLegForward, 40}}), RightLeg({{kLegForward, 90}})},
      {"knee bent by 90° or 120°", RightLeg({{kKnee, 90}}), RightLeg({{kKnee, 120}})},
      {"arm hanging or at 20°", Controls{}, Right({{kArmForward, 20}})},
      {"trunk twisted by 60°", Controls{}, Twisted(60)},
  };
}

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

std::span<const BlindSpot> BlindSpots() {
  static const std::vector<BlindSpot> spots = MakeBlindSpots();
  return spots;
}

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

bool HasTwoSources(const DancedClips& clips) {
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
