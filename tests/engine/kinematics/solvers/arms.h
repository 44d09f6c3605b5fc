#pragma once

#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Returns a chain of limbs along Z whose first joint is 1 m from the root. With one degree of freedom per joint, it
/// lies in the plane of Y and Z; positive angles rotate Z towards −Y.
inline KinematicTree Arm(const std::vector<double>& lengths, int dofs) {
  KinematicTree arm{.joints = {{.name = "root"}}};
  double above = 1;
  for (const double length : lengths) {
    arm.joints.push_back({.name = "joint",
                          .parent = static_cast<int>(arm.joints.size()) - 1,
                          .p_PJ = {0, 0, above},
                          .first_dof = arm.dof_count(),
                          .dof_count = dofs});
    arm.limits.insert(arm.limits.end(), static_cast<std::size_t>(dofs), {-kPi, kPi});
    above = length;
  }
  arm.effectors = {{"tip", static_cast<int>(lengths.size()), {0, 0, above}}};
  return arm;
}

/// Returns the problem of reaching a position from the angles `start`; the tip's axes do not matter.
inline IkProblem Reach(const KinematicTree& arm, std::vector<double> start, const glm::dvec3& place) {
  IkProblem problem{StandingState(arm), {EffectorTarget{.position = place, .axis_weights = glm::dvec3(0)}}, arm.limits};
  problem.start.angles = std::move(start);
  return problem;
}

/// Returns the tip's position for an arm of two hinges, by plane trigonometry.
inline glm::dvec3 TwoHingeTip(double upper, double lower, double first, double second) {
  return {0, -upper * std::sin(first) - lower * std::sin(first + second),
          1 + upper * std::cos(first) + lower * std::cos(first + second)};
}

/// Returns the elbow's angle that puts the tip at `distance` from the first joint, by the law of cosines.
inline double ElbowAngle(double upper, double lower, double distance) {
  return std::acos((distance * distance - upper * upper - lower * lower) / (2 * upper * lower));
}

/// Returns options with goals so small that angles can be compared.
inline IkOptions Exactly() {
  IkOptions options{.position_goal = 1e-10};
  options.max_iterations = 5000;
  return options;
}

}  // namespace etude
