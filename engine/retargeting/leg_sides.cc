#include "engine/retargeting/leg_sides.h"

#include <cmath>

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
  // The knee's bend about `left`. Depth sensors overextend straight knees, which is no evidence below 40°.
  constexpr double kCosineOf40 = 0.766;
  const double sine = glm::dot(axis, glm::cross(upper, along)), cosine = glm::dot(upper, along);
  const double size = std::sqrt(sine * sine + cosine * cosine);
  if (sine > 0 || (size > 0 && cosine < kCosineOf40 * size)) knees_ += sine / size;
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
