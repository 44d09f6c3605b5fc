#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/row.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/stage.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// Every metric of a session, or why it has no value; digests of what was danced, sensed, decided and shown; and
/// curves.
void ScoreCoaching(const CoachWorld& world, const CoachStage& stage, const SessionLog& log, CellResult& result);
std::vector<std::string> CoachMetrics();

}  // namespace etude
