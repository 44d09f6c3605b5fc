#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"
#include "engine/transitions/choices/planning.h"
#include "engine/transitions/joins/splice.h"
#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A rule that decides at which frame one clip is left and at which frame the other is entered. Scenario files use its
/// name. The argument `values` has one value per setting, in order; if empty, the defaults apply.
struct Choice {
  std::string name;
  std::string description;                   ///< one line for users
  bool matches_poses = false;                ///< true if poses are compared; needed for the metric `false_smooth`
  bool uses_fuzzy = false;                   ///< true if the rules' weights and threshold apply
  std::vector<NumberSetting> settings = {};  ///< settings of this choice, in addition to the rules of all fuzzy choices
  /// Returns the frames that the choice may take; null for choices that do not compare poses.
  AllowedFrames (*allowed)(const MotionLibrary& library, const TransitionRequest& request,
                           std::span<const double> values) = nullptr;
  /// Plans a transition. If none is possible, the record has no segments, and its `why` states the reason. The clip
  /// `request.to` must have at least two frames.
  TransitionRecord (*plan)(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                           std::span<const double> values) = nullptr;
};

/// Returns all choices, paper A's first.
std::span<const Choice> AllChoices();
std::vector<std::string> ChoiceNames();
/// Returns the choice called `name`, or null if there is none.
const Choice* FindChoice(std::string_view name);

/// A method of changing from clip to clip: a choice of frames and a join, with their settings.
struct TransitionWay {
  const Choice* choice = nullptr;
  const JoinKind* join = nullptr;
  MatchRules rules = {};
  /// One value per setting of the choice, and one per setting of the join; if empty, the defaults apply.
  std::vector<double> choice_settings = {}, join_settings = {};
};

/// The transition that a method made for a request.
struct Transition {
  TransitionRecord record;
  Splice splice;  ///< has no frames if the record has no segments
};

/// Makes a transition from a frame of one clip into another clip, within a time budget. The request's clips and frame
/// must be in the library, and the wanted clip must have at least two frames.
Transition MakeTransition(const MotionLibrary& library, const TransitionRequest& request, const TransitionWay& way);

}  // namespace etude
