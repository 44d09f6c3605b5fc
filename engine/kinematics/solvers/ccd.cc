#include "engine/kinematics/solvers/ccd.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/euler.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"

namespace etude {
namespace {

IkSolution SolveBySweeps(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                         CcdJoint joint_kind) {
  if (!FindFault(tree, problem, options).empty()) return BadInput(tree);
  IkRun run(tree, problem, options);
  CcdSweep ccd(tree, problem, options, joint_kind);
  run.Record(ccd.errors(), ccd.angles());
  while (run.MustGoOn()) {
    const double change = ccd.Sweep();
    run.Record(ccd.errors(), ccd.angles());
    if (change < options.stall_change) run.Stall();
  }
  return run.Finish({ccd.angles().begin(), ccd.angles().end()});
}

// Returns R · R_JL, where R is the rotation by `angle` about J's coordinate axis `axis`.
glm::dmat3 TurnedAbout(int axis, double angle, glm::dmat3 R_JL) {
  const double c = std::cos(angle), s = std::sin(angle);
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  for (int column = 0; column < 3; ++column) {
    const double x = R_JL[column][i], y = R_JL[column][j];
    R_JL[column][i] = c * x - s * y;
    R_JL[column][j] = s * x + c * y;
  }
  return R_JL;
}

}  // namespace

IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  return SolveBySweeps(tree, problem, options, CcdJoint::kWhole);
}

IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options) {
  if (!MomentSweep::CanServe(options)) return SolveBySweeps(tree, problem, options, CcdJoint::kHinges);
  return RunSweeps<MomentSweep>(tree, problem, options, [](MomentSweep& sweep, IkRun&) { return sweep.Sweep(); });
}

double HingeGain::At(double phi) const {
  const double c = std::cos(phi);
  return k1 * (1 - c) + k2 * c + k3 * std::sin(phi);
}

double HingeGain::Optimum() const {
  if (k3 == 0 && k2 == k1) return 0;
  return std::atan2(k3, k2 - k1);
}

double HingeGain::OptimumWithin(const AngleRange& range) const {
  if (k3 == 0 && k2 == k1) return 0;
  const double best = Optimum();
  for (const double phi : {best, best - 2 * kPi, best + 2 * kPi}) {
    if (phi >= range.lower && phi <= range.upper) return phi;
  }
  return At(range.upper) > At(range.lower) ? range.upper : range.lower;
}

CcdSweep::CcdSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind)
    : tree_(tree),
      problem_(problem),
      options_(options),
      joint_kind_(joint_kind),
      ranges_(AllowedRanges(problem, options)),
      effectors_below_(tree.joints.size()),
      state_(problem.start),
      errors_(tree.effectors.size()),
      weights_(tree.effectors.size()) {
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    for (int joint = tree.effectors[e].joint; joint >= 0; joint = tree.joints[joint].parent) {
      effectors_below_[joint].push_back(static_cast<int>(e));
    }
  }
  SetAngles(problem.start.angles);
  Measure();
}

double CcdSweep::Sweep() {
  const double change = Turn();
  Measure();
  return change;
}

double CcdSweep::Turn() {
  // Compute the weights of this sweep from the errors measured last.
  for (std::size_t e = 0; e < weights_.size(); ++e) {
    weights_[e] = ComputeWeights(options_.weights, errors_[e].position, errors_[e].axis_angles);
  }
  double largest = 0;
  for (int joint = static_cast<int>(tree_.joints.size()) - 1; joint >= 0; --joint) {
    if (tree_.joints[joint].dof_count == 0 || effectors_below_[joint].empty()) continue;
    if (options_.refresh == WeightRefresh::kJoint) UpdateWeightsBelow(joint);
    const bool whole = joint_kind_ == CcdJoint::kWhole && tree_.joints[joint].dof_count > 1;
    largest = std::max(largest, whole ? TurnWhole(joint) : TurnAsHinges(joint));
  }
  return largest;
}

void CcdSweep::Measure() {
  ComputeFrames(tree_, state_, frames_);
  for (std::size_t e = 0; e < errors_.size(); ++e) errors_[e] = ErrorOf(frames_.effectors[e], problem_.targets[e]);
}

