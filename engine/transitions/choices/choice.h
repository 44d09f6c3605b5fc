#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"
#include "engine/transitions/base/match_rules.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/choices/allowed_frames.h"
#include "engine/transitions/library/library.h"

namespace etude {

/// A way to choose when and where one clip is left and the other entered, by the name scenario files call it. `values`
/// of its settings: one per setting, in their order; none at all: the defaults.
struct Choice {
  std::string name;
  std::string description;     ///< one line, for people
  bool matches_poses = false;  ///< it takes frames because they are alike, so that `false_smooth` can be asked
  bool uses_fuzzy = false;     ///< the rules' weights and threshold apply
  std::vector<NumberSetting> settings = {};  ///< its own numbers, beside the rules of all fuzzy choices
  /// The frames that it may take; null for choices that match no poses.
  AllowedFrames (*allowed)(const MotionLibrary& library, const TransitionRequest& request,
                           std::span<const double> values) = nullptr;
  /// Always leaves segments when it can; a record without any says why. `request.to` must have two frames.
  TransitionRecord (*plan)(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                           std::span<const double> values) = nullptr;
};

/// Paper A's first.
std::span<const Choice> AllChoices();
std::vector<std::string> ChoiceNames();
/// Null when there is no such choice.
const Choice* FindChoice(std::string_view name);

}  // namespace etude
