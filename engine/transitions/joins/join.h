#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"
#include "engine/motion/body.h"

namespace etude {

/// Two successive frames: where a body is, and, by difference, how it moves.
struct PosePair {
  BodyPose before;
  BodyPose now;
};

/// What a join knows of a transition point, all in the place where it is shown.
struct JoinInput {
  PosePair shown;   ///< the last two frames shown
  PosePair target;  ///< the new motion's frames that would stand in their place
  /// What the old motion would have shown next: so many frames, fewer where it ends. To be asked only while the join
  /// begins.
  std::function<std::vector<BodyPose>(std::size_t count)> continuation;
  double rate_hz = kJudgedRateHz;
};

/// The frame to show, `frames` (≥ 1) after the transition point, from the new motion's frame there.
using Blend = std::function<BodyPose(const BodyPose& target, int frames)>;

/// A way to put two clips together at a transition point, by the name scenario files call it. All limbs keep their
/// lengths.
struct Join {
  std::string name;
  std::string description;  ///< one line, for people
  std::vector<NumberSetting> settings = {};
  /// `values`: one per setting, in their order; none at all: the defaults.
  Blend (*begin)(const JoinInput& input, std::span<const double> values) = nullptr;
};

/// Paper A's cut first.
std::span<const Join> AllJoins();
std::vector<std::string> JoinNames();
/// Null when there is no such join.
const Join* FindJoin(std::string_view name);

}  // namespace etude
