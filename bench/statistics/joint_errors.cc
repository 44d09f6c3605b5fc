#include "bench/statistics/joint_errors.h"

namespace etude {

std::vector<EvaluatedJoint> ErrorsByJoint(const RunData& run) {
  std::vector<EvaluatedJoint> found;
  for (const SeriesGroup& group : GroupSeries(run, kJointErrorAxis)) {
    EvaluatedJoint errors{group.condition, group.method, group.name, {}, {}};
    bool has_means = false;
    for (const std::vector<double>& values : group.values) {
      const auto means = DecodeMeans(values);
      if (!means) continue;
      has_means = true;
      for (std::size_t i = 0; i < means->size(); ++i) {
        if (!(*means)[i]) continue;
        // Update the mean.
        const double before = errors.mean_mm[i].value_or(0);
        errors.mean_mm[i] = before + (*(*means)[i] - before) / ++errors.pairs[i];
      }
    }
    if (has_means) found.push_back(errors);
  }
  return found;
}

}  // namespace etude
