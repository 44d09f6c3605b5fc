#include "engine/transitions/joins/minimum_jerk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "engine/transitions/joins/limbs.h"

namespace etude {

const SettingTable<MinimumJerkOptions>& MinimumJerkSettings() {
  static const SettingTable<MinimumJerkOptions> kSettings(
      {{"blend_s", &MinimumJerkOptions::blend_s, 0, 5,
        "Blend length: seconds from the transition point until only the new motion is shown. Some choices set their "
        "own blend length."},
       {"fades", &MinimumJerkOptions::fades, 0, 1,
        "1: the old motion continues and fades out; 0: its offset from the new motion decays."},
       {"direct", &MinimumJerkOptions::direct, 0, 1,
        "1: each limb moves with minimum jerk to its pose at the end of the blend; 0: as `fades` states."}});
  return kSettings;
}

glm::dvec3 MinimumJerkAt(const Movement& movement, double seconds, double blend_s) {
  if (seconds >= blend_s) return glm::dvec3(0);
  const double s = seconds / blend_s, rest = 1 - s;
  // Compute the basis functions 1 − 10s³ + 15s⁴ − 6s⁵ (position) and s − 6s³ + 8s⁴ − 3s⁵ (start velocity), factored by
  // their triple root at s = 1. The basis function of the end velocity is the mirror image of the start velocity's.
  const double s3 = s * s * s, rest3 = rest * rest * rest;
  return rest3 * ((1 + 3 * s + 6 * s * s) * movement.start + s * (1 + 3 * s) * blend_s * movement.start_velocity) -
         s3 * rest * (1 + 3 * rest) * blend_s * movement.end_velocity;
}

JoinWindow WindowOf(const JoinInput& input, int frames) {
  JoinWindow window{.shown = input.shown,
                    .target_before = input.target.before,
                    .old = {input.shown.now},
                    .next = {input.target.now},
                    .rate_hz = input.rate_hz};
  const std::size_t count = static_cast<std::size_t>(frames);
  for (const BodyPose& pose : input.continuation(count)) window.old.push_back(pose);
  for (const BodyPose& pose : input.upcoming(count)) window.next.push_back(pose);
  window.old_frames = static_cast<int>(window.old.size()) - 1;
  window.next_frames = static_cast<int>(window.next.size()) - 1;
  window.old.resize(count + 1, BodyPose(window.old.back()));
  window.next.resize(count + 1, BodyPose(window.next.back()));
  return window;
}

namespace {

/// Makes the inertialisation of a join of style kDecays: the new motion plays, and the old motion's offset from the new
/// motion decays.
Inertialiser DecayOf(const JoinWindow& window, int frames) {
  JoinInput input{.shown = window.shown,
                  .target = {window.target_before, window.next[0]},
                  .continuation = {},
                  .upcoming = {},
                  .preferred = {},
                  .rate_hz = window.rate_hz};
  double direction = 1;
  // Use forward differences: the frames after the point take the place of the frames before it. This reverses time, so
  // velocities change their sign.
  if (window.old_frames > 0) {
    input.shown.before = window.old[1];
    input.target.before = window.next[1];
    direction = -1;
  }
  return {input, [blend_s = frames / window.rate_hz, direction](const Offset& offset, double seconds) {
            return MinimumJerkAt({offset.value, direction * offset.velocity}, seconds, blend_s);
          }};
}

glm::dvec3 LimbOf(const BodyPose& pose, const Bone& bone) { return pose[bone.child] - pose[bone.parent]; }

/// Returns the movement of each limb and of the hip centre, from the old motion to the new motion's pose after `frames`
/// frames.
std::array<Movement, kRoleCount> MovementsOf(const JoinWindow& window, int frames) {
  const BodyPose& end = window.next[frames];
  const bool goes_on = window.old_frames > 0;
  const auto movement = [&](auto&& from_end) {
    const glm::dvec3 start = from_end(window.shown.now);
    const glm::dvec3 step = goes_on ? from_end(window.old[1]) - start : start - from_end(window.shown.before);
    return Movement{start, step * window.rate_hz, -from_end(window.next[frames - 1]) * window.rate_hz};
  };
  std::array<Movement, kRoleCount> movements;
  movements[Index(Role::kHipCentre)] =
      movement([&](const BodyPose& pose) { return pose[Role::kHipCentre] - end[Role::kHipCentre]; });
  for (const Bone& bone : AllBones()) {
    const glm::dvec3 limb = LimbOf(end, bone);
    const LimbTurn now = TurnBetween(limb, LimbOf(window.shown.now, bone));
    movements[Index(bone.child)] = movement([&](const BodyPose& pose) {
      const LimbTurn turn = TurnBetween(limb, LimbOf(pose, bone));
      // Beyond half a turn the rotation vector flips its sign between two frames, which would give a wrong velocity.
      return glm::dot(turn, now) < 0 && glm::length(turn) > 0.5 * kPi ? now : turn;
    });
  }
  return movements;
}

}  // namespace

const LimbTurns& WindowTurns::At(int frame) {
  for (std::size_t f = turns_.size(); f <= static_cast<std::size_t>(frame); ++f) {
    turns_.push_back(TurnsBack(window_.old[f], window_.next[f]));
  }
  return turns_[frame];
}

MinimumJerkPlay::MinimumJerkPlay(const JoinWindow& window, WindowTurns& turns, int frames, JoinStyle way)
    : window_(window), turns_(turns), frames_(frames) {
  if (way == JoinStyle::kDecays) decay_ = DecayOf(window, frames);
  if (way == JoinStyle::kDirect) movements_ = MovementsOf(window, frames);
}

BodyPose MinimumJerkPlay::At(int frame) const {
  if (frame == 0) return window_.shown.now;
  if (decay_) return decay_->Apply(window_.next[frame], frame / window_.rate_hz);
  if (movements_) {
    const BodyPose& end = window_.next[frames_];
    const auto at = [&](Role role) {
      return MinimumJerkAt((*movements_)[Index(role)], frame / window_.rate_hz, frames_ / window_.rate_hz);
    };
    BodyPose pose;
    pose[Role::kHipCentre] = end[Role::kHipCentre] + at(Role::kHipCentre);
    for (const Bone& bone : AllBones()) {
      pose[bone.child] = pose[bone.parent] + Turned(LimbOf(end, bone), at(bone.child));
    }
    return pose;
  }
  // A fade: both motions play, and the new motion's share grows, limb by limb.
  const double share = Smootherstep(static_cast<double>(frame) / frames_);
  return PoseBetween(window_.old[frame], window_.next[frame], turns_.At(frame), share);
}

std::vector<BodyPose> PlayMinimumJerk(const JoinWindow& window, JoinStyle way) {
  if (window.Frames() == 0) return {window.shown.now};
  WindowTurns turns(window);
  const MinimumJerkPlay play(window, turns, window.Frames(), way);
  std::vector<BodyPose> played;
  for (int frame = 0; frame <= window.Frames(); ++frame) played.push_back(play.At(frame));
  return played;
}

PreferredJoin PreferredJoinOf(const JoinInput& input, const MinimumJerkOptions& options) {
  const JoinStyle way = options.direct != 0 ? JoinStyle::kDirect : options.fades != 0 ? JoinStyle::kFades : JoinStyle::kDecays;
  return input.preferred.value_or(PreferredJoin{.blend_s = options.blend_s, .way = way});
}

JoinWindow WindowOfJoin(const JoinInput& input, const PreferredJoin& preferred) {
  return WindowOf(input, static_cast<int>(std::lround(preferred.blend_s * input.rate_hz)));
}

Blend ShowPlayed(std::vector<BodyPose> played) {
  return [played = std::move(played)](const BodyPose& target, int frames) {
    return frames < static_cast<int>(played.size()) ? played[frames] : target;
  };
}

Blend MinimumJerk(const JoinInput& input, const MinimumJerkOptions& options) {
  const PreferredJoin preferred = PreferredJoinOf(input, options);
  return ShowPlayed(PlayMinimumJerk(WindowOfJoin(input, preferred), preferred.way));
}

}  // namespace etude
