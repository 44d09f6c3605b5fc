#include "bench/metrics/ik_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {

IkErrorSummary SummariseIkErrors(std::span<const EffectorError> errors) {
  assert(!errors.empty());
  IkErrorSummary summary;
  for (const EffectorError& error : errors) {
    const double cm = 100 * error.position;
    const double degrees = Degrees((error.axis_angles.x + error.axis_angles.y + error.axis_angles.z) / 3);
    summary.position_cm += cm;
    summary.orientation_deg += degrees;
    summary.position_max_cm = std::max(summary.position_max_cm, cm);
    summary.orientation_max_deg = std::max(summary.orientation_max_deg, degrees);
  }
  summary.position_cm /= static_cast<double>(errors.size());
  summary.orientation_deg /= static_cast<double>(errors.size());
  return summary;
}

bool IsSolvedPractically(const IkErrorSummary& errors) {
  return errors.position_max_cm < 0.1 && errors.orientation_max_deg < 0.1;
}

bool IsSolvedTightly(const IkErrorSummary& errors) {
  return errors.position_max_cm < 1e-3 && errors.orientation_max_deg < 1e-3;
}

double HiddenAngleDifferenceDeg(std::span<const double> angles, std::span<const double> others) {
  assert(angles.size() == others.size() && !angles.empty());
  double sum = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double difference = std::remainder(angles[i] - others[i], 2 * kPi);
    sum += difference * difference;
  }
  return Degrees(std::sqrt(sum / static_cast<double>(angles.size())));
}

}  // namespace etude
