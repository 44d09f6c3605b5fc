#include "engine/kinematics/solvers/levenberg_marquardt.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "engine/kinematics/solvers/damped_inverse.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {
namespace {

// Nielsen's factor on the damping. Below the least, damping no longer keeps steps short where the residual stays large.
constexpr double kLeastFactor = 1e-2, kMostFactor = 1e9;
constexpr double kFirstGrowth = 2;
// JJᵀ of limbs at their limits is singular: less damping than this is none.
constexpr double kLeastMu = 1e-9;

// A descent is stuck when so many steps have not brought the sum of squares down to a share; when iterations are few, a
// part of them counts, so that restarts get theirs.
constexpr int kMostPatience = 6;
constexpr int kPartOfIterations = 5;
constexpr double kDescends = 0.7;
constexpr double kHasSettled = 1 - 1e-5;  // instead, where targets cannot be met

class Minimiser {
 public:
  Minimiser(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, double damping_share,
            IkRun& run, TreeState& state, TreeFrames& frames)
      : tree_(tree),
        problem_(problem),
        options_(options),
        damping_share_(damping_share),
        run_(run),
        state_(state),
        frames_(frames),
        linear_(tree, problem.targets),
        trial_(state),
        trial_frames_(frames),
        no_preference_(state.angles.size(), 0.0),
        best_angles_(state.angles) {}

  void Minimise() {
    const int patience = std::clamp(options_.max_iterations / kPartOfIterations, 1, kMostPatience);
    Descend(kDescends, patience);
    const int restarts = run_.MustGoOn() && !IsOutOfReach(tree_, problem_) ? kRestarts : 0;
    for (int restart = 1; restart <= restarts && run_.MustGoOn(); ++restart) {
      ScatterAround(run_.start_angles(), run_.ranges(), restart, state_.angles);
      Place();
      Descend(kDescends, patience);
    }
    if (run_.MustGoOn()) {
      state_.angles = best_angles_;
      Place();
      Descend(kHasSettled, kMostPatience);
    }
    if (run_.HasConverged()) return;
    if (run_.iterations() < options_.max_iterations) run_.Stall();
    run_.DiscardErrors();
    state_.angles = best_angles_;
  }

 private:
  /// Forward kinematics of angles that are not the outcome of an iteration.
  void Place() {
    ComputeFrames(tree_, state_, frames_);
    run_.CountPass();
  }

  /// Steps from `state_` until the targets are met, or `patience` steps have not brought the sum down to `progress`.
  void Descend(double progress, int patience) {
    double cost = linear_.Cost(frames_), fallen_to = cost;
    double factor = 1, growth = kFirstGrowth;
    bool has_moved = true;
    for (int left = patience; left > 0 && factor <= kMostFactor && run_.MustGoOn();) {
      if (has_moved) Linearise();
      if (FindStep(std::max(kLeastMu, factor * damping_share_ * cost)) < options_.stall_change) break;
      ComputeFrames(tree_, trial_, trial_frames_);
      const double trial_cost = linear_.Cost(trial_frames_);
      has_moved = trial_cost < cost;
      if (has_moved) {
        const double surplus = 2 * (cost - trial_cost) / inverse_.Gain(step_) - 1;
        factor = std::max(kLeastFactor, factor * std::max(1.0 / 3, 1 - surplus * surplus * surplus));
        growth = kFirstGrowth;
        std::swap(state_.angles, trial_.angles);
        std::swap(frames_, trial_frames_);
        cost = trial_cost;
      } else {
        factor *= growth;
        growth *= 2;
      }
      run_.RecordFrames(frames_, state_.angles);
      if (cost < progress * fallen_to) {
        fallen_to = cost;
        left = patience;
      } else {
        --left;
      }
    }
    if (cost < best_cost_) {
      best_cost_ = cost;
      best_angles_ = state_.angles;
    }
  }

  void Linearise() {
    linear_.Build(frames_);
    inverse_.Build(linear_);
  }

  /// Sets `trial_` to where the step with damping `mu` leads. Returns the largest change of an angle, 0 without a step.
  double FindStep(double mu) {
    if (!inverse_.StepWithin(mu, no_preference_, state_.angles, run_.ranges(), step_)) return 0;
    Shorten(step_);
    return MoveWithin(run_.ranges(), state_.angles, step_, trial_.angles);
  }

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const IkOptions& options_;
  const double damping_share_;
  IkRun& run_;
  TreeState& state_;
  TreeFrames& frames_;
  LinearTargets linear_;
  DampedInverse inverse_;
  TreeState trial_;
  TreeFrames trial_frames_;
  std::vector<double> step_;
  const std::vector<double> no_preference_;  // a step stays near to where it begins
  double best_cost_ = std::numeric_limits<double>::infinity();
  std::vector<double> best_angles_;
};

}  // namespace

IkSolution SolveLevenbergMarquardt(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const LevenbergMarquardtOptions& own) {
  return RunFromStart(tree, problem, options, [&](IkRun& run, TreeState& state, TreeFrames& frames) {
    Minimiser(tree, problem, options, own.damping_share, run, state, frames).Minimise();
  });
}

}  // namespace etude
