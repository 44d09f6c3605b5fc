#include "engine/transitions/joins/limbs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/directions.h"
#include "engine/base/smoothstep.h"

namespace etude {

LimbTurn TurnBetween(const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 normal = glm::cross(from, to);
  const double length = glm::length(normal);
  const double angle = AngleBetween(from, to);
  if (length > 0) return normal * (angle / length);
  if (angle == 0) return LimbTurn(0);
  const glm::dvec3 helper = std::abs(from.y) < std::abs(from.x) ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  return glm::normalize(glm::cross(from, helper)) * angle;
}

namespace {

/// The factors sin(a)/a and (1 − cos a)/a² of Rodrigues' formula, for an angle a.
struct TurnFactors {
  double sine = 1, versine = 0.5;
};

template <int kTerms>
TurnFactors SeriesOf(double squared) {
  static constexpr auto kFractions = [] {
    std::array<TurnFactors, kTerms> fractions{};
    for (int k = 1; k <= kTerms; ++k) {
      fractions[k - 1] = {.sine = 1.0 / (2 * k * (2 * k + 1)), .versine = 1.0 / ((2 * k + 1) * (2 * k + 2))};
    }
    return fractions;
  }();
  TurnFactors factors{.sine = 1, .versine = 1};
  for (int k = kTerms - 1; k >= 0; --k) {
    factors.sine = 1 - factors.sine * squared * kFractions[k].sine;
    factors.versine = 1 - factors.versine * squared * kFractions[k].versine;
  }
  factors.versine *= 0.5;
  return factors;
}

TurnFactors FactorsOf(double squared) {
  // Up to one radian, use power series: the omitted terms are below rounding, and series are faster than trigonometric
  // functions.
  if (squared < 0.06) return SeriesOf<5>(squared);
  if (squared < 1) return SeriesOf<9>(squared);
  const double angle = std::sqrt(squared);
  return {std::sin(angle) / angle, (1 - std::cos(angle)) / squared};
}

constexpr double kNothing = 1e-12;

glm::dvec3 AcrossOf(const glm::dvec3& v, const glm::dvec3& axis) { return v - axis * glm::dot(v, axis); }

glm::dvec3 AnyAcross(const glm::dvec3& axis) {
  const glm::dvec3 helper = std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  return glm::normalize(AcrossOf(helper, axis));
}

glm::dvec3 DirectionOr(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length = glm::length(v);
  return length > kNothing ? v / length : otherwise;
}

}  // namespace

glm::dvec3 Turned(const glm::dvec3& v, const LimbTurn& turn) {
  // Rotate the vector by Rodrigues' formula.
  const auto [sine, versine] = FactorsOf(glm::dot(turn, turn));
  const glm::dvec3 across = glm::cross(turn, v);
  return v + sine * across + versine * glm::cross(turn, across);
}

double TurnOnFloor(const glm::dvec3& from, const glm::dvec3& to) {
  return std::atan2(from.z * to.x - from.x * to.z, from.x * to.x + from.z * to.z + 0.0);
}

glm::dvec3 KneeOffset(const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle) {
  return AcrossOf(knee - hip, DirectionOr(ankle - hip, {0, -1, 0}));
}

glm::dvec3 CarriedOffset(const glm::dvec3& offset, const glm::dvec3& from, const glm::dvec3& to) {
  return Turned(offset, TurnBetween(from, to));
}

Leg SolveLeg(const glm::dvec3& hip, const glm::dvec3& ankle, double thigh, double shin, const glm::dvec3& pole) {
  const glm::dvec3 axis = DirectionOr(ankle - hip, {0, -1, 0});
  const double shortest = std::abs(thigh - shin) + kNothing;
  const double reach = std::clamp(glm::distance(hip, ankle), shortest, std::max(thigh + shin, shortest));
  const double along = (reach * reach + thigh * thigh - shin * shin) / (2 * reach);
  const double across = std::sqrt(std::max(thigh * thigh - along * along, 0.0));
  Leg leg;
  leg.knee = hip + along * axis + across * DirectionOr(AcrossOf(pole, axis), AnyAcross(axis));
  // Recompute the ankle from the shin's direction: near a straight leg, rounding must not change the shin's length.
  leg.ankle = leg.knee + shin * DirectionOr(hip + reach * axis - leg.knee, axis);
  return leg;
}

double LiftFor(double travel) {
  constexpr double kMaxLift_m = 0.05, kLiftPerMetre = 0.2;
  return travel <= kStill ? 0 : std::min(kMaxLift_m, kLiftPerMetre * (travel - kStill) + 0.02);
}

double HipDrop(const glm::dvec3& hip, const glm::dvec3& ankle, double reach) {
  constexpr double kMaxDrop = 0.10;
  const double floor = std::hypot(hip.x - ankle.x, hip.z - ankle.z);
  if (floor >= reach) return kMaxDrop;
  return std::clamp(hip.y - ankle.y - std::sqrt(reach * reach - floor * floor), 0.0, kMaxDrop);
}

std::vector<double> SmoothlyAbove(const std::vector<double>& needed) {
  const int count = static_cast<int>(needed.size());
  constexpr int kBlur = 2, kPasses = 2;
  const auto at = [&](const std::vector<double>& v, int i) { return v[std::clamp(i, 0, count - 1)]; };
  // Take the running maximum first, so that the blurred curve stays above `needed`.
  std::vector<double> curve(needed.size());
  for (int i = 0; i < count; ++i) {
    for (int k = -kBlur * kPasses; k <= kBlur * kPasses; ++k) curve[i] = std::max(curve[i], at(needed, i + k));
  }
  // Blur the curve.
  for (int pass = 0; pass < kPasses; ++pass) {
    const std::vector<double> sharp = curve;
    for (int i = 0; i < count; ++i) {
      curve[i] = 0;
      for (int k = -kBlur; k <= kBlur; ++k) curve[i] += at(sharp, i + k) / (2 * kBlur + 1);
    }
  }
  // Ramp the curve to 0 at both ends.
  const double ramp = std::max(std::min(8.0, (count - 1) / 2.0), 1.0);
  for (int i = 0; i < count; ++i) {
    curve[i] *= Smootherstep(i / ramp) * Smootherstep((count - 1 - i) / ramp);
  }
  return curve;
}

}  // namespace etude
