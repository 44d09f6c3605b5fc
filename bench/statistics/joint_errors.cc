#include "bench/statistics/joint_errors.h"

#include <array>

namespace etude {

std::vector<EvaluatedJoint> ErrorsByJoint(const RunData& run) {
  std::vector<EvaluatedJoint> found;
  for (const SeriesGroup& group : GroupSeries(run, kJointErrorAxis)) {
    EvaluatedJoint errors{group.condition, group.method, group.name, 0, {}};
    std::array<int, kByJoint.size()> counts = {};  // number of pairs with a value, by alignment
    for (const std::vector<double>& values : group.values) {
      const auto means = DecodeMeans(values);
      if (!means) continue;
      ++errors.pairs;
      for (std::size_t i = 0; i < means->size(); ++i) {
        if (!(*means)[i]) continue;
        // Update the mean.
        const double before = errors.mean_mm[i].value_or(0);
        errors.mean_mm[i] = before + (*(*means)[i] - before) / ++counts[i];
      }
    }
    if (errors.pairs > 0) found.push_back(errors);
  }
  return found;
}

}  // namespace etude
