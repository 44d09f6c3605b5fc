#pragma once

#include <etude/base.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/recognition/taught_move.h"
#include "engine/transitions/choices/choice.h"

/// Checks of the library's input. Every function throws BadInput if its check fails.
namespace etude::engine {

/// Returns the value of a result, or throws its error.
template <typename T>
T OrThrow(Result<T> result) {
  if (!result) throw BadInput(ToString(result.error()));
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

/// Refuses an invalid rate and positions that are not finite; else returns the motion.
const BodyMotion& Checked(const BodyMotion& motion);
/// Checks every clip as above, and refuses an empty list, clips without frames, and clips of different rates.
void CheckClips(std::span<const BodyMotion> clips);
/// Returns the standing height of the hips, computed from the limb lengths of `first`, metres. Refuses a body without
/// legs.
double StandingHipsOf(const BodyPose& first);

/// The largest possible fuzzy distance: the weights of the features sum to eight, and all grades differ by as much as
/// they can.
inline constexpr double kFarthestFuzzy = 6;
/// Refuses a budget (the longest wait) outside of 0 to 3600 s.
void CheckBudget(double budget_s);

/// Returns the choice and the join of these names. Refuses unknown names.
TransitionWay WayNamed(const std::string& choice, const std::string& join);

/// Returns the recogniser of that name, which must learn from examples alone.
const RecogniserKind& KindOfExamples(const std::string& name);
/// Refuses examples without frames or with positions that are not finite.
void CheckMoves(std::span<const TaughtMove> moves);
/// Refuses positions that are not finite.
void CheckFrame(const SensedFrame& frame);

}  // namespace etude::engine
