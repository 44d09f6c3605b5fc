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

/// What the library refuses. Every function throws BadInput.
namespace etude::engine {

/// Returns the value of a result, or throws its error.
template <typename T>
T OrThrow(Result<T> result) {
  if (!result) throw BadInput(ToString(result.error()));
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

/// Refuses an invalid rate, and positions that are not finite. Returns the motion.
const BodyMotion& Checked(const BodyMotion& motion);
/// Also refuses no clips, a clip without frames, and different rates.
void CheckClips(std::span<const BodyMotion> clips);
/// Refuses a body without legs.
double StandingHipsOf(const BodyPose& first);

/// The largest possible fuzzy distance: the weights of the features sum to eight, and all grades differ by as much as
/// they can.
inline constexpr double kFarthestFuzzy = 6;
/// Refuses a budget unless a clip can be waited for this long.
void CheckBudget(double budget_s);

/// Refuses unknown names.
TransitionWay WayNamed(const std::string& choice, const std::string& join);

/// Returns the recogniser of that name, which must learn from examples alone.
const RecogniserKind& KindOfExamples(const std::string& name);
/// Refuses examples without frames or with positions that are not finite.
void CheckMoves(std::span<const TaughtMove> moves);
/// Refuses positions that are not finite.
void CheckFrame(const SensedFrame& frame);

}  // namespace etude::engine
