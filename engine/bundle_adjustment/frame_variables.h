#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "engine/bundle_adjustment/measurable_body.h"

namespace etude {

// Sizes of the root's parameter blocks; the rotation is a quaternion w, x, y, z.
inline constexpr int kPositionSize = 3, kTurnSize = 4;

/// The parameter blocks of one frame, which Ceres changes, and the body's points in the pose that these blocks
/// describe.
struct FrameVariables {
  std::array<double, kPositionSize> position{};
  std::array<double, kTurnSize> turn{};
  std::vector<double> angles;
  PlacedPoints placed;

  explicit FrameVariables(const TreeState& state)
      : position{state.root_position.x, state.root_position.y, state.root_position.z}, angles(state.angles) {
    const glm::dquat q = glm::normalize(glm::quat_cast(state.root_frame));
    turn = {q.w, q.x, q.y, q.z};
  }

  TreeState State() const {
    const glm::dquat q = glm::normalize(glm::dquat(turn[0], turn[1], turn[2], turn[3]));
    return {{position[0], position[1], position[2]}, glm::mat3_cast(q), angles};
  }
};

/// Writes rows of Jacobians: the derivative of a residual with respect to a point, times the derivatives of the point
/// with respect to the parameters that move it.
class PointGains {
 public:
  /// `first_block` is the first of the frame's three blocks (position, rotation, angles); `length_block` is −1 if
  /// lengths are fixed.
  PointGains(const FrameVariables& frame, int point, double** jacobians, int first_block, int length_block)
      : frame_(frame),
        gains_(frame.placed.gains_of(point)),
        jacobians_(jacobians),
        first_(first_block),
        length_block_(length_block) {}

  /// Adds the derivatives of a residual with respect to the parameter blocks to row `row`. `along` is the residual's
  /// derivative with respect to the point.
  void Add(int row, const glm::dvec3& along) const {
    const auto gain = [&](int column) { return glm::dot(along, gains_[column]); };
    // Fill the blocks of position, rotation, angles and lengths; a block is null if Ceres does not need it.
    if (double* block = jacobians_[first_]) {
      for (int k = 0; k < kPositionSize; ++k) block[row * kPositionSize + k] += gain(k);
    }
    if (double* block = jacobians_[first_ + 1]) AddTurn(block + row * kTurnSize, gain(3), gain(4), gain(5));
    const int angles = static_cast<int>(frame_.angles.size());
    if (double* block = jacobians_[first_ + 2]) {
      for (int k = 0; k < angles; ++k) block[row * angles + k] += gain(6 + k);
    }
    if (length_block_ < 0 || jacobians_[length_block_] == nullptr) return;
    const int lengths = frame_.placed.columns - 6 - angles;
    for (int k = 0; k < lengths; ++k) jacobians_[length_block_][row * lengths + k] += gain(6 + angles + k);
  }

 private:
  // TurnManifold rotates by twice its tangent d, and Ceres multiplies this row by ∂q/∂d, whose columns are orthonormal.
  // The row is therefore 2 · gain · (∂q/∂d)ᵀ.
  void AddTurn(double* cell, double gx, double gy, double gz) const {
    const auto& [w, x, y, z] = frame_.turn;
    cell[0] += 2 * (-x * gx - y * gy - z * gz);
    cell[1] += 2 * (w * gx + z * gy - y * gz);
    cell[2] += 2 * (-z * gx + w * gy + x * gz);
    cell[3] += 2 * (y * gx - x * gy + w * gz);
  }

  const FrameVariables& frame_;
  const glm::dvec3* gains_;
  double** jacobians_;
  const int first_, length_block_;
};

}  // namespace etude
