#include "engine/kinematics/solvers/ccd_anderson.h"

#include <algorithm>
#include <cmath>

#include "engine/kinematics/solvers/anderson_mixing.h"
#include "engine/kinematics/solvers/ccd_sweep.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/solvers/sweep_loop.h"

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

}  // namespace

IkSolution SolveCcdAnderson(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const CcdAndersonOptions& own) {
  const auto step = [](auto& sweep, IkRun& run) { return sweep.Step(run); };
  return MomentSweep::CanServe(options) ? RunSweeps<Accelerated<MomentSweep>>(tree, problem, options, step, own)
                                        : RunSweeps<Accelerated<AngleSweep>>(tree, problem, options, step, own);
}

}  // namespace etude
