#include "engine/kinematics/solvers/moment_sweep.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

Rows<double> ToRows(const glm::dmat3& columns) {
  Rows<double> rows;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) rows.m[r][c] = columns[c][r];
  }
  return rows;
}

Triple<double> ToTriple(const glm::dvec3& v) { return {{v.x, v.y, v.z}}; }

Hinge<double> MakeHinge(double angle, const AngleRange& range) {
  const double middle = 0.5 * (range.lower + range.upper), half = 0.5 * (range.upper - range.lower);
  const double from_middle = std::clamp(angle, range.lower, range.upper) - middle;
  const bool is_bounded = half < kPi;
  return {std::cos(from_middle),
          std::sin(from_middle),
          std::cos(middle),
          std::sin(middle),
          is_bounded ? std::cos(half) : -2.0,
          std::sin(half)};
}

}  // namespace

SweepTree::SweepTree(const KinematicTree& tree) {
  for (const TreeJoint& from : tree.joints) {
    Joint& joint = joints.emplace_back();
    joint.parent = from.parent;
    joint.first_dof = from.first_dof;
    joint.dof_count = from.dof_count;
    joint.is_aligned = from.rest == glm::dmat3(1);
    for (int r = 0; r < 3; ++r) {
      joint.offset[r] = from.offset[r];
      for (int c = 0; c < 3; ++c) joint.rest[r][c] = from.rest[c][r];
    }
  }
  for (const etude::Effector& from : tree.effectors) {
    effectors.push_back({from.joint, {from.offset.x, from.offset.y, from.offset.z}});
  }
  // By the number of joints between a joint and the leaves below it.
  std::vector<int> height(joints.size(), -1);
  for (const Effector& effector : effectors) height[effector.joint] = std::max(height[effector.joint], 0);
  for (std::size_t n = joints.size() - 1; n > 0; --n) {
    if (height[n] >= 0) height[joints[n].parent] = std::max(height[joints[n].parent], height[n] + 1);
  }
  for (int h = 0; h <= *std::ranges::max_element(height); ++h) {
    for (std::size_t n = joints.size() - 1; n > 0; --n) {
      if (height[n] == h) order.push_back(static_cast<int>(n));
    }
  }
}

bool MomentSweep::CanServe(const IkOptions& options) {
  const bool same_at_every_joint = options.refresh == WeightRefresh::kSweep || !IsAdaptive(options.weights);
  return same_at_every_joint && options.weights != WeightRule::kWangChen;
}

MomentSweep::MomentSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)
    : problem_(problem),
      rule_(options.weights),
      ranges_(AllowedRanges(problem, options)),
      tree_(tree),
      limbs_(tree.joints.size()),
      goals_(tree.effectors.size()),
      moments_(tree.joints.size()),
      errors_(tree.effectors.size()) {
  for (std::size_t i = 0; i < ranges_.size(); ++i) hinges_.push_back(MakeHinge(problem.start.angles[i], ranges_[i]));
  for (std::size_t e = 0; e < goals_.size(); ++e) {
    goals_[e].axes = ToRows(problem.targets[e].axes);
    goals_[e].position = ToTriple(problem.targets[e].position);
  }
  limbs_[0] = {ToRows(problem.start.root_frame), ToTriple(problem.start.root_position)};
  UpdateLimbs();
}

double MomentSweep::Sweep() {
  for (std::size_t e = 0; e < goals_.size(); ++e) {
    const EffectorWeights weights = ComputeWeights(rule_, errors_[e].position, errors_[e].axis_angles);
    goals_[e].position_weight = weights.position * problem_.targets[e].position_weight;
    goals_[e].axis_weights = ToTriple(weights.axes * problem_.targets[e].axis_weights);
  }
  const double chord = SweepHinges<double>(tree_, limbs_, goals_, hinges_, moments_);
  UpdateLimbs();
  return std::sqrt(chord);
}

void MomentSweep::UpdateLimbs() {
  PlaceLimbs<double>(tree_, hinges_, limbs_);
  for (std::size_t e = 0; e < errors_.size(); ++e) {
    const SweepTree::Effector& effector = tree_.effectors[e];
    const LimbOf<double>& limb = limbs_[effector.joint];
    LimbFrame frame;
    for (int r = 0; r < 3; ++r) {
      frame.position[r] = limb.position.v[r];
      for (int c = 0; c < 3; ++c) {
        frame.position[r] += limb.axes.m[r][c] * effector.offset[c];
        frame.axes[c][r] = limb.axes.m[r][c];
      }
    }
    errors_[e] = ErrorOf(frame, problem_.targets[e]);
  }
}

std::vector<double> MomentSweep::Angles() const {
  std::vector<double> angles;
  for (std::size_t i = 0; i < hinges_.size(); ++i) {
    const double middle = 0.5 * (ranges_[i].lower + ranges_[i].upper);
    const double angle = middle + std::atan2(hinges_[i].s, hinges_[i].c);
    angles.push_back(std::clamp(angle, ranges_[i].lower, ranges_[i].upper));
  }
  return angles;
}

}  // namespace etude
