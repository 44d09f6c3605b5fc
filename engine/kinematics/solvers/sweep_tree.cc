#include "engine/kinematics/solvers/sweep_tree.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace etude {
namespace {

void Copy(const glm::dvec3& from, double (&to)[3]) {
  for (int k = 0; k < 3; ++k) to[k] = from[k];
}

// Returns true if every axis of the rotation is ± a coordinate axis.
bool SwapsAxes(const glm::dmat3& rotation) {
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (rotation[c][r] != 0 && std::abs(rotation[c][r]) != 1) return false;
    }
  }
  return true;
}

// A coordinate axis with a sign.
struct NamedAxis {
  int name = 0;
  double sign = 1;
};

NamedAxis NameOf(const glm::dvec3& axis) {
  const int name = axis.x != 0 ? 0 : axis.y != 0 ? 1 : 2;
  return {name, axis[name]};
}

// A step, and the length of the longest chain of steps that depend on the step. Steps with longer chains come first.
struct StepWithDepth {
  SweepTree::Step step;
  int depth = 0;
};

std::vector<SweepTree::Step> StepsOf(const KinematicTree& tree) {
  std::vector<bool> is_used(tree.joints.size());  // true if an effector lies beyond the joint
  for (const Effector& effector : tree.effectors) is_used[effector.joint] = true;
  for (std::size_t n = tree.joints.size() - 1; n > 0; --n) {
    if (is_used[n]) is_used[tree.joints[n].parent] = true;
  }
  std::vector<int> depths(tree.joints.size());  // for each joint: the number of steps up to the root, its own included
  std::vector<StepWithDepth> ordered;
  for (int n = 1; n < static_cast<int>(tree.joints.size()); ++n) {
    if (!is_used[n]) continue;
    const TreeJoint& joint = tree.joints[n];
    int& depth = depths[n];
    depth = depths[joint.parent];
    ordered.push_back({{.joint = n}, depth++});
    // The Z axis is nearest to the leaves: a turn about it does not move the joint's other axes.
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      ordered.push_back(
          {{.joint = n, .hinge = joint.first_dof + axis, .i = (axis + 1) % 3, .j = (axis + 2) % 3}, depth++});
    }
  }
  std::ranges::stable_sort(ordered, std::ranges::greater(), &StepWithDepth::depth);
  std::vector<SweepTree::Step> steps;
  for (const StepWithDepth& each : ordered) steps.push_back(each.step);
  return steps;
}

}  // namespace

SweepTree::SweepTree(const KinematicTree& tree) : steps(StepsOf(tree)) {
  NameAxes(tree);
  PlaceAxes();
  PlaceMoments();
}

void SweepTree::NameAxes(const KinematicTree& tree) {
  std::vector<glm::dmat3> R_LS;  // for each limb: the axes of the limb's frame S in its frame L
  for (const TreeJoint& from : tree.joints) {
    Joint& joint = joints.emplace_back();
    joint.parent = from.parent;
    const glm::dmat3 R_SP = from.parent < 0 ? glm::dmat3(1) : glm::transpose(R_LS[from.parent]);
    const glm::dmat3 R_SJ = R_SP * from.R_PJ;
    joint.is_aligned = SwapsAxes(R_SJ);
    R_LS.push_back(joint.is_aligned && from.parent >= 0 ? glm::transpose(R_SJ) : glm::dmat3(1));
    Copy(R_SP * from.p_PJ, joint.p_PJ);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) joint.R_PJ[r][c] = R_SJ[c][r];
    }
  }
  // Replace the two axes that each hinge turns by axes of the limb's frame S.
  for (Step& step : steps) {
    if (step.hinge < 0 || !joints[step.joint].is_aligned) continue;
    const NamedAxis i = NameOf(glm::transpose(R_LS[step.joint])[step.i]);
    const NamedAxis j = NameOf(glm::transpose(R_LS[step.joint])[step.j]);
    step.i = i.sign * j.sign > 0 ? i.name : j.name;  // different signs reverse the turn, so exchange the two axes
    step.j = i.sign * j.sign > 0 ? j.name : i.name;
  }
  // Express the effectors in the frames S.
  for (const etude::Effector& from : tree.effectors) {
    Effector& effector = effectors.emplace_back();
    effector.joint = from.joint;
    Copy(glm::transpose(R_LS[from.joint]) * from.p_LE, effector.p_LE);
    for (int k = 0; k < 3; ++k) {
      const NamedAxis axis = NameOf(R_LS[from.joint][k]);
      effector.names[k] = axis.name;
      effector.signs[k] = axis.sign;
    }
  }
}

// Assigns an index to every axis before and after every turn: a sweep needs all of them, so none may be overwritten.
void SweepTree::PlaceAxes() {
  for (int& axis : joints[0].axes) axis = axis_count++;
  for (std::size_t n = steps.size(); n-- > 0;) {
    Step& step = steps[n];
    Joint& joint = joints[step.joint];
    if (step.hinge < 0) {
      for (int k = 0; k < 3; ++k) {
        const bool is_parents = joint.is_aligned && joint.p_PJ[k] == 0;
        joint.base[k] = is_parents ? joints[joint.parent].axes[k] : axis_count++;
        joint.axes[k] = joint.base[k];
      }
      continue;
    }
    step.from = joint.axes[step.i];
    step.towards = joint.axes[step.j];
    step.turned = axis_count;
    joint.axes[step.i] = axis_count++;
    joint.axes[step.j] = axis_count++;
  }
}

// Assigns memory to moments. A limb shares its parent's memory, unless the parent already has moments to which the
// limb's moments are added.
void SweepTree::PlaceMoments() {
  for (Effector& effector : effectors) {
    Joint& joint = joints[effector.joint];
    effector.is_first = joint.moments < 0;
    if (effector.is_first) joint.moments = moments_count++;
  }
  for (const Step& step : steps) {
    if (step.hinge >= 0) continue;
    Joint& joint = joints[step.joint];
    Joint& parent = joints[joint.parent];
    joint.is_first = parent.moments < 0;
    if (joint.is_first) parent.moments = joint.moments;
  }
}

}  // namespace etude
