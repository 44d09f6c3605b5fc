#include "engine/kinematics/solvers/null_space_step.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

constexpr double kPositionScale = 0.30;  // metres that count as much as one radian
constexpr int kPerEffector = 6;
constexpr int kMostPasses = 10;
constexpr double kShare = 0.5;

}  // namespace

NullSpaceStep::NullSpaceStep(const KinematicTree& tree, std::span<const EffectorTarget> targets)
    : tree_(tree),
      targets_(targets),
      levers_(tree.effectors.size()),
      effectors_of_(tree.limits.size()),
      residuals_(tree.effectors.size()),
      right_(kPerEffector * tree.effectors.size()),
      change_(tree.limits.size()),
      is_frozen_(tree.limits.size()),
      rows_(kPerEffector * static_cast<int>(tree.effectors.size())) {
  for (std::size_t e = 0; e < levers_.size(); ++e) {
    for (int j = tree.effectors[e].joint; j >= 0; j = tree.joints[j].parent) {
      for (int axis = tree.joints[j].dof_count - 1; axis >= 0; --axis) {
        levers_[e].push_back({tree.joints[j].first_dof + axis, {}});
        effectors_of_[tree.joints[j].first_dof + axis].push_back(static_cast<int>(e));
      }
    }
    std::ranges::reverse(levers_[e]);
  }
  gram_.resize(static_cast<std::size_t>(rows_) * rows_);
  factor_.resize(gram_.size());
}

void NullSpaceStep::Build(const TreeFrames& frames) {
  for (std::size_t e = 0; e < levers_.size(); ++e) {
    const EffectorTarget& target = targets_[e];
    const LimbFrame& now = frames.effectors[e];
    // In the effector's own frame the information of its axes, Σ w_k (1 − u_k u_kᵀ), is diagonal.
    const glm::dvec3& w = target.axis_weights;
    const glm::dvec3 information(w.y + w.z, w.x + w.z, w.x + w.y);
    glm::dvec3 pull(0);
    for (int k = 0; k < 3; ++k) pull += w[k] * glm::cross(now.axes[k], target.axes[k]);
    const double position_scale = std::sqrt(target.position_weight) / kPositionScale;
    const glm::dvec3 gap = position_scale * (target.position - now.position);
    Column& residual = residuals_[e];
    glm::dvec3 scaled_axes[3];
    for (int k = 0; k < 3; ++k) {
      residual[k] = gap[k];
      scaled_axes[k] = std::sqrt(information[k]) * now.axes[k];
      residual[3 + k] = information[k] > 0 ? glm::dot(scaled_axes[k], pull) / information[k] : 0;
    }

    std::size_t next = levers_[e].size();
    for (int j = tree_.effectors[e].joint; j >= 0; j = tree_.joints[j].parent) {
      const TreeJoint& joint = tree_.joints[j];
      const glm::dvec3 arm = now.position - frames.joints[j].position;
      for (int axis = joint.dof_count - 1; axis >= 0; --axis) {
        Column& column = levers_[e][--next].column;
        const glm::dvec3& turn = frames.dof_axes[joint.first_dof + axis];
        const glm::dvec3 moves = position_scale * glm::cross(turn, arm);
        for (int k = 0; k < 3; ++k) {
          column[k] = moves[k];
          column[3 + k] = glm::dot(scaled_axes[k], turn);
        }
      }
    }
  }
  std::ranges::fill(gram_, 0.0);
  for (std::size_t e = 0; e < levers_.size(); ++e) {
    for (std::size_t f = 0; f <= e; ++f) {
      // Paths from the root agree up to where they part.
      for (std::size_t i = 0; i < std::min(levers_[e].size(), levers_[f].size()); ++i) {
        if (levers_[e][i].dof != levers_[f][i].dof) break;
        const Column &a = levers_[e][i].column, &b = levers_[f][i].column;
        for (int r = 0; r < kPerEffector; ++r) {
          double* row = &gram_[(kPerEffector * e + r) * rows_ + kPerEffector * f];
          for (int c = 0; c < kPerEffector; ++c) row[c] += a[r] * b[c];
        }
      }
    }
  }
}

