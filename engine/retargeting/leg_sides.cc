#include "engine/retargeting/leg_sides.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {

void LegSides::Add(const glm::dvec3& left, const glm::dvec3& hip, const glm::dvec3& knee, const glm::dvec3& ankle,
                   const glm::dvec3& toe) {
  const glm::dvec3 thigh = hip - knee, shank = knee - ankle, foot = toe - ankle;
  for (const glm::dvec3& v : {left, thigh, shank, foot}) {
    if (glm::length(v) < 1e-6) return;
  }
  const glm::dvec3 axis = glm::normalize(left), along = glm::normalize(shank);
  feet_ += glm::dot(glm::cross(axis, along), glm::normalize(foot));
  const glm::dvec3 upper = glm::normalize(thigh);
  const double bend = std::atan2(glm::dot(axis, glm::cross(upper, along)), glm::dot(upper, along));  // about `left`
  constexpr double kOverextended = Radians(-40);  // depth sensors show straight knees so
  if (bend < kOverextended || bend > 0) knees_ += std::sin(bend);
  ++count_;
}

std::optional<double> LegSides::FeetForward() const {
  return count_ > 0 ? std::optional(feet_ / count_) : std::nullopt;
}

std::string_view LegSides::Backwards() const {
  constexpr double kUndecided = 0.35;
  if (count_ == 0 || feet_ > kUndecided * count_) return "";
  if (feet_ < -kUndecided * count_) return "the feet point backwards";
  return knees_ < -kUndecided * count_ ? "the knees bend backwards" : "";
}

}  // namespace etude
