#include "engine/kinematics/solvers/linear_targets.h"

#include <algorithm>
#include <cmath>

namespace etude {

void ComputeJacobian(const KinematicTree& tree, const TreeFrames& frames, TreeJacobian& out) {
  out.rows = TreeJacobian::kPerEffector * static_cast<int>(tree.effectors.size());
  out.values.assign(static_cast<std::size_t>(out.rows) * tree.dof_count(), 0.0);
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    for (int j = tree.effectors[e].joint; j >= 0; j = tree.joints[j].parent) {
      const TreeJoint& joint = tree.joints[j];
      const glm::dvec3 p_LE_W = frames.effectors[e].position - frames.joints[j].position;
      for (int dof = joint.first_dof; dof < joint.first_dof + joint.dof_count; ++dof) {
        const glm::dvec3& axis_W = frames.dof_axes[dof];
        const glm::dvec3 moves = glm::cross(axis_W, p_LE_W);
        double* cell = &out.values[static_cast<std::size_t>(dof) * out.rows + TreeJacobian::kPerEffector * e];
        for (int k = 0; k < 3; ++k) {
          cell[k] = moves[k];
          cell[3 + k] = axis_W[k];
        }
      }
    }
  }
}

LinearTargets::LinearTargets(const KinematicTree& tree, std::span<const EffectorTarget> targets)
    : tree_(tree), targets_(targets) {}

void LinearTargets::Build(const TreeFrames& frames) {
  ComputeJacobian(tree_, frames, all_);
  picked_.clear();
  residuals_.clear();
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const EffectorTarget& target = targets_[e];
    const LimbFrame& X_WE = frames.effectors[e];
    const int first = TreeJacobian::kPerEffector * static_cast<int>(e);
    // Add three rows for the position, along the world's axes.
    if (target.position_weight > 0) {
      const double scale = std::sqrt(target.position_weight) / kPositionScale;
      const glm::dvec3 gap = scale * (target.position - X_WE.position);
      for (int k = 0; k < 3; ++k) {
        glm::dvec3 along(0);
        along[k] = scale;
        picked_.push_back({first, along});
        residuals_.push_back(gap[k]);
      }
    }
    // Add up to three rows for the axes. A rotation by ω moves axis u_k by ω × u_k. The sum of squares Σ w_k |ω × u_k|²
    // is diagonal in the axes' own frame, so one row per axis is enough.
    const glm::dvec3& w = target.axis_weights;
    const glm::dvec3 weight(w.y + w.z, w.x + w.z, w.x + w.y);
    glm::dvec3 pull(0);
    for (int k = 0; k < 3; ++k) pull += w[k] * glm::cross(X_WE.axes[k], target.axes[k]);
    for (int k = 0; k < 3; ++k) {
      if (weight[k] <= 0) continue;
      const double scale = std::sqrt(weight[k]);
      picked_.push_back({first + 3, scale * X_WE.axes[k]});
      residuals_.push_back(glm::dot(X_WE.axes[k], pull) / scale);
    }
  }

  // Project the tree's Jacobian onto these rows.
  jacobian_.resize(picked_.size() * tree_.limits.size());
  double* cell = jacobian_.data();
  for (int dof = 0; dof < tree_.dof_count(); ++dof) {
    const double* column = all_.column(dof).data();
    for (const Row& row : picked_) {
      const double* v = column + row.first;
      *cell++ = row.along.x * v[0] + row.along.y * v[1] + row.along.z * v[2];
    }
  }
}

double LinearTargets::Cost(const TreeFrames& frames) const {
  double cost = 0;
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    const EffectorTarget& target = targets_[e];
    const glm::dvec3 gap = (target.position - frames.effectors[e].position) / kPositionScale;
    cost += target.position_weight * glm::dot(gap, gap);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 off = target.axes[k] - frames.effectors[e].axes[k];
      cost += target.axis_weights[k] * glm::dot(off, off);
    }
  }
  return cost;
}

double MoveWithin(std::span<const AngleRange> ranges, std::span<const double> angles, std::span<const double> step,
                  std::vector<double>& moved) {
  moved.resize(angles.size());
  double largest = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double angle = std::clamp(angles[i] + step[i], ranges[i].lower, ranges[i].upper);
    largest = std::max(largest, std::abs(angle - angles[i]));
    moved[i] = angle;
  }
  return largest;
}

void Shorten(std::span<double> step) {
  double largest = 0;
  for (const double turn : step) largest = std::max(largest, std::abs(turn));
  if (largest <= kMaxTurn) return;
  for (double& turn : step) turn *= kMaxTurn / largest;
}

}  // namespace etude
