#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// A prepared method: its coach, and its recogniser, which has been taught the moves of the dance.
struct ReadyCoach {
  CoachMethod method;
  /// The transitions of the dance. All methods that need the same transitions share one object.
  std::shared_ptr<const DanceTransitions> transitions;
  std::unique_ptr<Recogniser> recogniser;
  std::unique_ptr<Coach> coach;
  std::unique_ptr<Coach> partner;  ///< the coach with the partner policy, if the method is yoked; else null
};

/// Prepares the methods. `stage` must outlive the result. Fails if a method's recogniser cannot be taught.
Result<std::vector<ReadyCoach>> MakeReady(std::vector<CoachMethod> methods, const CoachStage& stage);

/// Runs a session of a method's coach with this world's learner. A yoked method first runs a session of its partner
/// policy with another person from the same distribution, and then corrects at the same frames. `program` replaces the
/// part of the loop that CoachMethod::seat names; null = no program. Fails if an answer has the wrong shape.
Result<SessionLog> RunMethod(const ReadyCoach& ready, const CoachCondition& condition, const CoachStage& stage,
                             const CoachWorld& world, LiveProgram* program);

/// Adds all metrics of a session to a result, by a value or by the reason why a metric is missing. Also adds the
/// curves, and digests of the motions danced and sensed, of the decisions and of the motion shown.
void ScoreCoaching(const CoachWorld& world, const CoachStage& stage, const SessionLog& log, CellResult& result);
std::vector<std::string> CoachMetrics();

}  // namespace etude
