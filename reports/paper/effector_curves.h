#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Whether any cell of this scenario keeps such curves: its task is `ik`, and it asks to `record: [effector_curves]`.
bool HasEffectorCurves(const RunData& run, const ScenarioSummary& scenario);

/// Paper B's figure 5.2: how each end effector's position error and the errors of its three axes fall from iteration to
/// iteration, all methods in one small panel each, on a logarithmic axis; thin the first trial, thick the median of
/// all. As vector graphics inside HTML, one folding figure per condition. "" for a scenario whose cells keep no such
/// curves.
std::string EffectorCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
