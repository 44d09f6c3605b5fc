#include "engine/kinematics/solvers/lane_goals.h"

#include <algorithm>

#include "engine/kinematics/sine_cosine.h"

namespace etude {
namespace {

// Nearer to a goal than this share of it, and this far, rounding might decide.
constexpr double kDoubtfulShare = 1e-9, kDoubtfulRounding = 1e-14;

// In float goals are this share of what is asked for, and nothing is in doubt.
constexpr double kFloatShare = 0.9;

double SquareBelow(double goal) {
  const double certain = std::max(0.0, goal * (1 - kDoubtfulShare) - kDoubtfulRounding);
  return certain * certain;
}

}  // namespace

LaneGoals GoalsFor(const IkOptions& options, Precision precision) {
  const double position = options.position_goal, axis = options.axis_goal;
  // The chord of an angle is shorter than its arc.
  const double chord = 2 * ComputeSineCosine(0.5 * std::min(axis, kPi)).sine;
  if (precision == Precision::kDouble) {
    return {SquareBelow(position), position * position, SquareBelow(chord), axis * axis};
  }
  constexpr double kSquaredShare = kFloatShare * kFloatShare;
  const double squared_distance = kSquaredShare * position * position, squared_chord = kSquaredShare * chord * chord;
  return {squared_distance, squared_distance, squared_chord, squared_chord};
}

}  // namespace etude
