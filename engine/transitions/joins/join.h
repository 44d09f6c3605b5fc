#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/number_setting.h"
#include "engine/motion/body.h"

namespace etude {

/// Two successive frames: where a body is, and, by difference, how it moves.
struct PosePair {
  BodyPose before;
  BodyPose now;
};

/// What meets at a seam, all in the place where it is shown.
struct SeamMotions {
  PosePair shown;                          ///< the last two frames shown
  PosePair target;                         ///< the new motion's frames that would stand in their place
  std::span<const BodyPose> continuation;  ///< what the old motion would have shown next; may be short, or empty
  double rate_hz = kJudgedRateHz;
};

/// Numbers that some joins can be set by.
struct JoinSettings {
  double half_life_s = 0.1;  ///< of the spring: seconds until half an offset is gone; ours
  double blend_s = 0.33;     ///< of the crossfade and the quintic: until the new motion is shown alone; ours
};

using JoinSetting = NumberSetting<JoinSettings>;

/// The frame to show, `frames` (≥ 1) after the seam, from the new motion's frame there.
using Blend = std::function<BodyPose(const BodyPose& target, int frames)>;

/// A way to put two clips together at a seam, by the name scenario files call it. All limbs keep their lengths.
struct Join {
  std::string name;
  std::string description;  ///< one line, for people
  std::vector<JoinSetting> settings = {};
  Blend (*begin)(const SeamMotions& motions, const JoinSettings& settings) = nullptr;
};

/// Paper A's cut first.
std::span<const Join> AllJoins();
std::vector<std::string> JoinNames();
/// Null when there is no such join.
const Join* FindJoin(std::string_view name);

}  // namespace etude
