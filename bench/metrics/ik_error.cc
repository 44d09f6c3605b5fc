#include "bench/metrics/ik_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// `goal` in centimetres and in degrees.
bool AreWithin(const IkErrorSummary& errors, const IkAsked& asked, double goal) {
  return (!asked.positions || errors.position_max_cm < goal) && (!asked.axes || errors.axis_max_deg < goal);
}

}  // namespace

IkErrorSummary SummariseIkErrors(std::span<const EffectorError> errors) {
  assert(!errors.empty());
  IkErrorSummary summary;
  for (const EffectorError& error : errors) {
    const double cm = 100 * error.position;
    const glm::dvec3& angles = error.axis_angles;
    const double degrees = Degrees((angles.x + angles.y + angles.z) / 3);
    summary.position_cm += cm;
    summary.orientation_deg += degrees;
    summary.position_max_cm = std::max(summary.position_max_cm, cm);
    summary.orientation_max_deg = std::max(summary.orientation_max_deg, degrees);
    summary.axis_max_deg = std::max({summary.axis_max_deg, Degrees(angles.x), Degrees(angles.y), Degrees(angles.z)});
  }
  summary.position_cm /= static_cast<double>(errors.size());
  summary.orientation_deg /= static_cast<double>(errors.size());
  return summary;
}

bool IsSolvedPractically(const IkErrorSummary& errors, const IkAsked& asked) { return AreWithin(errors, asked, 0.1); }

bool IsSolvedTightly(const IkErrorSummary& errors, const IkAsked& asked) { return AreWithin(errors, asked, 1e-3); }

int CountLimitViolations(std::span<const double> angles, std::span<const AngleRange> limits) {
  assert(angles.size() == limits.size());
  constexpr double kRounding = Radians(1e-6);
  int count = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (std::max(limits[i].lower - angles[i], angles[i] - limits[i].upper) > kRounding) ++count;
  }
  return count;
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
