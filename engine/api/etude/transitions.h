#pragma once

#include <etude/motion.h>

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/settings.h"

namespace etude::engine {

/// The settings of a transition from one clip to another.
struct TransitionOptions {
  /// Name of the rule that selects the frames at which clips are left and entered: one of TransitionChoices().
  std::string choice = "played";
  std::string join = "planted-feet";  ///< name of the method that joins the two clips: one of TransitionJoins()
  double threshold = 0.4;             ///< maximum fuzzy distance of matching frames for the fuzzy choices, in (0, 6]
  /// The settings of the choice and of the join, by key; a setting that is missing keeps its default.
  std::map<std::string, double> choice_settings = {}, join_settings = {};
};

/// Returns the names of all choices (rules that select a transition's frames): "fuzzy-bridge" (paper A's), "played",
/// "motion-matching", …
ETUDE_API std::vector<std::string> TransitionChoices();
/// Returns the names of all joins (methods that join two clips): "cut" (paper A's), "crossfade", "planted-feet", …
ETUDE_API std::vector<std::string> TransitionJoins();
/// Lists the settings of a choice or a join. Throws BadInput for an unknown name.
ETUDE_API std::vector<NumberSetting> TransitionChoiceSettings(const std::string& choice);
ETUDE_API std::vector<NumberSetting> TransitionJoinSettings(const std::string& join);

/// A transition from one clip to another, as it is shown.
struct Transition {
  /// The playing clip from its first frame, then the frames of the transition, then the wanted clip to its end, moved
  /// to the place on the floor where the playing clip was left. The motion has no frames if the choice finds no
  /// transition.
  BodyMotion motion;
  std::vector<int> points;  ///< indices of the frames of `motion` after which another clip plays, ascending
  double wait_s = 0;        ///< seconds from the request until the wanted clip plays
  std::string branch;       ///< the kind of transition: "front half", "in-between", "now", … or "none"
  std::string why;          ///< one sentence: why this transition was chosen, or why there is none
};

/// The proportions of one person. The limb lengths are those of `pose`, scaled so that the hips of the standing body
/// are `hip_height` metres high.
struct BodyProportions {
  BodyPose pose;
  double hip_height = 0;
};

/// Clips prepared for transitions: transferred to one body, tagged, and connected by in-betweens.
class ETUDE_API TransitionLibrary {
 public:
  /// Transfers all clips to one body. The body has the given proportions (scenarios use sim::ScenarioProportions), by
  /// default the medians over the first clip's frames. Throws BadInput for no clips, a clip with fewer than two frames
  /// or with a rate other than 30 Hz, positions that are not finite, a body without legs, and hips that are not 0.1 to
  /// 10 m high.
  explicit TransitionLibrary(std::span<const BodyMotion> clips, const std::optional<BodyProportions>& proportions = {});
  TransitionLibrary(TransitionLibrary&&) noexcept;
  TransitionLibrary& operator=(TransitionLibrary&&) noexcept;
  ~TransitionLibrary();

  /// Makes the transition from clip `from` to clip `to`, which is requested while frame `frame` of `from` is shown.
  /// `budget_s` is the maximum wait for the wanted clip, 0 to 3600 seconds. Throws BadInput for a clip, frame, choice,
  /// join or setting that does not exist, and for a setting out of its range.
  Transition Make(int from, int frame, int to, double budget_s = 1, const TransitionOptions& options = {}) const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace etude::engine
