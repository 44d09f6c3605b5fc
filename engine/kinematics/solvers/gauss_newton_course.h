#pragma once

#include <algorithm>
#include <limits>

namespace etude {

struct IkOptions;
struct GaussNewtonOptions;

/// Returns the options for the sweeps of `gauss-newton`. The problem's limits must already be the allowed ranges.
IkOptions GaussNewtonSweepOptions(const IkOptions& options);

/// The state machine of `gauss-newton` for one problem: it decides the next action from the residual of each pose
/// (gauss_newton.h lists the phases). It does not use angles or trees, so the scalar solver and the vector solvers
/// share it:
///
///     place the start;
///     while (true) {
///       const auto next = course.Arrive(|e|² at the pose, whether it meets the goals, is_out_of_reach);
///       if (next.is_best) store the pose as the best one;
///       do what next.act says, and place the resulting pose;
///     }
class GaussNewtonCourse {
 public:
  enum class Act {
    kStep,      ///< store the pose as the last one, step with `damping`, and report the step to `Stepped`
    kGoBack,    ///< return to the last pose, because the step from there raised the residual
    kSweep,     ///< go to restart number `restart` (0: stay), then sweep `sweeps` times or until `CountSweep` is false
    kTakeBest,  ///< go to the best pose so far and continue from there
    kEnd,       ///< end at this pose if `has_converged`, else at the best pose
  };
  struct Next {
    Act act = Act::kEnd;
    bool is_best = false;
    bool to_start = false;  ///< true: steps are pulled to the start; false: they stay near the pose where they begin
    double damping = 0;     ///< μ
    int restart = 0;
    int sweeps = 0;
  };

  /// Limits that depend on the precision: the minimum damping (the last phase may divide it by up to 1000), and the
  /// |e|² below which steps are not pulled to the start. Both are larger for float.
  struct Numerics {
    double min_damping = 1e-7;
    double pulled_above = 0;
  };

  GaussNewtonCourse() = default;
  GaussNewtonCourse(const IkOptions& options, const GaussNewtonOptions& own, const Numerics& numerics);

  /// Decides the next action at a new pose, given its |e|² and whether it meets the goals. `is_out_of_reach()` returns
  /// true if no pose can meet the targets; it is called at most once, just before the first restart.
  template <class IsOutOfReach>
  Next Arrive(double squares, bool is_met, const IsOutOfReach& is_out_of_reach) {
    // Count the iteration and its forward-kinematics pass.
    if (arrival_ == Arrival::kStep) ++iterations_;
    if (arrival_ == Arrival::kStep || arrival_ == Arrival::kStart) ++fk_evaluations_;
    // After a return to the last pose, try again with more damping.
    if (arrival_ == Arrival::kBack && left_ > 0) return Step(before_);
    // End if the goals are met.
    if (is_met && arrival_ != Arrival::kBack) {
      has_converged_ = true;
      return {};
    }
    if (arrival_ == Arrival::kStart && first_sweeps_ > 0) return Sweep(0, first_sweeps_);
    // Continue the current phase while it makes progress.
    Next next;
    const bool is_at_end = arrival_ == Arrival::kBack || (arrival_ == Arrival::kStep && is_stuck_);
    if (!is_at_end && Approach(squares, next)) return next;
    // The phase has ended. Begin the next phase, which may also end at once.
    while (true) {
      RecordBest(squares, next);
      if (phase_ == Phase::kToStart) {
        Begin(Phase::kHere, kProgress, patience_);
        if (Approach(squares, next)) return next;
        continue;
      }
      // When the steps near the start have ended, restarts follow, then steps from the best pose, then the end.
      const bool is_best = next.is_best;
      if (phase_ == Phase::kHere) restarts_ = MayGoOn() && !is_out_of_reach() ? max_restarts_ : 0;
      if (MayGoOn() && phase_ != Phase::kSettle) {
        if (restart_ < restarts_) {
          ++restart_;
          Begin(Phase::kRestart, kProgress, patience_);
          ++fk_evaluations_;
          next = Sweep(restart_, kRestartSweeps);
        } else {
          Begin(Phase::kSettle, kSettled, kPatience);
          ++fk_evaluations_;
          arrival_ = Arrival::kPlaced;
          next = {.act = Act::kTakeBest};
        }
      } else {
        ++fk_evaluations_;  // for the pass that computes the errors of the best pose
        next = {};
      }
      next.is_best = is_best;
      return next;
    }
  }

  /// Tells the course the largest change of an angle in the step, radians; 0 if no step was possible.
  void Stepped(double largest) { is_stuck_ = largest < stall_change_; }

