#include "bench/peers/ik_peers.h"

namespace etude {
namespace {

std::vector<SimbodyModel::Joint> ToJoints(const KinematicTree& tree) {
  const TreeState standing = StandingState(tree);
  std::vector<SimbodyModel::Joint> joints;
  for (const TreeJoint& from : tree.joints) {
    SimbodyModel::Joint& joint = joints.emplace_back();
    joint.parent = from.parent;
    joint.base = {from.p_PJ, from.R_PJ};
    if (from.parent < 0) joint.base = {standing.root_position, standing.root_frame};
    joint.dof_count = from.dof_count;
    for (int axis = 0; axis < from.dof_count; ++axis) {
      joint.lower[axis] = tree.limits[from.first_dof + axis].lower;
      joint.upper[axis] = tree.limits[from.first_dof + axis].upper;
    }
  }
  return joints;
}

std::vector<SimbodyModel::Effector> ToEffectors(const KinematicTree& tree) {
  std::vector<SimbodyModel::Effector> effectors;
  for (const Effector& from : tree.effectors) effectors.push_back({from.joint, from.p_LE});
  return effectors;
}

class SimbodyPeer final : public IkPeer {
 public:
  SimbodyPeer(const KinematicTree& tree, const SimbodySettings& settings)
      : model_(ToJoints(tree), ToEffectors(tree), settings) {}

  std::vector<LimbFrame> Effectors(std::span<const double> angles) override {
    std::vector<LimbFrame> effectors;
    for (const SimbodyModel::Frame& frame : model_.Effectors(angles.data())) {
      effectors.push_back({frame.position, frame.axes});
    }
    return effectors;
  }

  IkPeerAnswer Solve(const IkProblem& problem, const IkOptions&) override {
    std::vector<SimbodyModel::Frame> targets;
    for (const EffectorTarget& target : problem.targets) targets.push_back({target.position, target.axes});
    return {model_.Assemble(problem.start.angles.data(), targets)};
  }

 private:
  SimbodyModel model_;
};

}  // namespace

std::unique_ptr<IkPeer> MakeSimbodyAssembler(const KinematicTree& tree, const SimbodySettings& settings) {
  return std::make_unique<SimbodyPeer>(tree, settings);
}

}  // namespace etude
