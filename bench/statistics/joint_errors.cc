#include "bench/statistics/joint_errors.h"

#include <array>
#include <map>

namespace etude {

std::vector<EvaluatedJoint> ErrorsByJoint(const RunData& run) {
  std::vector<EvaluatedJoint> found;
  std::vector<std::array<int, kByJoint.size()>> counts;  // number of pairs with a value, by alignment
  std::map<std::string, std::size_t> places;             // index in `found`, by scenario, condition, method and joint
  ForEachSeries(run, [&](const Row& row, const std::vector<Series>& series) {
    for (const Series& one : series) {
      const auto means = one.axis == kJointErrorAxis ? DecodeMeans(one.values) : std::nullopt;
      if (!means) continue;
      const std::string key = row.scenario + '/' + CompactLabel(row.condition) + '/' + row.method + '/' + one.name;
      const auto [place, is_new] = places.emplace(key, found.size());
      if (is_new) {
        found.push_back({row.condition, row.method, one.name, 0, {}});
        counts.emplace_back();
      }
      EvaluatedJoint& errors = found[place->second];
      ++errors.pairs;
      for (std::size_t i = 0; i < means->size(); ++i) {
        if (!(*means)[i]) continue;
        // Update the mean.
        const int count = ++counts[place->second][i];
        const double before = errors.mean_mm[i].value_or(0);
        errors.mean_mm[i] = before + (*(*means)[i] - before) / count;
      }
    }
  });
  return found;
}

}  // namespace etude
