#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/row.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// A method made ready: its coach, and its recogniser taught the moves of the dance.
struct ReadyCoach {
  CoachMethod method;
  std::shared_ptr<const DanceTransitions> transitions;  ///< methods with the same way share theirs
  std::unique_ptr<Recogniser> recogniser;
  std::unique_ptr<Coach> coach;
  std::unique_ptr<Coach> partner;  ///< of a yoked method
};

/// `stage` must outlive what is made. Fails where a method's recogniser cannot be taught.
Result<std::vector<ReadyCoach>> MakeReady(std::vector<CoachMethod> methods, const CoachStage& stage);

/// Runs a session of a method's coach with this world's learner. A yoked method first runs its partner's session, of
/// another person drawn alike, and then corrects at the same frames. `program`: takes the method's seat; null = there
/// is none. Fails when it answers in the wrong shape.
Result<SessionLog> RunMethod(const ReadyCoach& ready, const CoachCondition& condition, const CoachStage& stage,
                             const CoachWorld& world, LiveProgram* program);

/// Every metric of a session, or why it has no value; digests of what was danced, sensed, decided and shown; and
/// curves.
void ScoreCoaching(const CoachWorld& world, const CoachStage& stage, const SessionLog& log, CellResult& result);
std::vector<std::string> CoachMetrics();

}  // namespace etude
