#include "engine/kinematics/solvers/fabrik.h"

#include <algorithm>
#include <cmath>

#include "engine/base/euler.h"
#include "engine/base/nearest_rotation.h"
#include "engine/kinematics/solvers/ccd.h"
#include "engine/kinematics/solvers/ik_run.h"

namespace etude {
namespace {

constexpr double kMinLeverM = 1e-9;

// Turns the joints so that the limbs match the result of a FabrikPass as well as possible.
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

  // Changes `angles` so that the limbs follow the result of the passes. `frames` are the joints' coordinate frames at
  // `angles`.
  void Follow(const TreeFrames& frames, std::vector<double>& angles) {
    limbs_ = frames.joints;
    // First, turn every joint to fit the tips of its own limb; then, to fit all tips beyond the joint.
    for (int j = 1; j < static_cast<int>(led_.size()); ++j) {
      if (!led_[j].empty()) TurnJoint(j, std::span(led_[j]).first(1), angles);
    }
    for (int j = 1; j < static_cast<int>(led_.size()); ++j) TurnJoint(j, led_[j], angles);
  }

 private:
  // Turns each hinge of a joint to the angle that brings the tips of the `fitted` limbs nearest to their positions in
  // the pass.
  void TurnJoint(int j, std::span<const int> fitted, std::vector<double>& angles) {
    const TreeJoint& joint = tree_.joints[j];
    const glm::dmat3 R_WJ = limbs_[joint.parent].axes * joint.R_PJ;
    const glm::dvec3 p_WJ = limbs_[j].position;
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      const glm::dvec3 axis_W = DofAxis(joint, R_WJ, angles, axis);
      // Sum the gain over all tips of the fitted limbs.
      HingeGain gain;
      double lever = 0;
      for (const int limb : fitted) {
        const LimbFrame& X_WL = limbs_[limb];
        const LimbFrame& X_WD = pass_.limbs()[limb];  // the limb's frame after the passes
        for (const FabrikPass::Tip& tip : pass_.tips(limb)) {
          const glm::dvec3 p_JT_W = X_WL.position + X_WL.axes * tip.p_LT - p_WJ;
          gain.Add(1, p_JT_W, X_WD.position + X_WD.axes * tip.p_LT - p_WJ, axis_W);
          lever = std::max(lever, glm::length(glm::cross(axis_W, p_JT_W)));
        }
      }
      if (lever < kMinLeverM) continue;  // all tips lie on the axis
      // Turn by the best angle within the range, and rotate all limbs beyond the joint with it.
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
  std::vector<std::vector<int>> led_;  // for each joint: the limbs with tips that the joint moves, its own limb first
  std::vector<LimbFrame> limbs_;       // the limbs' current frames
};

constexpr double kTiny = 1e-12;  // tolerance: in metres, or as a fraction of a length

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

glm::dmat3 BestTurn(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to) {
  // If all vectors are parallel, the longest vector defines their line.
  glm::dvec3 longest(0);
  for (const glm::dvec3& v : from) {
    if (glm::length(v) > glm::length(longest)) longest = v;
  }
  if (glm::length(longest) < kTiny) return glm::dmat3(1);
  const glm::dvec3 line = glm::normalize(longest);
  bool is_line = true;
  for (const glm::dvec3& v : from) {
    is_line = is_line && glm::length(glm::cross(line, v)) < 1e-9 * glm::length(longest);
  }
  // If the vectors are parallel, return the smallest rotation that turns their line to the best direction.
  if (is_line) {
    glm::dvec3 best(0);
    for (std::size_t i = 0; i < from.size(); ++i) best += glm::dot(from[i], line) * to[i];
    return glm::length(best) < kTiny * glm::length(longest) ? glm::dmat3(1)
                                                            : SmallestRotation(line, glm::normalize(best));
  }
  // For general vectors, return the proper rotation nearest to Σ to · fromᵀ (Kabsch 1976).
  glm::dmat3 sum(0);
  for (std::size_t i = 0; i < from.size(); ++i) sum += glm::outerProduct(to[i], from[i]);
  return NearestRotationTo(sum).rotation;
}

FabrikPass::FabrikPass(const KinematicTree& tree, std::span<const EffectorTarget> targets)
    : tree_(tree), targets_(targets), tips_(tree.joints.size()), desired_bases_(tree.joints.size()) {
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    if (targets[e].position_weight <= 0) continue;
    tips_[tree.effectors[e].joint].push_back({tree.effectors[e].p_LE, -1, static_cast<int>(e)});
  }
  // Children are stored after their parents, so all tips of a limb are known when it is reached.
  for (int limb = static_cast<int>(tree.joints.size()) - 1; limb > 0; --limb) {
    if (!tips_[limb].empty()) tips_[tree.joints[limb].parent].push_back({tree.joints[limb].p_PJ, limb, -1});
  }
}

void FabrikPass::Run(const TreeFrames& frames) {
  limbs_ = frames.joints;
  // Run the backward pass, then the forward pass.
  for (int limb = static_cast<int>(limbs_.size()) - 1; limb > 0; --limb) LayBackward(limb);
  for (int limb = 1; limb < static_cast<int>(limbs_.size()); ++limb) {
    const int above = tree_.joints[limb].parent;
    limbs_[limb].position = limbs_[above].position + limbs_[above].axes * tree_.joints[limb].p_PJ;
    if (tips_[limb].empty()) {
      // A limb without tips keeps its rotation R_PL relative to its parent: R_WL = R_WP R_PL.
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
