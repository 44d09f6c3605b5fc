#pragma once

#include <etude/cameras.h>
#include <etude/motion.h>
#include <etude/recognition.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/recognition/taught_move.h"
#include "engine/transitions/choices/choice.h"

namespace etude::engine {

/// Returns the value of a result, or throws its error as BadInput.
template <typename T>
T OrThrow(Result<T> result) {
  if (!result) throw BadInput(ToString(result.error()));
  return *std::move(result);
}

Motion FromBodyMotion(const BodyMotion& motion);
/// Throws BadInput for an invalid rate, or positions that are not finite.
BodyMotion ToBodyMotion(const Motion& motion);
/// Throws BadInput for no clips, a clip without frames, or different rates.
std::vector<BodyMotion> ToBodyMotions(std::span<const Motion> clips);
/// Throws BadInput for a body without legs.
double StandingHipsOf(const BodyPose& first);

/// The largest possible fuzzy distance: the weights of the features sum to eight, and all grades differ by as much as
/// they can.
inline constexpr double kFarthestFuzzy = 6;
/// Throws BadInput unless a clip can be waited for this long.
void CheckBudget(double budget_s);

/// Throws BadInput for unknown names.
TransitionWay WayNamed(const std::string& choice, const std::string& join);

etude::Camera ToEngineCamera(const Camera& camera);
/// Throws BadInput, naming the camera, for a lens with another model.
Camera FromEngineCamera(std::string name, const etude::Camera& camera);

/// Returns the recogniser of that name, which must learn from examples alone. Throws BadInput if there is none.
const RecogniserKind& KindOfExamples(const std::string& name);
/// Throws BadInput for an example without frames or with positions that are not finite.
etude::TaughtMove ToEngineMove(const TaughtMove& move);
/// Throws BadInput for positions that are not finite.
SensedFrame ToEngineFrame(const SensedPose& frame);

}  // namespace etude::engine
