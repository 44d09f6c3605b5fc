#pragma once

#include <etude/motion.h>

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace etude::engine {

/// The settings by which a clip is left for another.
struct TransitionOptions {
  std::string choice = "played";      ///< which frame is left and which entered: one of TransitionChoices()
  std::string join = "planted-feet";  ///< how the clips are put together there: one of TransitionJoins()
  double threshold = 0.4;             ///< of the fuzzy choices: frames match below this fuzzy distance, in (0, 6]
  /// The numbers that the choice and the join are set by, by their keys; what is not told keeps its fallback.
  std::map<std::string, double> choice_settings = {}, join_settings = {};
};

/// A number that a choice or a join can be set by.
struct TransitionSetting {
  std::string key;
  double fallback = 0;             ///< what it is where nothing is told
  double lowest = 0, largest = 0;  ///< both allowed
  bool is_whole = false;
  std::string meaning;  ///< one sentence
};

/// The names of all choices: "fuzzy-bridge" (paper A's), "played", "motion-matching", …
ETUDE_API std::vector<std::string> TransitionChoices();
/// The names of all joins: "cut" (paper A's), "crossfade", "planted-feet", …
ETUDE_API std::vector<std::string> TransitionJoins();
/// Lists what a choice or a join can be set by. Throws BadInput for a name that there is not.
ETUDE_API std::vector<TransitionSetting> TransitionChoiceSettings(const std::string& choice);
ETUDE_API std::vector<TransitionSetting> TransitionJoinSettings(const std::string& join);

/// A clip that is left for another, as it is shown.
struct Transition {
  /// The playing clip from its first frame, whatever lies between, and the wanted clip to its end, laid on the floor
  /// where the other one stood; no frames where the choice finds no way.
  Motion motion;
  std::vector<int> points;  ///< the last frames of `motion` before another clip plays, rising
  double wait_s = 0;        ///< seconds from the request until the wanted clip plays
  std::string branch;       ///< the kind of way: "front half", "in-between", "now", … or "none"
  std::string why;          ///< one sentence: why this way won, or why there is none
};

/// The proportions of one person: those of a pose, scaled so that its hips stand so high, metres.
struct BodyProportions {
  Pose pose;
  double hip_height = 0;
};

/// Clips made ready for transitions: performed by one body, tagged, and joined by in-betweens.
class ETUDE_API TransitionLibrary {
 public:
  /// The body that performs is that of the first clip's first frame, or the one told (a scenario's is
  /// sim::ScenarioProportions). Throws BadInput for no clips, a clip of fewer than two frames or of another rate than
  /// 30 Hz, places that are not finite, a body without legs, and hips that are not 0.1 to 10 m high.
  explicit TransitionLibrary(std::span<const Motion> clips, const std::optional<BodyProportions>& proportions = {});
  TransitionLibrary(TransitionLibrary&&) noexcept;
  TransitionLibrary& operator=(TransitionLibrary&&) noexcept;
  ~TransitionLibrary();

  /// Makes the transition from frame `frame` of clip `from`, which is the one shown when clip `to` is asked for;
  /// `budget_s`: how long the wanted clip may be waited for, 0 to 3600 seconds. Throws BadInput for a clip, frame,
  /// choice, join or setting that there is not, and a setting beyond its bounds.
  Transition Make(int from, int frame, int to, double budget_s = 1, const TransitionOptions& options = {}) const;

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace etude::engine