  /// Counts a sweep. Returns false if the iterations are used up.
  bool CountSweep() {
    ++iterations_;
    ++fk_evaluations_;
    return MayGoOn();
  }

  /// Returns true if a step with `damping` gets extra active-set passes.
  static bool HasExtraPasses(double damping) { return damping < kSmallDamping; }

  bool has_converged() const { return has_converged_; }
  bool HasStalled() const { return !has_converged_ && MayGoOn(); }
  int iterations() const { return iterations_; }
  int fk_evaluations() const { return fk_evaluations_; }

 private:
  // The damping is this share of |e|², times a factor that follows the success of the steps.
  static constexpr double kDamping = 0.1;
  static constexpr double kMaxDamping = 10;
  static constexpr double kDampingUp = 10;   // the factor is multiplied by this after a step that raised the residual
  static constexpr double kDampingDown = 3;  // the factor is divided by this after any other step
  // Minimum of this factor in the last phase, where the residual and thus the damping stay large. In other phases the
  // minimum is 1.
  static constexpr double kDampingFloor = 1e-3;

  // Below this damping a step gets extra active-set passes.
  static constexpr double kSmallDamping = 0.01;

  // Steps are stuck if |e|², after kPatience steps, is still at least kProgress times its old value. If few iterations
  // are allowed, max_iterations / kShareOfPatience steps are enough, so that iterations remain for restarts.
  static constexpr int kPatience = 6;
  static constexpr int kShareOfPatience = 5;
  static constexpr double kProgress = 0.7;
  static constexpr double kSettled = 1 - 1e-5;  // replaces kProgress in phase kSettle

  static constexpr int kRestartSweeps = 2;

  enum class Phase : signed char { kToStart, kHere, kRestart, kSettle };
  enum class Arrival : signed char { kStart, kStep, kBack, kPlaced };

  bool MayGoOn() const { return iterations_ < max_iterations_; }

  void Begin(Phase phase, double progress, int patience) {
    phase_ = phase;
    progress_ = progress;
    left_ = initial_left_ = patience;
    before_ = fallen_to_ = std::numeric_limits<double>::infinity();
    factor_ = 1;
  }

  /// Returns true if the phase goes on with `next`, false if the phase has ended.
  bool Approach(double squares, Next& next) {
    if (!MayGoOn()) return false;
    // The step raised the residual: go back and raise the damping.
    if (phase_ != Phase::kToStart && squares > before_) {
      ++fk_evaluations_;
      factor_ *= kDampingUp;
      --left_;
      arrival_ = Arrival::kBack;
      next.act = Act::kGoBack;
      return true;
    }
    // The step did not raise the residual: lower the damping, and end the phase after too many steps with little
    // progress.
    factor_ = std::max(phase_ == Phase::kSettle ? kDampingFloor : 1.0, factor_ / kDampingDown);
    if (squares < progress_ * fallen_to_) {
      fallen_to_ = squares;
      left_ = initial_left_;
    } else if (--left_ == 0) {
      return false;
    }
    RecordBest(squares, next);
    before_ = squares;
    const bool is_best = next.is_best;
    next = Step(squares);
    next.is_best = is_best;
    return true;
  }

  Next Step(double squares) {
    arrival_ = Arrival::kStep;
    return {.act = Act::kStep,
            .to_start = phase_ == Phase::kToStart && squares >= numerics_.pulled_above,
            .damping = factor_ * std::clamp(kDamping * squares, numerics_.min_damping, kMaxDamping)};
  }

  Next Sweep(int restart, int sweeps) {
    arrival_ = Arrival::kPlaced;
    return {.act = Act::kSweep, .restart = restart, .sweeps = sweeps};
  }

  void RecordBest(double squares, Next& next) {
    if (squares >= best_squares_) return;
    best_squares_ = squares;
    next.is_best = true;
  }

  Numerics numerics_;
  int max_iterations_ = 0, first_sweeps_ = 0, patience_ = 0;
  double stall_change_ = 0;
  Phase phase_ = Phase::kToStart;
  Arrival arrival_ = Arrival::kStart;
  bool is_stuck_ = false, has_converged_ = false;
  double progress_ = 0, before_ = 0, fallen_to_ = 0, factor_ = 1;
  double best_squares_ = std::numeric_limits<double>::infinity();
  int left_ = 0, initial_left_ = 0, restart_ = 0, restarts_ = 0, max_restarts_ = 0;
  int iterations_ = 0, fk_evaluations_ = 0;
};

}  // namespace etude
