#include "engine/formats/rigid_targets.h"

#include <algorithm>
#include <cmath>

#include "engine/formats/number_rows.h"

namespace etude {
namespace {

constexpr std::size_t kPerTarget = 7;
constexpr double kMaxMetres = 20;

/// Returns the metres per unit of the file, guessed from its largest coordinate.
double UnitOf(const NumberRows& table) {
  double farthest = 0;
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    const double value = table.values[i];
    if (i % kPerTarget < 3 && !std::isnan(value)) farthest = std::max(farthest, std::abs(value));
  }
  return farthest > kMaxMetres ? 0.001 : 1.0;
}

}  // namespace

Result<std::vector<TargetFrame>> ReadRigidTargets(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const NumberRows table, ReadNumberRows(text, file));
  if (table.columns != kPerTarget * kBodyTargetCount) {
    return Fail({file}, "found {} values in this row; allowed for a recording of {} targets: {}", table.columns,
                kBodyTargetCount, kPerTarget * kBodyTargetCount);
  }
  const double unit = UnitOf(table);
  std::vector<TargetFrame> frames(table.RowCount());
  for (std::size_t t = 0; t < frames.size(); ++t) {
    for (std::size_t i = 0; i < kBodyTargetCount; ++i) {
      const auto v = table.Row(t).subspan(kPerTarget * i, kPerTarget);
      const glm::dquat rotation(v[6], v[3], v[4], v[5]);
      const double length = glm::length(rotation);
      if (std::isnan(v[0] + v[1] + v[2] + length) || length == 0) continue;
      constexpr double kTolerance = 0.1;
      if (std::abs(length - 1) > kTolerance) {
        return Fail({file, table.lines[t]}, "target {}: the quaternion has length {:.3g}; allowed: 1", i, length);
      }
      frames[t][i] = TargetPose{unit * glm::dvec3(v[0], v[1], v[2]), rotation / length};
    }
  }
  return frames;
}

}  // namespace etude
