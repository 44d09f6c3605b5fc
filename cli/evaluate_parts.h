#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "bench/model/summary.h"
#include "bench/statistics/agreement.h"
#include "bench/statistics/joint_errors.h"
#include "io/files/json.h"

namespace etude {

/// Returns true if any cell has a metric of angle errors.
bool HasAngles(const ScenarioSummary& summary);

/// Returns, as JSON, the agreement of every angle that is in both files of a pair, or the errors of every joint.
Json FactsOf(const std::vector<AngleAgreement>& angles);
Json FactsOf(const std::vector<EvaluatedJoint>& joints);

/// Prints a line for each angle, if a metric of angles is shown.
void PrintAngles(const ScenarioSummary& summary, const std::vector<AngleAgreement>& angles);
/// Prints a line for each joint of each method, the joint with the largest error after alignment by the root first.
void PrintJoints(std::vector<EvaluatedJoint> joints);

}  // namespace etude
