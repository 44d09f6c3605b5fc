#include "tests/engine/kinematics/solvers/plain_gauss_newton.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/kinematics/solvers/gauss_newton_course.h"
#include "engine/kinematics/solvers/gauss_newton_tree.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "engine/kinematics/solvers/moment_sweep.h"

namespace etude {
namespace {

// Solves one problem; GaussNewtonCourse decides the actions.
class PlainSolver {
 public:
  PlainSolver(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
              const GaussNewtonOptions& own, IkRun& run, TreeState& state, TreeFrames& frames)
      : tree_(tree),
        problem_(problem),
        options_(options),
        own_(own),
        run_(run),
        state_(state),
        frames_(frames),
        step_(tree, problem.targets),
        course_(options, own, {}) {}

  void Solve() {
    // Measure the pose, get the next action, and perform it, until the course ends.
    using enum GaussNewtonCourse::Act;
    while (true) {
      const GaussNewtonCourse::Next next = LinearisePose();
      if (next.is_best) best_angles_ = state_.angles;
      switch (next.act) {
        case kStep:
          last_angles_ = state_.angles;
          FindChange(next);
          MoveByChange();
          break;
        case kGoBack:
          PlaceAt(last_angles_);
          break;
        case kSweep:
          if (next.restart > 0) Scatter(next.restart);
          Sweep(next.sweeps);
          break;
        case kTakeBest:
          PlaceAt(best_angles_);
          break;
        case kEnd:
          if (!course_.has_converged()) EndAtBest();
          return;
      }
    }
  }

 private:
  // Computes the residual of the pose, and asks the course for the next action.
  GaussNewtonCourse::Next LinearisePose() {
    const bool is_met = run_.HasConverged();
    return course_.Arrive(is_met ? 0 : step_.Build(frames_), is_met, [&] { return IsOutOfReach(tree_, problem_); });
  }

  // Computes the step within the ranges, with extra active-set passes if damping is small.
  void FindChange(const GaussNewtonCourse::Next& next) {
    const std::vector<double>& posture = next.to_start ? run_.start_angles() : state_.angles;
    change_ = step_.Solve(state_.angles, posture, run_.ranges(), next.damping);
    const int extra_passes = GaussNewtonCourse::HasExtraPasses(next.damping) ? own_.extra_passes : 0;
    for (int pass = 0; pass < extra_passes && !step_.is_exact(); ++pass) {
      change_ = step_.Solve(state_.angles, posture, run_.ranges(), next.damping);
    }
  }

  // Adds the changes to the angles. If one is too large, all are scaled down together.
  void MoveByChange() {
    double largest = 0;
    for (const double c : change_) largest = std::max(largest, std::abs(c));
    // If extreme weights or lengths cause an overflow, take no step.
    if (!std::ranges::all_of(change_, [](double c) { return std::isfinite(c); })) largest = 0;
    const double share = largest > kMaxTurn ? kMaxTurn / largest : 1;
    for (std::size_t d = 0; d < state_.angles.size() && largest > 0; ++d) {
      const AngleRange& range = run_.ranges()[d];
      state_.angles[d] = std::clamp(state_.angles[d] + share * change_[d], range.lower, range.upper);
    }
    Measure();
    course_.Stepped(largest);
  }

  void Scatter(int restart) {
    ScatterAround(run_.start_angles(), run_.ranges(), restart, state_.angles);
    Place();
  }

  void Sweep(int count) {
    const IkProblem from_here{state_, problem_.targets, run_.ranges()};
    MomentSweep sweep(tree_, from_here, GaussNewtonSweepOptions(options_));
    for (int i = 0; i < count; ++i) {
      sweep.Sweep();
      state_.angles = sweep.Angles();
      Measure();
      if (!course_.CountSweep() || run_.HasConverged()) break;
    }
  }

  void EndAtBest() {
    if (course_.HasStalled()) run_.Stall();
    run_.DiscardErrors();
    state_.angles = best_angles_;
  }

  void PlaceAt(const std::vector<double>& angles) {
    state_.angles = angles;
    Place();
  }

  // Computes the forward kinematics at a pose that was not produced by an iteration.
  void Place() {
    ComputeFrames(tree_, state_, frames_);
    run_.CountPass();
  }

  // Computes forward kinematics and errors after an iteration.
  void Measure() {
    ComputeFrames(tree_, state_, frames_);
    run_.RecordFrames(frames_, state_.angles);
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const IkOptions& options_;
  const GaussNewtonOptions& own_;
  IkRun& run_;
  TreeState& state_;
  TreeFrames& frames_;
  GaussNewtonStep step_;
  GaussNewtonCourse course_;
  std::span<const double> change_;  // the step, one number per angle
  std::vector<double> best_angles_, last_angles_;
};

// Fixed loop lengths without aliases let compilers vectorise these functions.

double DotSix(const double* a, const double* b) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]) + (a[4] * b[4] + a[5] * b[5]);
}

