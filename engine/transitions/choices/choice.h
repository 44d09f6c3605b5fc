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

/// A way to choose when and where one clip is left and the other entered, by the name scenario files call it. `values`
/// of its settings: one per setting, in their order; none at all: the defaults.
struct Choice {
  std::string name;
  std::string description;     ///< one line, for people
  bool matches_poses = false;  ///< it takes frames because they are alike, so that `false_smooth` can be asked
  bool uses_fuzzy = false;     ///< the rules' weights and threshold apply
  std::vector<NumberSetting> settings = {};  ///< its own numbers, beside the rules of all fuzzy choices
  /// Returns the frames that it may take; null for choices that match no poses.
  AllowedFrames (*allowed)(const MotionLibrary& library, const TransitionRequest& request,
                           std::span<const double> values) = nullptr;
  /// Plans a transition. The record has segments whenever there is a way; one without any says why. `request.to` must
  /// have two frames.
  TransitionRecord (*plan)(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                           std::span<const double> values) = nullptr;
};

/// Lists all choices, paper A's first.
std::span<const Choice> AllChoices();
std::vector<std::string> ChoiceNames();
/// Returns the choice of that name, null when there is none.
const Choice* FindChoice(std::string_view name);

/// A way to get from clip to clip: a choice of frames × a join, with what they can be set by.
struct TransitionWay {
  const Choice* choice = nullptr;
  const JoinKind* join = nullptr;
  MatchRules rules = {};
  std::vector<double> choice_settings = {},
                      join_settings = {};  ///< one per setting of the choice, of the join; none: defaults
};

/// The transition that a way made for a request.
struct Transition {
  TransitionRecord record;
  Splice splice;  ///< empty when the record has no segments
};

/// Makes a transition from a frame of a clip into another clip, within a budget of time. The request's clips and frame
/// must be in the library, and the wanted clip must have two frames.
Transition MakeTransition(const MotionLibrary& library, const TransitionRequest& request, const TransitionWay& way);

}  // namespace etude
