#include "engine/transitions/library/in_betweens.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/base/directions.h"
#include "engine/base/smoothstep.h"
#include "engine/motion/body.h"
#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/search/grade_blocks.h"

namespace etude {
namespace {

using enum Role;

/// The largest slope of Smootherstep, at its middle.
constexpr double kPeakSlope = 1.875;

/// Returns the frame of the upper body, with the axes left, up and front.
glm::dquat TrunkFrame(const BodyPose& pose) {
  const glm::dvec3 up = UnitOr(pose[kShoulderCentre] - pose[kHipCentre], {0, 1, 0});
  const glm::dvec3 across = pose[kLeftShoulder] - pose[kRightShoulder];
  const glm::dvec3 fallback = UnitOr(glm::cross(up, Facing(pose)), {1, 0, 0});
  const glm::dvec3 left = UnitOr(across - glm::dot(across, up) * up, fallback);
  return glm::quat_cast(glm::dmat3(left, up, glm::cross(left, up)));
}

/// Returns true if a limb's direction is interpolated in the trunk's frame: for arms and head, but not for hips and
/// legs, because feet would slide whenever the body bends.
bool GoesWithTrunk(Role child) {
  return child == kHead || (Index(child) >= Index(kLeftShoulder) && Index(child) <= Index(kRightHand));
}

double LowestHeight(const BodyPose& pose) {
  double lowest = pose.joints[0].y;
  for (const glm::dvec3& joint : pose.joints) lowest = std::min(lowest, joint.y);
  return lowest;
}

double Mix(double from, double to, double part) { return from + part * (to - from); }

using Key = InBetweenNet::Key;

/// Returns the frames that may become keys. The most typical frame of the most frequent pose comes first.
std::vector<Key> RankForKeys(std::span<const TaggedClip> tagged, const FeatureWeights& weights) {
  const bool has_bridge_frames =
      std::any_of(tagged.begin(), tagged.end(), [](const TaggedClip& clip) { return !clip.bridge_frames.empty(); });
  const std::vector<std::vector<FrameRating>> ratings = RateFrames(tagged, weights);
  std::vector<Key> ranked;
  // Collect the bridge frames, or all frames of a library without bridge frames.
  for (int c = 0; c < static_cast<int>(tagged.size()); ++c) {
    if (has_bridge_frames) {
      for (int frame : tagged[c].bridge_frames) ranked.push_back({c, frame});
    } else {
      for (int frame = 0; frame < tagged[c].FrameCount(); ++frame) ranked.push_back({c, frame});
    }
  }
  // Sort by the frequency of the pose, then by how typical the frame is.
  const auto rank = [&](const Key& key) {
    const FrameRating& rating = ratings[key.clip][key.frame];
    return std::tuple(-rating.clips, -rating.frames, tagged[key.clip].tags[key.frame], rating.difference);
  };
  std::stable_sort(ranked.begin(), ranked.end(), [&](const Key& a, const Key& b) { return rank(a) < rank(b); });
  return ranked;
}

}  // namespace

double LongestTween(const TweenRules& rules) { return std::max(rules.shortest_s, kPeakSlope * kPi / rules.turn_speed); }

glm::dvec3 Tween::Turn::At(double part) const { return angle > 0 ? glm::angleAxis(part * angle, axis) * start : start; }

Tween::Turn Tween::MakeTurn(const glm::dvec3& from, const glm::dvec3& to) {
  // For opposite directions the axis is undefined. In that case, rotate limbs sideways, about the body's forward axis.
  const glm::dvec3 fallback = UnitOr(glm::dvec3(0, 0, 1) - from.z * from, {0, 1, 0});
  return {.start = from, .axis = UnitOr(glm::cross(from, to), fallback), .angle = AngleBetween(from, to)};
}

Tween::Tween(const BodyPose& from, const BodyPose& to) : from_(from) {
  const BodyPose aligned = AlignOnFloor(to, from).Apply(to);
  low_from_ = LowestHeight(from);
  low_to_ = LowestHeight(aligned);
  const auto height = [&](Role ankle) { return from[ankle].y + aligned[ankle].y; };
  planted_ = height(kRightAnkle) < height(kLeftAnkle) ? kRightAnkle : kLeftAnkle;
  trunk_from_ = TrunkFrame(from);
  trunk_to_ = TrunkFrame(aligned);
  for (const Bone& bone : AllBones()) {
    const std::size_t i = Index(bone.child);
    lengths_from_[i] = BoneLength(from, bone);
    lengths_to_[i] = BoneLength(aligned, bone);
    const bool with_trunk = GoesWithTrunk(bone.child);
    const glm::dquat no_turn(1, 0, 0, 0);
    const glm::dvec3 down(0, -1, 0);
    const glm::dvec3 start =
        glm::conjugate(with_trunk ? trunk_from_ : no_turn) * UnitOr(from[bone.child] - from[bone.parent], down);
    const glm::dvec3 end =
        glm::conjugate(with_trunk ? trunk_to_ : no_turn) * UnitOr(aligned[bone.child] - aligned[bone.parent], down);
    turns_[i] = MakeTurn(start, end);
  }
}

double Tween::WidestTurn() const {
  double widest = 0;
  for (const Turn& turn : turns_) widest = std::max(widest, turn.angle);
  return widest;
}

BodyPose Tween::At(double part) const {
  const glm::dquat trunk = glm::slerp(trunk_from_, trunk_to_, part);
  BodyPose pose;
  pose[kHipCentre] = from_[kHipCentre];
  for (const Bone& bone : AllBones()) {
    const std::size_t i = Index(bone.child);
    const glm::dvec3 direction = turns_[i].At(part);
    pose[bone.child] = pose[bone.parent] + Mix(lengths_from_[i], lengths_to_[i], part) *
                                               (GoesWithTrunk(bone.child) ? trunk * direction : direction);
  }
  // Keep the planted ankle in place, and interpolate the height of the lowest joint.
  glm::dvec3 shift = from_[planted_] - pose[planted_];
  shift.y = Mix(low_from_, low_to_, part) - LowestHeight(pose);
  for (glm::dvec3& joint : pose.joints) joint += shift;
  return pose;
}

std::vector<BodyPose> SampleTween(const Tween& tween, double rate_hz, const TweenRules& rules) {
  const double seconds = std::max(rules.shortest_s, kPeakSlope * tween.WidestTurn() / rules.turn_speed);
  const int steps = std::max(1, static_cast<int>(std::ceil(seconds * rate_hz - 1e-9)));
  std::vector<BodyPose> frames;
  frames.reserve(static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i <= steps; ++i) frames.push_back(tween.At(Smootherstep(static_cast<double>(i) / steps)));
  return frames;
}

void AppendTween(const BodyPose& to, double rate_hz, const TweenRules& rules, std::vector<BodyPose>& frames) {
  const std::vector<BodyPose> rest = SampleTween(Tween(frames.back(), to), rate_hz, rules);
  frames.insert(frames.end(), rest.begin() + 1, rest.end());
}

InBetweenNet BuildInBetweens(std::span<const TaggedClip> tagged, const InBetweenRules& rules) {
  InBetweenNet net{.keys = {}, .tween = rules.tween};
  const GradeMetric metric(rules.weights);
  std::vector<FrameBlock> taken;  // the grades of the keys, sixteen in a block
  std::size_t last = 0;           // the block whose key was near the previous frame; often near the next frame, too
  const auto covers = [&](std::size_t block, const Grades& grades) {
    const int used = static_cast<int>(std::min<std::size_t>(net.keys.size() - block * kBlockLanes, kBlockLanes));
    const BlockResult near = SquaredDistances(metric, grades, taken[block], SquaredLimit(rules.threshold));
    bool is_near = false;
    ForEachLane(near.kept & LanesOf(used),
                [&](int lane) { is_near = is_near || std::sqrt(near.squared[lane]) < rules.threshold; });
    return is_near;
  };
  for (const Key& key : RankForKeys(tagged, rules.weights)) {
    const Grades& grades = tagged[key.clip].grades[key.frame];
    if (last < taken.size() && covers(last, grades)) continue;
    for (last = 0; last < taken.size() && !covers(last, grades); ++last) {
    }
    if (last < taken.size()) continue;
    const int lane = static_cast<int>(net.keys.size() % kBlockLanes);
    if (lane == 0) taken.emplace_back();
    taken.back().Set(lane, grades);
    net.keys.push_back(key);
  }
  return net;
}

double LongestInBetween(const TweenRules& rules, double rate_hz) {
  return 2 * std::ceil(LongestTween(rules) * rate_hz) / rate_hz;
}

}  // namespace etude
