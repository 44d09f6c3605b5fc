#include <algorithm>
#include <cmath>
#include <kdl/tree.hpp>
#include <kdl/treefksolverpos_recursive.hpp>
#include <kdl/treeiksolverpos_nr_jl.hpp>
#include <kdl/treeiksolverpos_online.hpp>
#include <kdl/treeiksolvervel_wdls.hpp>

#include "bench/peers/ik_peers.h"
#include "engine/kinematics/solvers/ik_run.h"

namespace etude {
namespace {

// The limit on the speed of the effectors, too high to have an effect. The online solver gave better results if only
// the change of the angles per step was limited (KdlSettings::max_turn).
constexpr double kUnlimitedSpeed = 1e3;

KDL::Vector ToVector(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
KDL::Rotation ToRotation(const glm::dmat3& m) { return {ToVector(m[0]), ToVector(m[1]), ToVector(m[2])}; }
glm::dvec3 FromVector(const KDL::Vector& v) { return {v.x(), v.y(), v.z()}; }
LimbFrame FromFrame(const KDL::Frame& f) {
  return {FromVector(f.p), glm::dmat3(FromVector(f.M.UnitX()), FromVector(f.M.UnitY()), FromVector(f.M.UnitZ()))};
}

std::string SegmentName(int joint, int axis) { return std::to_string(joint) + "xyz"[axis]; }

// Makes one KDL segment per degree of freedom, the smallest possible number, because KDL's recursion over the segments'
// names is slow. The first segment of a joint contains the joint's offset and rest rotation; the last segment of a limb
// contains its effector's offset.
KDL::Tree ToKdl(const KinematicTree& tree) {
  KDL::Tree made("root");
  const TreeState rest = StandingState(tree);
  std::vector<std::string> limb_names(tree.joints.size(), "root");  // name of each joint's last segment
  // Pose of each joint's limb relative to the joint's last segment.
  std::vector<KDL::Frame> offsets(tree.joints.size());
  for (std::size_t n = 0; n < tree.joints.size(); ++n) {
    const TreeJoint& joint = tree.joints[n];
    KDL::Frame base(ToRotation(joint.R_PJ), ToVector(joint.p_PJ));
    if (joint.parent < 0) {
      offsets[n] = KDL::Frame(ToRotation(rest.root_frame), ToVector(rest.root_position));
      continue;
    }
    base = offsets[joint.parent] * base;
    limb_names[n] = limb_names[joint.parent];
    for (int axis = 0; axis < joint.dof_count; ++axis) {
      KDL::Frame beyond = base;  // start of the next segment at angle zero
      if (axis == joint.dof_count - 1) {
        for (const Effector& effector : tree.effectors) {
          if (effector.joint == static_cast<int>(n)) beyond = beyond * KDL::Frame(ToVector(effector.p_LE));
        }
      }
      const KDL::Vector turn = base.M * KDL::Vector(axis == 0, axis == 1, axis == 2);
      const std::string name = SegmentName(static_cast<int>(n), axis);
      made.addSegment(KDL::Segment(name, KDL::Joint(name, base.p, turn, KDL::Joint::RotAxis), beyond), limb_names[n]);
      limb_names[n] = name;
      base = KDL::Frame::Identity();
    }
    offsets[n] = base;
  }
  return made;
}

class KdlPeer : public IkPeer {
 public:
  KdlPeer(const KinematicTree& tree, const KdlSettings& settings)
      : tree_(tree),
        settings_(settings),
        kdl_(ToKdl(tree)),
        lower_(tree.dof_count()),
        upper_(tree.dof_count()),
        q_(tree.dof_count()),
        found_(tree.dof_count()),
        fk_(kdl_),
        velocity_(kdl_, EndNames(tree)) {
    velocity_.setLambda(settings.damping);
    Eigen::MatrixXd weights = Eigen::MatrixXd::Identity(6 * tree.effectors.size(), 6 * tree.effectors.size());
    for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
      weights.diagonal().segment<3>(6 * e).setConstant(settings.position_weight);
    }
    velocity_.setWeightTS(weights);
    for (int i = 0; i < tree.dof_count(); ++i) {
      lower_(i) = tree.limits[i].lower;
      upper_(i) = tree.limits[i].upper;
    }
  }

  std::vector<LimbFrame> Effectors(std::span<const double> angles) override {
    std::ranges::copy(angles, q_.data.data());
    std::vector<LimbFrame> effectors;
    for (const std::string& name : EndNames(tree_)) {
      KDL::Frame frame;
      fk_.JntToCart(q_, frame, name);
      effectors.push_back(FromFrame(frame));
    }
    return effectors;
  }

 protected:
  static std::vector<std::string> EndNames(const KinematicTree& tree) {
    std::vector<std::string> names;
    for (const Effector& effector : tree.effectors) {
      names.push_back(SegmentName(effector.joint, tree.joints[effector.joint].dof_count - 1));
    }
    return names;
  }

  void Take(const IkProblem& problem) {
    std::ranges::copy(problem.start.angles, q_.data.data());
    const std::vector<std::string> names = EndNames(tree_);
    for (std::size_t e = 0; e < names.size(); ++e) {
      const EffectorTarget& target = problem.targets[e];
      targets_[names[e]] = KDL::Frame(ToRotation(target.axes), ToVector(target.position));
    }
  }
  static std::vector<double> ToAngles(const KDL::JntArray& q) { return {q.data.data(), q.data.data() + q.data.size()}; }

  const KinematicTree& tree_;
  const KdlSettings settings_;
  const KDL::Tree kdl_;
  KDL::JntArray lower_, upper_, q_, found_;
  KDL::Frames targets_;
  KDL::TreeFkSolverPos_recursive fk_;
  KDL::TreeIkSolverVel_wdls velocity_;
};

class KdlNewton final : public KdlPeer {
 public:
  using KdlPeer::KdlPeer;

