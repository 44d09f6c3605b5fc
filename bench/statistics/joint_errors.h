#pragma once

#include <array>
#include <string>
#include <vector>

#include "bench/metrics/alignment.h"
#include "bench/model/run_data.h"

namespace etude {

/// The errors of one joint under one condition of a scenario, for one method.
struct EvaluatedJoint {
  std::vector<SweptValue> condition;
  std::string method, joint;
  std::array<int, kByJoint.size()> pairs = {};  ///< number of pairs with a value, in the order of kByJoint
  JointMeans mean_mm;                           ///< mean over these pairs, each of which counts once, as in mpjpe_…
};

/// Returns the errors of every joint whose means (JointMeans) the cells of a run contain, as series with the axis
/// kJointErrorAxis. Joints are in the order of the cells.
std::vector<EvaluatedJoint> ErrorsByJoint(const RunData& run);

}  // namespace etude
