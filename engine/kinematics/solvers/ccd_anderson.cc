#include "engine/kinematics/solvers/ccd_anderson.h"

#include <algorithm>
#include <cmath>

#include "engine/kinematics/solvers/ccd.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"

namespace etude {
namespace {

// Half tangents beyond this are of angles almost half a turn from their middle, where the tangent has its pole.
constexpr double kLargestHalfTangent = 100;

bool AreFarFromPole(std::span<const double> half_tangents) {
  return std::ranges::all_of(half_tangents, [](double t) { return std::abs(t) < kLargestHalfTangent; });
}

// CcdSweep, for weights that moments cannot carry, with the interface of MomentSweep.
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
  bool MissesGoals() const { return false; }  // sweeps from effector to effector measure errors anyway
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

// Sweeps, each followed by an extrapolation from the last ones.
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

  /// Returns the largest turn of the sweep itself. The caller counts one forward-kinematics pass, this any other.
  double Step(IkRun& run) {
    sweep_.ReadHalfTangents(now_);
    const double change = sweep_.Turn();
    sweep_.ReadHalfTangents(swept_);
    if (!AreFarFromPole(now_) || !AreFarFromPole(swept_)) {
      mixing_.Discard();
      sweep_.Measure();
      return change;
    }
    const double merit = sweep_.Merit();  // of the pose before, by the weights of this sweep
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

// A difference of which less than this part is new adds rounding only.
constexpr double kNewPart = 1e-10;

double Dot(std::span<const double> a, std::span<const double> b) {
  double sums[4] = {};  // independent, so that additions overlap
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

  // Gram–Schmidt, newest difference first: what f has along each new direction is taken off f at once, which keeps the
  // shares exact although directions are orthogonal to rounding only (Björck 1967).
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
  for (int r = rank - 1; r >= 0; --r) {
    shares_[r] /= parts_[r][r];
    for (int k = 0; k < r; ++k) shares_[k] -= shares_[r] * parts_[r][k];
    AddMultiple(out, -shares_[r], dg_[chosen_[r]]);
  }
}

// The newest pair, and how it differs from the one before.
void AndersonMixing::RecordPair(std::span<const double> x, std::span<const double> g) {
  if (has_last_ && memory_ > 0) {
    // The oldest difference makes room for the newest.
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