  IkPeerAnswer Solve(const IkProblem& problem, const IkOptions& options) override {
    Take(problem);
    // KDL compares every component of a twist, in metres or radians, with a single limit.
    const double goal = std::min(options.position_goal, options.axis_goal) / std::sqrt(3.0);
    if (goal != goal_) {
      const int steps = settings_.restarts > 0 ? kStepsPerTry : options.max_iterations;
      solver_ = std::make_unique<KDL::TreeIkSolverPos_NR_JL>(kdl_, EndNames(tree_), lower_, upper_, fk_, velocity_,
                                                             steps, goal);
      goal_ = goal;
    }
    // If the solver is stuck, restart it from another pose. TRAC-IK does this for chains.
    for (int restart = 1; solver_->CartToJnt(q_, targets_, found_) < 0 && restart <= settings_.restarts; ++restart) {
      ScatterAround(problem.start.angles, problem.limits, restart, scattered_);
      std::ranges::copy(scattered_, q_.data.data());
    }
    return {ToAngles(found_)};
  }

 private:
  static constexpr int kStepsPerTry = 50;

  std::vector<double> scattered_;
  double goal_ = 0;
  std::unique_ptr<KDL::TreeIkSolverPos_NR_JL> solver_;
};

class KdlOnline final : public KdlPeer {
 public:
  KdlOnline(const KinematicTree& tree, const KdlSettings& settings) : KdlPeer(tree, settings) {
    KDL::JntArray fastest(tree.dof_count());
    fastest.data.setConstant(settings.max_turn);
    solver_ = std::make_unique<KDL::TreeIkSolverPos_Online>(tree.dof_count(), EndNames(tree), lower_, upper_, fastest,
                                                            kUnlimitedSpeed, kUnlimitedSpeed, fk_, velocity_);
  }

  IkPeerAnswer Solve(const IkProblem& problem, const IkOptions& options) override {
    Take(problem);
    TreeState state = problem.start;
    int step = 0;
    while (step++ < options.max_iterations) {
      solver_->CartToJnt(q_, targets_, found_);
      std::swap(q_.data, found_.data);
      state.angles = ToAngles(q_);
      ComputeFrames(tree_, state, frames_);
      MeasureErrors(frames_, problem.targets, errors_);
      if (FindWorst(errors_, problem.targets).Within(options)) break;
    }
    return {state.angles, std::min(step, options.max_iterations)};
  }

 private:
  std::unique_ptr<KDL::TreeIkSolverPos_Online> solver_;
  TreeFrames frames_;
  std::vector<EffectorError> errors_;
};

}  // namespace

std::unique_ptr<IkPeer> MakeKdlNewton(const KinematicTree& tree, const KdlSettings& settings) {
  return std::make_unique<KdlNewton>(tree, settings);
}

std::unique_ptr<IkPeer> MakeKdlOnline(const KinematicTree& tree, const KdlSettings& settings) {
  return std::make_unique<KdlOnline>(tree, settings);
}

}  // namespace etude
