#pragma once

#include <etude/base.h>

#include <span>
#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/recognition/taught_move.h"
#include "engine/transitions/choices/choice.h"

/// Checks of the library's input. Every function throws BadInput if its check fails.
namespace etude::engine {

/// Returns the value of `result`. If `result` holds an error, throws BadInput with the error's text.
template <typename T>
T OrThrow(Result<T> result) {
  if (!result) throw BadInput(ToString(result.error()));
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

/// Returns the motion after checking that its rate is valid and its positions are finite.
const BodyMotion& Checked(const BodyMotion& motion);
/// Checks every clip like `Checked`. Also refuses an empty list, clips without frames, and clips of different rates.
void CheckClips(std::span<const BodyMotion> clips);
/// Returns the standing height of the hips, computed from the limb lengths of the pose `first`, metres. Refuses a body
/// without legs.
double StandingHipsOf(const BodyPose& first);

/// An upper limit for thresholds of the fuzzy distance. No fuzzy distance exceeds √(8 · 4) ≈ 5.7, because the weights
/// of the features sum to eight and a feature has at most four terms.
inline constexpr double kFarthestFuzzy = 6;
/// Refuses a budget outside 0 to 3600. A budget is the maximum wait for a transition, in seconds.
void CheckBudget(double budget_s);

/// Returns the choice (the rule that selects a transition's frames) and the join (the method that joins the two clips)
/// with these names. Refuses unknown names.
TransitionWay WayNamed(const std::string& choice, const std::string& join);

/// Returns the recogniser with this name. Refuses recognisers that do not learn from examples.
const RecogniserKind& KindOfExamples(const std::string& name);
/// Refuses examples without frames or with positions that are not finite.
void CheckMoves(std::span<const TaughtMove> moves);
/// Refuses positions that are not finite.
void CheckFrame(const SensedFrame& frame);

}  // namespace etude::engine