double CcdSweep::Merit() const {
  double merit = 0;
  for (std::size_t e = 0; e < weights_.size(); ++e) {
    const EffectorTarget& target = problem_.targets[e];
    merit += weights_[e].position * target.position_weight * errors_[e].position * errors_[e].position;
    const glm::dvec3 chords = 2.0 * glm::sin(0.5 * errors_[e].axis_angles);
    merit += glm::dot(weights_[e].axes * target.axis_weights, chords * chords);
  }
  return merit;
}

void CcdSweep::SetAngles(std::span<const double> angles) {
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    state_.angles[i] = std::clamp(angles[i], ranges_[i].lower, ranges_[i].upper);
  }
}

void CcdSweep::UpdateWeightsBelow(int joint) {
  if (!IsAdaptive(options_.weights)) return;
  for (int e : effectors_below_[joint]) {
    const EffectorError error = ErrorOf(frames_.effectors[e], problem_.targets[e]);
    weights_[e] = ComputeWeights(options_.weights, error.position, error.axis_angles);
  }
}

HingeGain CcdSweep::GainAbout(const glm::dvec3& axis_W, int joint) const {
  const glm::dvec3& p_WJ = frames_.joints[joint].position;
  HingeGain gain;
  for (int e : effectors_below_[joint]) {
    const EffectorTarget& target = problem_.targets[e];
    const glm::dvec3 p_JE_W = frames_.effectors[e].position - p_WJ, p_JD_W = target.position - p_WJ;
    double position_weight = weights_[e].position * target.position_weight;
    if (options_.weights == WeightRule::kWangChen) position_weight *= WangChenFactor(p_JE_W, p_JD_W);
    gain.Add(position_weight, p_JE_W, p_JD_W, axis_W);
    const glm::dvec3 axis_weights = weights_[e].axes * target.axis_weights;
    for (int k = 0; k < 3; ++k) gain.Add(axis_weights[k], frames_.effectors[e].axes[k], target.axes[k], axis_W);
  }
  return gain;
}

// Rotates all effectors beyond a joint about that joint; `rotation` is given in the world.
void CcdSweep::TurnBelow(int joint, const glm::dmat3& rotation) {
  const glm::dvec3& p_WJ = frames_.joints[joint].position;
  for (int e : effectors_below_[joint]) {
    LimbFrame& X_WE = frames_.effectors[e];
    X_WE = {p_WJ + rotation * (X_WE.position - p_WJ), rotation * X_WE.axes};
  }
}

// Turns one degree of freedom (paper B, case 1). Returns the absolute change of its angle, radians.
double CcdSweep::TurnHinge(int joint, int axis) {
  if (options_.refresh == WeightRefresh::kDof) UpdateWeightsBelow(joint);
  const int dof = tree_.joints[joint].first_dof + axis;
  double& angle = state_.angles[dof];
  // The axis is still valid, because no joint nearer to the root has turned since the last forward kinematics.
  const glm::dvec3& axis_W = frames_.dof_axes[dof];
  const AngleRange left{ranges_[dof].lower - angle, ranges_[dof].upper - angle};
  const double turn = GainAbout(axis_W, joint).OptimumWithin(left);
  // (upper − angle) + angle may differ from upper by rounding.
  angle = std::clamp(angle + turn, ranges_[dof].lower, ranges_[dof].upper);
  TurnBelow(joint, AxisRotation(axis_W, turn));
  return std::abs(turn);
}

double CcdSweep::TurnAsHinges(int joint) {
  double largest = 0;
  // Begin with the axis nearest to the leaves, because a turn about it does not move the joint's other axes.
  for (int axis = tree_.joints[joint].dof_count - 1; axis >= 0; --axis) {
    largest = std::max(largest, TurnHinge(joint, axis));
  }
  return largest;
}

