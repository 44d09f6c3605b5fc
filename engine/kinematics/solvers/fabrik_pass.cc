#include "engine/kinematics/solvers/fabrik_pass.h"

#include <Eigen/Dense>
#include <cmath>

#include "engine/base/euler.h"

namespace etude {
namespace {

constexpr double kSmallest = 1e-12;  // metres, and parts of a length

Eigen::Vector3d ToEigen(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace

glm::dmat3 BestTurn(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) {
  glm::dvec3 longest(0);
  for (const glm::dvec3& v : from) {
    if (glm::length(v) > glm::length(longest)) longest = v;
  }
  if (glm::length(longest) < kSmallest) return glm::dmat3(1);
  const glm::dvec3 line = glm::normalize(longest);
  bool is_line = true;
  for (const glm::dvec3& v : from) {
    is_line = is_line && glm::length(glm::cross(line, v)) < 1e-9 * glm::length(longest);
  }
  if (is_line) {
    glm::dvec3 best(0);
    for (std::size_t i = 0; i < from.size(); ++i) best += glm::dot(from[i], line) * to[i];
    return glm::length(best) < kSmallest * glm::length(longest) ? glm::dmat3(1)
                                                                : SmallestRotation(line, glm::normalize(best));
  }
  // Kabsch 1976: the orthogonal matrix nearest to Σ to · fromᵀ, and no mirror image.
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) sum += ToEigen(to[i]) * ToEigen(from[i]).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = std::copysign(1.0, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  const Eigen::Matrix3d turn = svd.matrixU() * sign * svd.matrixV().transpose();
  glm::dmat3 result;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) result[column][row] = turn(row, column);
  }
  return result;
}

FabrikPass::FabrikPass(const KinematicTree& tree, std::span<const EffectorTarget> targets)
    : tree_(tree), targets_(targets), tips_(tree.joints.size()), desired_bases_(tree.joints.size()) {
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    if (targets[e].position_weight <= 0) continue;
    tips_[tree.effectors[e].joint].push_back({tree.effectors[e].p_LE, -1, static_cast<int>(e)});
  }
  // Children stand after their parents: when a limb's turn comes, all its tips are known.
  for (int limb = static_cast<int>(tree.joints.size()) - 1; limb > 0; --limb) {
    if (!tips_[limb].empty()) tips_[tree.joints[limb].parent].push_back({tree.joints[limb].p_PJ, limb, -1});
  }
}

void FabrikPass::Run(const TreeFrames& frames) {
  limbs_ = frames.joints;
  for (int limb = static_cast<int>(limbs_.size()) - 1; limb > 0; --limb) LayBackward(limb);
  for (int limb = 1; limb < static_cast<int>(limbs_.size()); ++limb) {
    const int above = tree_.joints[limb].parent;
    limbs_[limb].position = limbs_[above].position + limbs_[above].axes * tree_.joints[limb].p_PJ;
    if (tips_[limb].empty()) {
      // R_WL = R_WP R_PL, R_PL as it was.
      limbs_[limb].axes = limbs_[above].axes * glm::transpose(frames.joints[above].axes) * frames.joints[limb].axes;
    } else {
      LayForward(limb);
    }
  }
}

glm::dvec3 FabrikPass::DesiredPosition(const Tip& tip) const {
  return tip.effector >= 0 ? targets_[tip.effector].position : desired_bases_[tip.limb];
}

void FabrikPass::LayBackward(int limb) {
  const std::vector<Tip>& tips = tips_[limb];
  if (tips.empty()) return;
  glm::dvec3 middle(0), desired_middle(0);
  for (const Tip& tip : tips) {
    middle += tip.p_LT / static_cast<double>(tips.size());
    desired_middle += DesiredPosition(tip) / static_cast<double>(tips.size());
  }
  LimbFrame& frame = limbs_[limb];
  from_.assign(1, frame.axes * -middle);
  to_.assign(1, frame.position - desired_middle);
  for (const Tip& tip : tips) {
    from_.push_back(frame.axes * (tip.p_LT - middle));
    to_.push_back(DesiredPosition(tip) - desired_middle);
  }
  frame.axes = BestTurn(from_, to_) * frame.axes;
  desired_bases_[limb] = desired_middle - frame.axes * middle;
}

void FabrikPass::LayForward(int limb) {
  LimbFrame& frame = limbs_[limb];
  from_.clear();
  to_.clear();
  for (const Tip& tip : tips_[limb]) {
    from_.push_back(frame.axes * tip.p_LT);
    to_.push_back(DesiredPosition(tip) - frame.position);
  }
  frame.axes = BestTurn(from_, to_) * frame.axes;
}

}  // namespace etude