void Multiply(const double* __restrict matrix, const double* __restrict s, double* __restrict y) {
  for (int i = 0; i < 6; ++i) {
    y[i] = (matrix[i] * s[0] + matrix[6 + i] * s[1]) + (matrix[12 + i] * s[2] + matrix[18 + i] * s[3]) +
           (matrix[24 + i] * s[4] + matrix[30 + i] * s[5]);
  }
}

void SubtractOuter(const double* __restrict y, double scale, double* __restrict matrix) {
  for (int r = 0; r < 6; ++r) {
    const double share = scale * y[r];
    for (int i = 0; i < 6; ++i) matrix[6 * r + i] -= share * y[i];
  }
}

// Computes to += from.
template <int kSize>
void Add(const double* __restrict from, double* __restrict to) {
  for (int i = 0; i < kSize; ++i) to[i] += from[i];
}

void AddScaled(const double* __restrict from, double scale, double* __restrict to) {
  for (int i = 0; i < 6; ++i) to[i] += scale * from[i];
}

}  // namespace

IkSolution SolveGaussNewtonPlainly(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const GaussNewtonOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    PlainSolver(tree, problem, options, own, run, state, frames).Solve();
  });
}

GaussNewtonStep::GaussNewtonStep(const KinematicTree& tree, std::span<const EffectorTarget> targets)
    : tree_(tree),
      targets_(targets),
      inwards_(JointsInwards(tree)),
      hinges_(std::make_unique_for_overwrite<Hinge[]>(tree.limits.size())),
      effectors_(std::make_unique_for_overwrite<Quadratic[]>(tree.effectors.size())),
      limbs_(std::make_unique_for_overwrite<Quadratic[]>(tree.joints.size())),
      movements_(tree.joints.size()),
      change_(tree.limits.size()) {}

double GaussNewtonStep::Build(const TreeFrames& frames) {
  // Compute the screw of every hinge: its axis, and the velocity per radian of the moved limb's point that coincides
  // with the root joint.
  const glm::dvec3 p_WR = frames.joints[0].position;
  for (const int n : inwards_) {
    const TreeJoint& joint = tree_.joints[n];
    const glm::dvec3 p_RJ_W = frames.joints[n].position - p_WR;
    for (int d = joint.first_dof; d < joint.first_dof + joint.dof_count; ++d) {
      const glm::dvec3& axis = frames.dof_axes[d];
      const glm::dvec3 shift = glm::cross(p_RJ_W, axis);
      hinges_[d].screw = {axis.x, axis.y, axis.z, shift.x, shift.y, shift.z};
    }
  }
  // Compute the quadratic of every effector.
  double squares = 0;
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    squares += LineariseTarget(targets_[e], frames.effectors[e], p_WR, effectors_[e]);
  }
  return squares;
}

// Sets `out` to the cost of one target as a quadratic function of its limb's movement. Returns the target's part of
// |e|².
double GaussNewtonStep::LineariseTarget(const EffectorTarget& target, const LimbFrame& X_WE, const glm::dvec3& p_WR,
                                        Quadratic& out) {
  // Compute η and |e|²: `pull` is the weighted position error; `twist` is its moment about the root plus the axes'
  // errors.
  const double w = target.position_weight / (kPositionScale * kPositionScale);
  const glm::dvec3& u = target.axis_weights;
  const glm::dmat3 &R_WE = X_WE.axes, &R_WD = target.axes;
  const glm::dvec3 p_RE_W = X_WE.position - p_WR;
  const glm::dvec3 p_ED_W = target.position - X_WE.position;
  const glm::dvec3 pull = w * p_ED_W;
  glm::dvec3 twist = glm::cross(p_RE_W, pull);
  double squares = glm::dot(pull, p_ED_W);
  for (int k = 0; k < 3; ++k) {
    twist += u[k] * glm::cross(R_WE[k], R_WD[k]);
    squares += 2 * u[k] * (1 - glm::dot(R_WE[k], R_WD[k]));
  }
  // Compute Λ: the weighted square of the effector's translation, and of each axis's movement, which is the component
  // of the rotation normal to the axis.
  const double straight = w * glm::dot(p_RE_W, p_RE_W) + u.x + u.y + u.z;
  const glm::dvec3 lever = w * p_RE_W;
  std::array<double, 36>& m = out.matrix;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c <= r; ++c) {
      const double along = lever[r] * p_RE_W[c] + u.x * R_WE[0][r] * R_WE[0][c] + u.y * R_WE[1][r] * R_WE[1][c] +
                           u.z * R_WE[2][r] * R_WE[2][c];
      m[6 * r + c] = m[6 * c + r] = (r == c ? straight : 0) - along;
      m[6 * (3 + r) + 3 + c] = m[6 * (3 + c) + 3 + r] = r == c ? w : 0;
    }
    const int i = (r + 1) % 3, j = (r + 2) % 3;
    m[6 * r + 3 + r] = m[6 * (3 + r) + r] = 0;
    m[6 * i + 3 + j] = m[6 * (3 + j) + i] = -lever[r];
    m[6 * j + 3 + i] = m[6 * (3 + i) + j] = lever[r];
    out.vector[r] = twist[r];
    out.vector[3 + r] = pull[r];
  }
  return squares;
}

