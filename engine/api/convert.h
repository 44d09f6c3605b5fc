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

/// Returns what a result holds, or throws its error as BadInput.
template <typename T>
T OrThrow(Result<T> result) {
  if (!result) throw BadInput(ToString(result.error()));
  return *std::move(result);
}

Motion FromBodyMotion(const BodyMotion& motion);
/// Throws BadInput for a rate that is none, or places that are not finite.
BodyMotion ToBodyMotion(const Motion& motion);
/// Throws BadInput for no clips, a clip without frames, and rates that differ.
std::vector<BodyMotion> ToBodyMotions(std::span<const Motion> clips);
/// Throws BadInput for a body without legs.
double StandingHipsOf(const BodyPose& first);

/// The largest fuzzy distance that there is: eight features, weights of which sum to so much, off by all their grades.
inline constexpr double kFarthestFuzzy = 6;
/// Throws BadInput unless a clip can be waited for so long.
void CheckBudget(double budget_s);

/// Throws BadInput for names that there are not.
TransitionWay WayNamed(const std::string& choice, const std::string& join);

etude::Camera ToEngineCamera(const Camera& camera);
/// Throws BadInput, naming the camera, for a lens of another model.
Camera FromEngineCamera(std::string name, const etude::Camera& camera);

/// Returns the recogniser of that name that learns by examples alone. Throws BadInput where there is none.
const RecogniserKind& KindOfExamples(const std::string& name);
/// Throws BadInput for an example without frames or of places that are not finite.
etude::TaughtMove ToEngineMove(const TaughtMove& move);
/// Throws BadInput for places that are not finite.
SensedFrame ToEngineFrame(const SensedPose& frame);

}  // namespace etude::engine