double CcdSweep::TurnWhole(int joint) {
  const TreeJoint& limb = tree_.joints[joint];
  const glm::dmat3& R_WJ = frames_.R_WJ[joint];
  glm::dvec3 angles = JointAngles(limb, state_.angles);
  const glm::dvec3 before = angles;
  glm::dmat3 R_JL = RotationXyz(angles);
  for (int axis = 0; axis < limb.dof_count; ++axis) {
    if (options_.refresh == WeightRefresh::kDof) UpdateWeightsBelow(joint);
    // Find the best turn about this axis, without limits.
    const double turn = GainAbout(R_WJ[axis], joint).Optimum();
    const glm::dmat3 best_R_JL = TurnedAbout(axis, turn, R_JL);
    // Clip the Euler angles of the turned joint.
    const glm::dvec3 best_angles = AnglesXyz(best_R_JL);
    for (int k = 0; k < 3; ++k) {
      const int dof = limb.first_dof + k;
      angles[k] = k < limb.dof_count ? ClampAngle(best_angles[k], ranges_[dof]) : 0;
    }
    const glm::dmat3 new_R_JL = angles == best_angles ? best_R_JL : RotationXyz(angles);
    TurnBelow(joint, R_WJ * new_R_JL * glm::transpose(R_JL) * glm::transpose(R_WJ));
    R_JL = new_R_JL;
  }
  double largest = 0;
  for (int k = 0; k < limb.dof_count; ++k) {
    state_.angles[limb.first_dof + k] = angles[k];
    largest = std::max(largest, std::abs(angles[k] - before[k]));
  }
  return largest;
}

namespace {

// If |tan((q − middle) / 2)| is larger, the angle q is almost half a turn from the middle of its range, near the
// tangent's pole.
constexpr double kMaxHalfTangent = 100;

bool AreFarFromPole(std::span<const double> half_tangents) {
  return std::ranges::all_of(half_tangents, [](double t) { return std::abs(t) < kMaxHalfTangent; });
}

// Gives `CcdSweep` the interface of `MomentSweep`, for weights that the moment form does not support.
class AngleSweep {
 public:
  AngleSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options)
      : sweep_(tree, problem, options, CcdJoint::kHinges), middles_(tree.limits.size()), angles_(tree.limits.size()) {
    const std::vector<AngleRange> ranges = AllowedRanges(problem, options);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const bool is_bounded = ranges[i].upper - ranges[i].lower < 2 * kPi;
      middles_[i] = is_bounded ? 0.5 * (ranges[i].lower + ranges[i].upper) : problem.start.angles[i];
    }
  }

  double Turn() { return sweep_.Turn(); }
  void Measure() { sweep_.Measure(); }
  double Merit() const { return sweep_.Merit(); }
  bool MissesGoals() const { return false; }  // errors are always measured here, so no shortcut is needed
  std::vector<double> Angles() const { return {sweep_.angles().begin(), sweep_.angles().end()}; }

  void ReadHalfTangents(std::span<double> out) const {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::tan(0.5 * (sweep_.angles()[i] - middles_[i]));
  }
  void SetHalfTangents(std::span<const double> half_tangents) {
    for (std::size_t i = 0; i < half_tangents.size(); ++i) {
      angles_[i] = middles_[i] + 2 * std::atan(half_tangents[i]);
    }
    sweep_.SetAngles(angles_);
  }

 private:
  CcdSweep sweep_;
  std::vector<double> middles_, angles_;
};

// A sweep followed by Anderson's extrapolation from the last sweeps.
template <class Sweep>
class Accelerated {
 public:
  Accelerated(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
              const CcdAndersonOptions& own)
      : sweep_(tree, problem, options),
        mixing_(tree.dof_count(), own.memory),
        now_(tree.dof_count()),
        swept_(tree.dof_count()),
        mixed_(tree.dof_count()) {}

  bool MissesGoals() const { return sweep_.MissesGoals(); }
  std::vector<double> Angles() const { return sweep_.Angles(); }

  /// Makes one iteration. Returns the largest turn of the sweep, radians. The caller counts one forward-kinematics
  /// pass; a second pass is counted here.
  double Step(IkRun& run) {
    sweep_.ReadHalfTangents(now_);
    const double change = sweep_.Turn();
    sweep_.ReadHalfTangents(swept_);
    // Near a pole of the tangent, use the plain sweep and restart the extrapolation.
    if (!AreFarFromPole(now_) || !AreFarFromPole(swept_)) {
      mixing_.Discard();
      sweep_.Measure();
      return change;
    }
    // Extrapolate. If that raises the weighted sum, go back to the plain sweep.
    const double merit = sweep_.Merit();  // at the pose before the sweep, with this sweep's weights
    mixing_.Extrapolate(now_, swept_, mixed_);
    sweep_.SetHalfTangents(mixed_);
    sweep_.Measure();
    if (!(sweep_.Merit() <= merit)) {
      sweep_.SetHalfTangents(swept_);
      sweep_.Measure();
      run.CountPass();
    }
    return change;
  }

