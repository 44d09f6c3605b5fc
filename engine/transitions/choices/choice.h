#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/number_setting.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/library/library.h"

namespace etude {

using RuleSetting = NumberSetting<SwitchRules>;

/// A way to choose when and where one clip is left and the other entered, by the name scenario files call it.
struct Choice {
  std::string name;
  std::string description;     ///< one line, for people
  bool matches_poses = false;  ///< it takes frames because they are alike, so that `false_smooth` can be asked
  bool uses_fuzzy = false;     ///< the rules' weights and threshold apply
  bool any_frame = false;      ///< it may leave and enter at any frame, not only at bridge frames (AllowedPairs)
  std::vector<RuleSetting> settings = {};  ///< its own numbers, beside the threshold of all fuzzy choices
  /// Always leaves legs when it can; a record without legs says why. `request.to` must have two frames.
  SwitchRecord (*plan)(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) = nullptr;
};

/// Paper A's first.
std::span<const Choice> AllChoices();
std::vector<std::string> ChoiceNames();
/// Null when there is no such choice.
const Choice* FindChoice(std::string_view name);

}  // namespace etude
