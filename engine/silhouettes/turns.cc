#include "engine/silhouettes/turns.h"

#include <algorithm>
#include <cmath>

#include "engine/kinematics/sine_cosine.h"

namespace etude {
namespace {

// Returns the state at `share` of the way from `a` to `b`; a share above 1 extrapolates.
TreeState Between(const TreeState& a, const TreeState& b, double share) {
  TreeState state = a;
  state.root_position += share * (b.root_position - a.root_position);
  state.root_frame = RotationBy(share * TurnOf(b.root_frame * glm::transpose(a.root_frame))) * a.root_frame;
  for (std::size_t i = 0; i < a.angles.size(); ++i) state.angles[i] += share * (b.angles[i] - a.angles[i]);
  return state;
}

}  // namespace

glm::dmat3 RotationBy(const glm::dvec3& turn) {
  const double angle = glm::length(turn);
  if (angle < 1e-12) return glm::dmat3(1);
  const glm::dvec3 n = turn / angle;
  const auto [s, c] = ComputeSineCosine(angle);
  const glm::dmat3 cross(glm::dvec3(0, n.z, -n.y), glm::dvec3(-n.z, 0, n.x), glm::dvec3(n.y, -n.x, 0));
  return glm::dmat3(1) + s * cross + (1 - c) * cross * cross;
}

glm::dvec3 TurnOf(const glm::dmat3& rotation) {
  const glm::dvec3 twice_sine(rotation[1][2] - rotation[2][1], rotation[2][0] - rotation[0][2],
                              rotation[0][1] - rotation[1][0]);
  const double sine = 0.5 * glm::length(twice_sine);
  const double cosine = 0.5 * (rotation[0][0] + rotation[1][1] + rotation[2][2] - 1);
  if (sine < 1e-12) return glm::dvec3(0);
  return (0.5 * std::atan2(sine, cosine) / sine) * twice_sine;
}

TreeState Moved(const KinematicTree& tree, const TreeState& state, std::span<const double> by) {
  TreeState moved = state;
  moved.root_position += glm::dvec3(by[0], by[1], by[2]);
  moved.root_frame = RotationBy({by[3], by[4], by[5]}) * state.root_frame;
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    moved.angles[i] = std::clamp(state.angles[i] + by[kRootDofs + i], tree.limits[i].lower, tree.limits[i].upper);
  }
  return moved;
}

TreeState MeanState(const TreeState& a, const TreeState& b) { return Between(a, b, 0.5); }

TreeState Extrapolated(const TreeState& before, const TreeState& last, double share) {
  return Between(before, last, 1 + share);
}

}  // namespace etude
