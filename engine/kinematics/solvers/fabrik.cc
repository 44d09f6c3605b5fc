#include "engine/kinematics/solvers/fabrik.h"

#include <algorithm>
#include <cmath>

#include "engine/base/euler.h"
#include "engine/kinematics/solvers/fabrik_pass.h"
#include "engine/kinematics/solvers/hinge_gain.h"
#include "engine/kinematics/solvers/ik_run.h"

namespace etude {
namespace {

constexpr double kSmallestLever = 1e-9;  // metres

// Turns the joints so that the limbs come to lie as a FabrikPass laid them.
class Follower {
 public:
  Follower(const KinematicTree& tree, std::span<const AngleRange> ranges, const FabrikPass& pass)
      : tree_(tree), ranges_(ranges), pass_(pass), led_(tree.joints.size()) {
    for (int limb = static_cast<int>(tree.joints.size()) - 1; limb > 0; --limb) {
      if (pass.tips(limb).empty()) continue;
      for (int j = limb; j > 0; j = tree.joints[j].parent) led_[j].push_back(limb);
    }
    for (std::vector<int>& limbs : led_) std::ranges::reverse(limbs);
  }

  // Sets `angles`, which are those of `frames`.
  void Follow(const TreeFrames& frames, std::vector<double>& angles) {
    limbs_ = frames.joints;
    for (int j = 1; j < static_cast<int>(led_.size()); ++j) {
      if (!led_[j].empty()) TurnJoint(j, std::span(led_[j]).first(1), angles);
    }
    for (int j = 1; j < static_cast<int>(led_.size()); ++j) TurnJoint(j, led_[j], angles);
  }

 private:
  // Turns each hinge of a joint to the angle that brings the tips of the `judged` limbs nearest to where they were
  // laid.
  void TurnJoint(int j, std::span<const int> judged, std::vector<double>& angles) {
    const TreeJoint& joint = tree_.joints[j];
    const glm::dmat3 R_WJ = limbs_[joint.parent].axes * joint.R_PJ;
    const glm::dvec3 p_WJ = limbs_[j].position;
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      const glm::dvec3 axis_W = DofAxis(joint, R_WJ, angles, axis);
      HingeGain gain;
      double lever = 0;
      for (const int limb : judged) {
        const LimbFrame& X_WL = limbs_[limb];
        const LimbFrame& X_WD = pass_.limbs()[limb];  // as it was laid
        for (const FabrikPass::Tip& tip : pass_.tips(limb)) {
          const glm::dvec3 p_JT_W = X_WL.position + X_WL.axes * tip.p_LT - p_WJ;
          gain.Add(1, p_JT_W, X_WD.position + X_WD.axes * tip.p_LT - p_WJ, axis_W);
          lever = std::max(lever, glm::length(glm::cross(axis_W, p_JT_W)));
        }
      }
      if (lever < kSmallestLever) continue;  // it moves none of them
      double& angle = angles[joint.first_dof + axis];
      const AngleRange& range = ranges_[joint.first_dof + axis];
      const double best = angle + gain.OptimumWithin({range.lower - angle, range.upper - angle});
      const double turned = std::clamp(best, range.lower, range.upper) - angle;
      angle += turned;
      const glm::dmat3 rotation = AxisRotation(axis_W, turned);
      for (const int limb : led_[j]) {
        limbs_[limb].position = p_WJ + rotation * (limbs_[limb].position - p_WJ);
        limbs_[limb].axes = rotation * limbs_[limb].axes;
      }
    }
  }

  const KinematicTree& tree_;
  std::span<const AngleRange> ranges_;
  const FabrikPass& pass_;
  std::vector<std::vector<int>> led_;  // by each joint: the limbs it moves that lead to a target, its own first
  std::vector<LimbFrame> limbs_;       // as they are now
};

}  // namespace

IkSolution SolveFabrik(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    FabrikPass pass(tree, problem.targets);
    Follower follower(tree, run.ranges(), pass);
    std::vector<double> before;
    while (run.MustGoOn()) {
      before = state.angles;
      pass.Run(frames);
      follower.Follow(frames, state.angles);
      double largest = 0;
      for (std::size_t i = 0; i < before.size(); ++i) {
        largest = std::max(largest, std::abs(state.angles[i] - before[i]));
      }
      if (largest < options.stall_change) run.Stall();
      ComputeFrames(tree, state, frames);
      run.RecordFrames(frames, state.angles);
    }
  });
}

}  // namespace etude
