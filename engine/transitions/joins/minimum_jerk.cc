#include "engine/transitions/joins/minimum_jerk.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/smoothstep.h"

namespace etude {

const SettingTable<MinimumJerkOptions>& MinimumJerkSettings() {
  static const SettingTable<MinimumJerkOptions> kSettings({{"blend_s", &MinimumJerkOptions::blend_s, 0, 5,
                                                            "Seconds after the transition point until the new motion "
                                                            "is shown alone, where the choice does not say."},
                                                           {"fades", &MinimumJerkOptions::fades, 0, 1,
                                                            "1: the old motion goes on and fades out; 0: what it was "
                                                            "off from the new one dies away."}});
  return kSettings;
}

glm::dvec3 MinimumJerkDecay(const Offset& offset, double seconds, double blend_s) {
  if (seconds >= blend_s) return glm::dvec3(0);
  const double s = seconds / blend_s, rest = 1 - s;
  // 1 − 10s³ + 15s⁴ − 6s⁵ and s − 6s³ + 8s⁴ − 3s⁵, by their triple root at s = 1.
  const double rest3 = rest * rest * rest;
  return rest3 * ((1 + 3 * s + 6 * s * s) * offset.value + s * (1 + 3 * s) * blend_s * offset.velocity);
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

/// The new motion goes on, and what the old one was off from it dies away.
Inertialiser DecayOf(const JoinWindow& window, int frames) {
  JoinInput input{.shown = window.shown,
                  .target = {window.target_before, window.next[0]},
                  .continuation = {},
                  .upcoming = {},
                  .preferred = {},
                  .rate_hz = window.rate_hz};
  double direction = 1;
  if (window.old_frames > 0) {  // an Inertialiser told the frames after for those before measures velocities backwards
    input.shown.before = window.old[1];
    input.target.before = window.next[1];
    direction = -1;
  }
  return {input, [blend_s = frames / window.rate_hz, direction](const Offset& offset, double seconds) {
            return MinimumJerkDecay({offset.value, direction * offset.velocity}, seconds, blend_s);
          }};
}

}  // namespace

const LimbTurns& WindowTurns::At(int frame) {
  for (std::size_t f = turns_.size(); f <= static_cast<std::size_t>(frame); ++f) {
    turns_.push_back(TurnsBack(window_.old[f], window_.next[f]));
  }
  return turns_[frame];
}

MinimumJerkPlay::MinimumJerkPlay(const JoinWindow& window, WindowTurns& turns, int frames, bool fades)
    : window_(window), turns_(turns), frames_(frames) {
  if (!fades) decay_ = DecayOf(window, frames);
}

BodyPose MinimumJerkPlay::At(int frame) const {
  if (frame == 0) return window_.shown.now;
  if (decay_) return decay_->Apply(window_.next[frame], frame / window_.rate_hz);
  // Both motions go on, and limb by limb the new one takes over.
  const double share = Smootherstep(static_cast<double>(frame) / frames_);
  return PoseBetween(window_.old[frame], window_.next[frame], turns_.At(frame), share);
}

std::vector<BodyPose> PlayMinimumJerk(const JoinWindow& window, bool fades) {
  if (window.Frames() == 0) return {window.shown.now};
  WindowTurns turns(window);
  const MinimumJerkPlay play(window, turns, window.Frames(), fades);
  std::vector<BodyPose> played;
  for (int frame = 0; frame <= window.Frames(); ++frame) played.push_back(play.At(frame));
  return played;
}

PreferredJoin PreferredJoinOf(const JoinInput& input, const MinimumJerkOptions& options) {
  return input.preferred.value_or(PreferredJoin{.blend_s = options.blend_s, .fades = options.fades != 0});
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
  return ShowPlayed(PlayMinimumJerk(WindowOfJoin(input, preferred), preferred.fades));
}

}  // namespace etude
