#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "bench/peers/ik_peers.h"
#include "engine/kinematics/sine_cosine.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {
namespace {

constexpr int kMaxDofs = 32, kMaxEffectors = 4, kRows = 6 * kMaxEffectors;

// These constants have the same values as in engine/kinematics/solvers/jacobian_solvers.cc.
constexpr double kMinFactor = 1e-2, kMaxFactor = 1e9, kMinMu = 1e-9;
constexpr double kMinProgress = 0.7, kSettledProgress = 1 - 1e-5;
constexpr int kMaxPatience = 6, kMaxPasses = 4;

struct Vector {
  double x = 0, y = 0, z = 0;
};
inline Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator*(double s, Vector a) { return {s * a.x, s * a.y, s * a.z}; }
inline double Dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vector Cross(Vector a, Vector b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector From(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Returns the dot product of `a` and `b` over the last rows: it begins with the SIMD vector (eight rows) that contains
// row `from`. Eight partial sums hide the latency of the additions.
constexpr int kSums = 8;
inline double DotRows(const double* a, const double* b, int from = 0) {
  double sums[kSums] = {};
  for (int r = from & ~(kSums - 1); r < kRows; r += kSums) {
    for (int k = 0; k < kSums; ++k) sums[k] += a[r + k] * b[r + k];
  }
  return ((sums[0] + sums[4]) + (sums[2] + sums[6])) + ((sums[1] + sums[5]) + (sums[3] + sums[7]));
}

struct Frame {
  Vector axes[3], position;
};
inline Vector Mix(const Frame& frame, Vector by) {
  return by.x * frame.axes[0] + (by.y * frame.axes[1] + by.z * frame.axes[2]);
}

struct Joint {
  int parent, first_dof, dof_count;
  Vector p_PJ, R_PJ[3];
};

struct Goal {
  Vector axes[3], position;
  // Factors of the rows of the Jacobian and the residuals: √weight / kPositionScale for positions, √(2 · weight) for
  // rotations (radians).
  double scale, axis_scale;
};

struct Pose {
  double angles[kMaxDofs];
  Vector dof_axes[kMaxDofs], dof_points[kMaxDofs];
  Frame ends[kMaxEffectors];
  double cost;
};

class DensePeer final : public IkPeer {
 public:
  explicit DensePeer(const KinematicTree& tree)
      : dofs_(tree.dof_count()), ends_(static_cast<int>(tree.effectors.size())), rows_(6 * ends_) {
    for (const TreeJoint& joint : tree.joints) {
      joints_.push_back({joint.parent,
                         joint.first_dof,
                         joint.dof_count,
                         From(joint.p_PJ),
                         {From(joint.R_PJ[0]), From(joint.R_PJ[1]), From(joint.R_PJ[2])}});
    }
    frames_.resize(joints_.size());
    std::fill_n(first_end_, kMaxDofs, ends_);
    for (int e = 0; e < ends_; ++e) {
      end_joints_[e] = tree.effectors[e].joint;
      p_LE_[e] = From(tree.effectors[e].p_LE);
      for (int n = end_joints_[e]; n >= 0; n = joints_[n].parent) {
        for (int d = joints_[n].first_dof; d < joints_[n].first_dof + joints_[n].dof_count; ++d) {
          moves_[d][e] = true;
          first_end_[d] = std::min(first_end_[d], e);
          last_end_[d] = e;
        }
      }
    }
    frames_[0] = {{From(tree.standing_root[0]), From(tree.standing_root[1]), From(tree.standing_root[2])}, {}};
  }

  std::vector<LimbFrame> Effectors(std::span<const double> angles) override {
    std::ranges::copy(angles, pose_.angles);
    Place(pose_);
    std::vector<LimbFrame> effectors;
    for (int e = 0; e < ends_; ++e) {
      LimbFrame& frame = effectors.emplace_back();
      frame.position = {pose_.ends[e].position.x, pose_.ends[e].position.y, pose_.ends[e].position.z};
      for (int k = 0; k < 3; ++k) {
        frame.axes[k] = {pose_.ends[e].axes[k].x, pose_.ends[e].axes[k].y, pose_.ends[e].axes[k].z};
      }
    }
    return effectors;
  }

  IkPeerAnswer Solve(const IkProblem& problem, const IkOptions& options) override {
    Take(problem, options);
    Place(pose_);
    Descend(kMinProgress);
    for (int restart = 1; restart <= kRestarts && MustGoOn(); ++restart) {
      ScatterAround(start_, problem.limits, restart, scattered_);
      std::ranges::copy(scattered_, pose_.angles);
      Place(pose_);
      Descend(kMinProgress);
    }
    if (MustGoOn()) {
      pose_ = best_;
      Place(pose_);
      Descend(kSettledProgress);
    }
    const Pose& found = is_met_ ? pose_ : best_;
    return {{found.angles, found.angles + dofs_}, steps_};
  }

 private:
  bool MustGoOn() const { return !is_met_ && steps_ < max_steps_; }

  void Take(const IkProblem& problem, const IkOptions& options) {
    start_.resize(dofs_);
    for (int d = 0; d < dofs_; ++d) {
      lower_[d] = problem.limits[d].lower;
      upper_[d] = problem.limits[d].upper;
      pose_.angles[d] = start_[d] = std::clamp(problem.start.angles[d], lower_[d], upper_[d]);
    }
    for (int e = 0; e < ends_; ++e) {
      const EffectorTarget& from = problem.targets[e];
      goals_[e] = {{From(from.axes[0]), From(from.axes[1]), From(from.axes[2])},
                   From(from.position),
                   std::sqrt(from.position_weight) / kPositionScale,
                   std::sqrt(2 * from.axis_weights.x)};
    }
    squared_goal_ = options.position_goal * options.position_goal;
    squared_chord_ = RulesFor(options, {}, Precision::kDouble).squared_chord_met;
    max_steps_ = options.max_iterations;
    steps_ = 0;
    is_met_ = false;
    best_.cost = std::numeric_limits<double>::infinity();
  }

  // Computes the forward kinematics and the cost of a pose.
  void Place(Pose& pose) {
    // For each joint: translate and rotate from the parent, then turn about each axis.
    for (std::size_t n = 1; n < joints_.size(); ++n) {
      const Joint& joint = joints_[n];
      const Frame& parent = frames_[joint.parent];
      Frame& frame = frames_[n];
      frame.position = parent.position + Mix(parent, joint.p_PJ);
      for (int k = 0; k < 3; ++k) frame.axes[k] = Mix(parent, joint.R_PJ[k]);
      for (int axis = 0; axis < joint.dof_count; ++axis) {
        const int d = joint.first_dof + axis, i = axis == 2 ? 0 : axis + 1, j = axis == 0 ? 2 : axis - 1;
        const auto [s, c] = ComputeSineCosine(pose.angles[d]);
        const Vector x = frame.axes[i], y = frame.axes[j];
        frame.axes[i] = c * x + s * y;
        frame.axes[j] = c * y - s * x;
        pose.dof_axes[d] = frame.axes[axis];
        pose.dof_points[d] = frame.position;
      }
    }
    // For each effector, add to the cost the weighted squares of its distance from the target and of the chords from
    // its axes to the target's axes.
    pose.cost = 0;
    double farthest = 0, longest = 0;
    for (int e = 0; e < ends_; ++e) {
      const Frame& limb = frames_[end_joints_[e]];
      const Goal& goal = goals_[e];
      Frame& end = pose.ends[e];
      end = limb;
      end.position = limb.position + Mix(limb, p_LE_[e]);
      const Vector gap = goal.position - end.position;
      const double squares = Dot(gap, gap);
      pose.cost += goal.scale * goal.scale * squares;
      if (goal.scale > 0) farthest = std::max(farthest, squares);
      for (int k = 0; k < 3; ++k) {
        const Vector chord = goal.axes[k] - end.axes[k];
        const double squared_chord = Dot(chord, chord);
        pose.cost += 0.5 * goal.axis_scale * goal.axis_scale * squared_chord;
        if (goal.axis_scale > 0) longest = std::max(longest, squared_chord);
      }
    }
    is_met_ = farthest < squared_goal_ && longest < squared_chord_;
  }

  // Computes the Jacobian J, the residuals e and JJᵀ. A column of J is zero except in the rows of the effectors that
  // the column's angle moves.
  void Linearise() {
    for (int e = 0; e < ends_; ++e) {
      const Goal& goal = goals_[e];
      const Frame& end = pose_.ends[e];
      const Vector gap = goal.scale * (goal.position - end.position);
      Vector turn;
      for (int k = 0; k < 3; ++k) turn = turn + Cross(end.axes[k], goal.axes[k]);
      turn = (goal.axis_scale / 2) * turn;
      const double values[6] = {gap.x, gap.y, gap.z, turn.x, turn.y, turn.z};
      std::memcpy(residuals_ + 6 * e, values, sizeof(values));
    }
    std::memset(gram_, 0, sizeof(gram_));
    for (int d = 0; d < dofs_; ++d) {
      double* column = jacobian_[d];
      std::memset(column, 0, sizeof(jacobian_[d]));
      for (int e = first_end_[d]; e <= last_end_[d] && e < ends_; ++e) {
        if (!moves_[d][e]) continue;
        const Goal& goal = goals_[e];
        const Vector move = goal.scale * Cross(pose_.dof_axes[d], pose_.ends[e].position - pose_.dof_points[d]);
        const Vector turn = goal.axis_scale * pose_.dof_axes[d];
        const double values[6] = {move.x, move.y, move.z, turn.x, turn.y, turn.z};
        std::memcpy(column + 6 * e, values, sizeof(values));
      }
      AddColumn(d, 1, gram_);
    }
  }

  void AddColumn(int d, double sign, double (&to)[kRows][kRows]) const {
    const double* column = jacobian_[d];
    const int begin = 6 * first_end_[d], end = 6 * last_end_[d] + 6;
    if (end - begin == 6) {
      for (int r = begin; r < end; ++r) {
        const double share = sign * column[r];
        for (int c = 0; c < 6; ++c) to[r][begin + c] += share * column[begin + c];
      }
      return;
    }
    for (int r = begin; r < end; ++r) {
      const double share = sign * column[r];
      for (int c = 0; c < kRows; ++c) to[r][c] += share * column[c];
    }
  }

  // Solves (JJᵀ + μI) y = duals_ in place, where J lacks the columns of the fixed angles. Gaussian elimination works on
  // the upper triangle, in whole SIMD vectors.
  bool SolveDuals(double mu) {
    std::memcpy(factor_, gram_, sizeof(gram_));
    for (int d = 0; d < dofs_; ++d) {
      if (sides_[d] != 0) AddColumn(d, -1, factor_);
    }
    for (int r = 0; r < rows_; ++r) factor_[r][r] += mu;
    for (int r = 0; r < rows_; ++r) {
      const double pivot = factor_[r][r];
      if (!(pivot > 0)) return false;
      const double inverse = 1 / pivot;
      inverses_[r] = inverse;
      for (int below = r + 1; below < rows_; ++below) {
        const double share = factor_[r][below] * inverse;
        const int from = below & ~7;  // start of a SIMD vector; entries left of the diagonal are not read
        for (int c = from; c < kRows; ++c) factor_[below][c] -= share * factor_[r][c];
        duals_[below] -= share * duals_[r];
      }
    }
    alignas(64) double found[kRows] = {};  // zero until known, so entries left of the diagonal add nothing
    for (int r = rows_ - 1; r >= 0; --r) found[r] = (duals_[r] - DotRows(factor_[r], found, r)) * inverses_[r];
    std::memcpy(duals_, found, sizeof(found));
    return true;
  }

  // Computes the step. Returns the largest change of an angle before the step is shortened, radians; 0 on failure.
  double FindStep(double mu) {
    // Active-set passes: solve with some angles fixed at their limits, until the set of fixed angles stays the same.
    std::memset(sides_, 0, sizeof(sides_));
    bool is_exact = false;
    for (int pass = 0; pass < kMaxPasses && !is_exact; ++pass) {
      std::memcpy(duals_, residuals_, sizeof(duals_));
      for (int d = 0; d < dofs_; ++d) {
        if (sides_[d] == 0) continue;
        const double fixed = (sides_[d] < 0 ? lower_[d] : upper_[d]) - pose_.angles[d];
        for (int r = 0; r < kRows; ++r) duals_[r] -= fixed * jacobian_[d][r];
      }
      if (!SolveDuals(mu)) return 0;
      is_exact = true;
      for (int d = 0; d < dofs_; ++d) {
        const double best = DotRows(jacobian_[d], duals_);
        const double lower = lower_[d] - pose_.angles[d], upper = upper_[d] - pose_.angles[d];
        const int side = best < lower ? -1 : best > upper ? 1 : 0;
        is_exact = is_exact && side == sides_[d];
        sides_[d] = side;
        step_[d] = std::clamp(best, lower, upper);
      }
    }
    // Shorten the step if an angle would turn too far, and apply it to the trial pose.
    double largest = 0;
    for (int d = 0; d < dofs_; ++d) largest = std::max(largest, std::abs(step_[d]));
    const double share = largest > kMaxTurn ? kMaxTurn / largest : 1;
    for (int d = 0; d < dofs_; ++d) {
      step_[d] *= share;
      trial_.angles[d] = std::clamp(pose_.angles[d] + step_[d], lower_[d], upper_[d]);
    }
    return largest;
  }

  // Returns the predicted gain |e|² − |e − J step|².
  double Gain() const {
    double moved[kRows] = {}, gain = 0;
    for (int d = 0; d < dofs_; ++d) {
      for (int r = 0; r < kRows; ++r) moved[r] += step_[d] * jacobian_[d][r];
    }
    for (int r = 0; r < kRows; ++r) gain += moved[r] * (2 * residuals_[r] - moved[r]);
    return gain;
  }

  // Reduces the cost by damped steps from the current pose. Ends when the problem is solved, when the steps are used
  // up, when kMaxPatience steps in a row have not reduced the cost below `progress` times the cost before them, when
  // the damping factor exceeds kMaxFactor, or when a step turns no angle by kMinTurn.
  void Descend(double progress) {
    double fallen_to = pose_.cost, factor = 1, growth = 2;
    bool has_moved = true;
    for (int left = kMaxPatience; left > 0 && factor <= kMaxFactor && MustGoOn();) {
      if (has_moved) Linearise();
      if (FindStep(std::max(kMinMu, factor * pose_.cost)) < kMinTurn) break;
      Place(trial_);
      ++steps_;
      // Accept or reject the step, and adapt the damping (Nielsen's rule).
      has_moved = trial_.cost < pose_.cost;
      if (has_moved) {
        const double surplus = 2 * (pose_.cost - trial_.cost) / Gain() - 1;
        factor = std::max(kMinFactor, factor * std::max(1.0 / 3, 1 - surplus * surplus * surplus));
        growth = 2;
        std::swap(pose_, trial_);
      } else {
        is_met_ = false;
        factor *= growth;
        growth *= 2;
      }
      // If the cost has fallen enough, allow kMaxPatience further steps; otherwise, allow one step less than before.
      if (pose_.cost < progress * fallen_to) {
        fallen_to = pose_.cost;
        left = kMaxPatience;
      } else {
        --left;
      }
    }
    if (pose_.cost < best_.cost) best_ = pose_;
  }

  static constexpr double kMinTurn = 1e-10;  // smallest turn that counts as a step, radians

  const int dofs_, ends_, rows_;
  std::vector<Joint> joints_;
  std::vector<Frame> frames_;
  int end_joints_[kMaxEffectors];
  Vector p_LE_[kMaxEffectors];
  bool moves_[kMaxDofs][kMaxEffectors] = {};
  int first_end_[kMaxDofs], last_end_[kMaxDofs] = {};
  Goal goals_[kMaxEffectors];
  double lower_[kMaxDofs], upper_[kMaxDofs];
  std::vector<double> start_, scattered_;
  double squared_goal_ = 0, squared_chord_ = 0;
  int max_steps_ = 0, steps_ = 0;
  bool is_met_ = false;
  Pose pose_, trial_, best_;
  alignas(64) double jacobian_[kMaxDofs][kRows], residuals_[kRows] = {};
  alignas(64) double gram_[kRows][kRows], factor_[kRows][kRows];
  alignas(64) double duals_[kRows];
  double inverses_[kRows], step_[kMaxDofs];
  int sides_[kMaxDofs];
};

}  // namespace

std::unique_ptr<IkPeer> MakeDensePeer(const KinematicTree& tree) { return std::make_unique<DensePeer>(tree); }

const char* DensePeerFlags() { return ETUDE_RIVAL_FLAGS; }

}  // namespace etude