bool NullSpaceStep::Factorise(double damping) {
  for (int i = 0; i < rows_; ++i) {
    double* row = &factor_[static_cast<std::size_t>(i) * rows_];
    const double* from = &gram_[static_cast<std::size_t>(i) * rows_];
    for (int j = 0; j <= i; ++j) {
      const double* other = &factor_[static_cast<std::size_t>(j) * rows_];
      double sum = from[j] + (i == j ? damping : 0);
      for (int k = 0; k < j; ++k) sum -= row[k] * other[k];
      if (i != j) {
        row[j] = sum * other[j];
      } else if (sum > 0) {
        row[i] = 1 / std::sqrt(sum);  // the diagonal holds reciprocals
      } else {
        return false;
      }
    }
  }
  return true;
}

void NullSpaceStep::Freeze(int dof, double change) {
  is_frozen_[dof] = 1;
  change_[dof] = change;
  const std::vector<int>& effectors = effectors_of_[dof];
  for (std::size_t n = 0; n < effectors.size(); ++n) {
    const auto lever = [&](int e) -> const Column& { return std::ranges::find(levers_[e], dof, &Lever::dof)->column; };
    const Column& a = lever(effectors[n]);
    for (std::size_t m = 0; m <= n; ++m) {
      const Column& b = lever(effectors[m]);
      for (int r = 0; r < kPerEffector; ++r) {
        double* row =
            &gram_[static_cast<std::size_t>(kPerEffector * effectors[n] + r) * rows_ + kPerEffector * effectors[m]];
        for (int c = 0; c < kPerEffector; ++c) row[c] -= a[r] * b[c];
      }
    }
  }
}

std::span<const double> NullSpaceStep::Solve(std::span<const double> angles, std::span<const double> wanted,
                                             std::span<const AngleRange> ranges, double damping) {
  std::ranges::fill(is_frozen_, 0);
  for (int pass = 0; pass < kMostPasses; ++pass) {
    for (std::size_t i = 0; i < change_.size(); ++i) {
      if (!is_frozen_[i]) change_[i] = wanted[i] - angles[i];
    }
    for (std::size_t e = 0; e < levers_.size(); ++e) {
      Column right = residuals_[e];
      for (const Lever& lever : levers_[e]) {
        for (int r = 0; r < kPerEffector; ++r) right[r] -= lever.column[r] * change_[lever.dof];
      }
      for (int r = 0; r < kPerEffector; ++r) right_[kPerEffector * e + r] = right[r];
    }
    if (!Factorise(damping)) return {};
    for (int i = 0; i < rows_; ++i) {
      const double* row = &factor_[static_cast<std::size_t>(i) * rows_];
      for (int k = 0; k < i; ++k) right_[i] -= row[k] * right_[k];
      right_[i] *= row[i];
    }
    for (int i = rows_ - 1; i >= 0; --i) {
      right_[i] *= factor_[static_cast<std::size_t>(i) * rows_ + i];
      for (int k = 0; k < i; ++k) right_[k] -= factor_[static_cast<std::size_t>(i) * rows_ + k] * right_[i];
    }
    for (std::size_t e = 0; e < levers_.size(); ++e) {
      for (const Lever& lever : levers_[e]) {
        if (is_frozen_[lever.dof]) continue;
        for (int r = 0; r < kPerEffector; ++r) change_[lever.dof] += lever.column[r] * right_[kPerEffector * e + r];
      }
    }
    double worst = 0;
    const auto beyond = [&](std::size_t i) {
      const double angle = angles[i] + change_[i];
      return std::max({0.0, ranges[i].lower - angle, angle - ranges[i].upper});
    };
    for (std::size_t i = 0; i < change_.size(); ++i) {
      if (!is_frozen_[i]) worst = std::max(worst, beyond(i));
    }
    if (worst == 0) break;
    for (std::size_t i = 0; i < change_.size(); ++i) {
      if (is_frozen_[i] || beyond(i) < kShare * worst) continue;
      const double angle = angles[i] + change_[i];
      Freeze(static_cast<int>(i), (angle < ranges[i].lower ? ranges[i].lower : ranges[i].upper) - angles[i]);
    }
  }
  return change_;
}

}  // namespace etude
