#include "engine/kinematics/solvers/gauss_newton_tree.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

constexpr int kMostDofs = 3;  // of a joint

void NameAxes(const glm::dmat3& R_PJ, GaussNewtonTree::Joint& joint) {
  joint.renames_axes = true;
  for (int c = 0; c < 3; ++c) {
    int ones = 0;
    for (int r = 0; r < 3; ++r) {
      joint.R_PJ[c][r] = R_PJ[c][r];
      if (R_PJ[c][r] == 0) continue;
      joint.from[c] = r;
      joint.sign[c] = R_PJ[c][r];
      ones += std::abs(R_PJ[c][r]) == 1 ? 1 : 2;
    }
    joint.renames_axes &= ones == 1;
  }
}

// How many joints are above each other from a joint to the farthest leaf.
std::vector<int> JointHeights(const KinematicTree& tree) {
  std::vector<int> height(tree.joints.size());
  for (std::size_t n = tree.joints.size() - 1; n > 0; --n) {
    int& above = height[tree.joints[n].parent];
    above = std::max(above, height[n] + 1);
  }
  return height;
}

}  // namespace

std::vector<int> JointsInwards(const KinematicTree& tree) {
  const std::vector<int> height = JointHeights(tree);
  std::vector<int> inwards;
  inwards.reserve(tree.joints.size());
  for (int h = 0; h < height[0]; ++h) {
    for (std::size_t n = 1; n < tree.joints.size(); ++n) {
      if (height[n] == h) inwards.push_back(static_cast<int>(n));
    }
  }
  return inwards;
}

GaussNewtonTree::GaussNewtonTree(const KinematicTree& tree)
    : joints(tree.joints.size()), inwards(JointsInwards(tree)), dof_count(tree.dof_count()) {
  for (std::size_t n = 1; n < joints.size(); ++n) {
    const TreeJoint& from = tree.joints[n];
    joints[n].parent = from.parent;
    joints[n].first_dof = from.first_dof;
    joints[n].dof_count = from.dof_count;
    for (int k = 0; k < 3; ++k) joints[n].p_PJ[k] = from.p_PJ[k];
    NameAxes(from.R_PJ, joints[n]);
  }
  for (const etude::Effector& from : tree.effectors) {
    Effector& made = effectors.emplace_back(Effector{from.joint, {from.p_LE.x, from.p_LE.y, from.p_LE.z}});
    int& place = joints[from.joint].quadratic;
    made.is_first = place < 0;
    if (made.is_first) place = quadratic_count++;
  }
  for (const int n : inwards) {
    Joint& joint = joints[n];
    if (joint.quadratic < 0) {
      joint.quadratic = quadratic_count++;
      unasked.push_back(n);
    }
    int& place = joints[joint.parent].quadratic;
    if (place < 0) place = joint.quadratic;
  }
  const std::vector<int> heights = JointHeights(tree);
  for (auto first = inwards.begin(); first != inwards.end();) {
    const auto is_higher = [&](int n) { return heights[n] > heights[*first]; };
    const auto last = std::find_if(first, inwards.end(), is_higher);
    for (int turn = 1; turn <= kMostDofs; ++turn) {
      for (auto n = first; n != last; ++n) {
        if (turn <= joints[*n].dof_count) steps.push_back({*n, joints[*n].first_dof + joints[*n].dof_count - turn});
      }
    }
    for (auto n = first; n != last; ++n) {
      const int parent = joints[*n].parent;
      if (parent != 0 && joints[parent].quadratic != joints[*n].quadratic) steps.push_back({*n, -1});
    }
    first = last;
  }
}

}  // namespace etude