// Gathers the quadratics from the leaves to the root and eliminates every hinge on the way.
void GaussNewtonStep::EliminateInwards(double damping) {
  std::memset(limbs_.get(), 0, tree_.joints.size() * sizeof(Quadratic));  // a loop would cost as much as ten hinges
  for (std::size_t e = 0; e < targets_.size(); ++e) {
    Quadratic& limb = limbs_[tree_.effectors[e].joint];
    Add<36>(effectors_[e].matrix.data(), limb.matrix.data());
    Add<6>(effectors_[e].vector.data(), limb.vector.data());
  }
  for (const int n : inwards_) {
    const TreeJoint& joint = tree_.joints[n];
    Quadratic& limb = limbs_[n];
    // Eliminate the hinges of the joint, the outermost first.
    for (int d = joint.first_dof + joint.dof_count - 1; d >= joint.first_dof; --d) {
      Hinge& hinge = hinges_[d];
      Spatial y;
      Multiply(limb.matrix.data(), hinge.screw.data(), y.data());
      // The product sᵀΛs can be negative only because of rounding.
      hinge.scale = 1 / (damping + std::max(0.0, DotSix(y.data(), hinge.screw.data())));
      hinge.best = hinge.scale * (damping * hinge.pull + DotSix(limb.vector.data(), hinge.screw.data()));
      hinge.matrix_s = y;
      // A fixed hinge contributes a constant change; a free hinge contributes its best change for every movement.
      double change = hinge.side == Side::kLower ? hinge.lower : hinge.upper;
      if (hinge.side == Side::kFree) {
        change = hinge.best;
        SubtractOuter(y.data(), hinge.scale, limb.matrix.data());
      }
      AddScaled(y.data(), -change, limb.vector.data());
    }
    // Add the remaining quadratic to the parent limb.
    Quadratic& parent = limbs_[joint.parent];
    Add<36>(limb.matrix.data(), parent.matrix.data());
    Add<6>(limb.vector.data(), parent.vector.data());
  }
}

// Computes the change of every hinge from the root to the leaves, clamped to its range. Returns true if a hinge has
// changed sides.
bool GaussNewtonStep::SubstituteOutwards() {
  bool has_changed = false;
  movements_[0].fill(0);
  for (auto n = inwards_.rbegin(); n != inwards_.rend(); ++n) {
    const TreeJoint& joint = tree_.joints[*n];
    Spatial movement = movements_[joint.parent];
    for (int d = joint.first_dof; d < joint.first_dof + joint.dof_count; ++d) {
      Hinge& hinge = hinges_[d];
      const double best = hinge.best - hinge.scale * DotSix(hinge.matrix_s.data(), movement.data());
      const Side side = best < hinge.lower ? Side::kLower : best > hinge.upper ? Side::kUpper : Side::kFree;
      has_changed |= side != hinge.side;
      hinge.side = side;
      change_[d] = std::clamp(best, hinge.lower, hinge.upper);
      AddScaled(hinge.screw.data(), change_[d], movement.data());
    }
    movements_[*n] = movement;
  }
  return has_changed;
}

std::span<const double> GaussNewtonStep::Solve(std::span<const double> angles, std::span<const double> preferred,
                                               std::span<const AngleRange> ranges, double damping) {
  for (std::size_t d = 0; d < change_.size(); ++d) {
    hinges_[d].pull = preferred[d] - angles[d];
    hinges_[d].lower = ranges[d].lower - angles[d];
    hinges_[d].upper = ranges[d].upper - angles[d];
  }
  EliminateInwards(damping);
  is_exact_ = !SubstituteOutwards();
  return change_;
}

}  // namespace etude