 private:
  Sweep sweep_;
  AndersonMixing mixing_;
  std::vector<double> now_, swept_, mixed_;
};

// Skip a difference if its part that is orthogonal to all newer differences is shorter than this share of its length:
// such a part is mostly rounding error.
constexpr double kNewPart = 1e-10;

double Dot(std::span<const double> a, std::span<const double> b) {
  double sums[4] = {};  // four independent sums, whose additions a CPU can overlap
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4) {
    for (int k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  }
  for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

void AddMultiple(std::span<double> to, double factor, std::span<const double> of) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * of[i];
}

}  // namespace

IkSolution SolveCcdAnderson(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const CcdAndersonOptions& own) {
  const auto step = [](auto& sweep, IkRun& run) { return sweep.Step(run); };
  return MomentSweep::CanServe(options) ? RunSweeps<Accelerated<MomentSweep>>(tree, problem, options, step, own)
                                        : RunSweeps<Accelerated<AngleSweep>>(tree, problem, options, step, own);
}

AndersonMixing::AndersonMixing(int size, int memory)
    : memory_(memory),
      last_f_(size),
      last_g_(size),
      rest_(size),
      df_(memory, Vector(size)),
      dg_(memory, Vector(size)),
      basis_(memory, Vector(size)),
      parts_(memory, Vector(memory)),
      chosen_(memory),
      shares_(memory) {}

void AndersonMixing::Extrapolate(std::span<const double> x, std::span<const double> g, std::span<double> out) {
  RecordPair(x, g);
  std::ranges::copy(g, out.begin());

  // Gram–Schmidt orthogonalisation, newest difference first. The component of f along each new direction is subtracted
  // from f immediately; this keeps γ accurate although rounding makes the directions only nearly orthogonal (Björck
  // 1967).
  std::ranges::copy(last_f_, rest_.begin());
  int rank = 0;
  for (int i = 0; i < differences_; ++i) {
    Vector& direction = basis_[rank];
    direction = df_[i];
    for (int k = 0; k < rank; ++k) {
      parts_[rank][k] = Dot(basis_[k], direction);
      AddMultiple(direction, -parts_[rank][k], basis_[k]);
    }
    const double length = std::sqrt(Dot(direction, direction));
    if (!(length > kNewPart * std::sqrt(Dot(df_[i], df_[i])))) continue;
    for (double& entry : direction) entry /= length;
    parts_[rank][rank] = length;
    shares_[rank] = Dot(direction, rest_);
    AddMultiple(rest_, -shares_[rank], direction);
    chosen_[rank++] = i;
  }
  // Back-substitution gives γ of every chosen difference; subtract γ Δg.
  for (int r = rank - 1; r >= 0; --r) {
    shares_[r] /= parts_[r][r];
    for (int k = 0; k < r; ++k) shares_[k] -= shares_[r] * parts_[r][k];
    AddMultiple(out, -shares_[r], dg_[chosen_[r]]);
  }
}

// Stores the pair (x, g), and replaces the oldest stored difference by the difference from the pair before.
void AndersonMixing::RecordPair(std::span<const double> x, std::span<const double> g) {
  if (has_last_ && memory_ > 0) {
    // Put the newest difference in the place of the oldest one.
    std::rotate(df_.begin(), df_.end() - 1, df_.end());
    std::rotate(dg_.begin(), dg_.end() - 1, dg_.end());
    differences_ = std::min(differences_ + 1, memory_);
    for (std::size_t i = 0; i < g.size(); ++i) {
      df_[0][i] = (g[i] - x[i]) - last_f_[i];
      dg_[0][i] = g[i] - last_g_[i];
    }
  }
  for (std::size_t i = 0; i < g.size(); ++i) {
    last_f_[i] = g[i] - x[i];
    last_g_[i] = g[i];
  }
  has_last_ = true;
}

void AndersonMixing::Discard() {
  differences_ = 0;
  has_last_ = false;
}

}  // namespace etude
