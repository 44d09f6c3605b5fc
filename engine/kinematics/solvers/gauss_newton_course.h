#pragma once

#include <algorithm>
#include <limits>

namespace etude {

struct IkOptions;
struct GaussNewtonOptions;

/// Decides what `gauss-newton` does next with one problem (gauss_newton.h says in which turn), from how far each pose
/// is off. It knows numbers only, neither angles nor trees, so that one problem and many in lanes take the same way:
///
///     place the start;
///     while (true) {
///       const auto next = course.Arrive(|e|² at the pose, whether it meets the goals, is_out_of_reach);
///       if (next.is_best) keep the pose as the best one;
///       act as next.act says, and place the pose that this leads to;
///     }
class GaussNewtonCourse {
 public:
  enum class Act {
    kStep,      ///< keep the pose as the last one, step with `damping`, and report the step by `Stepped`
    kGoBack,    ///< return to the last pose: the step from there has raised the residual
    kSweep,     ///< scatter by `restart`, if it is not 0, and sweep `sweeps` times, or until `CountSweep` says no
    kTakeBest,  ///< go on from the best pose
    kEnd,       ///< end at this pose if it `has_converged`, else at the best one
  };
  struct Next {
    Act act = Act::kEnd;
    bool is_best = false;
    bool to_start = false;  ///< steps are pulled to the start; else they stay near to where they begin
    double damping = 0;     ///< μ
    int restart = 0;
    int sweeps = 0;
  };

  /// The least damping, and the squared residual below which steps are no longer pulled to the start. Both are larger
  /// where numbers have few digits.
  struct Numerics {
    double least_damping = 1e-7;
    double pulled_above = 0;
  };

  GaussNewtonCourse() = default;
  GaussNewtonCourse(const IkOptions& options, const GaussNewtonOptions& own, const Numerics& numerics);

  /// Takes in a pose that has been placed: its |e|² and whether it meets the goals. `is_out_of_reach()`, whether no
  /// pose can meet the targets, is asked once, where restarts would begin.
  template <class IsOutOfReach>
  Next Arrive(double squares, bool is_met, const IsOutOfReach& is_out_of_reach) {
    if (arrival_ == Arrival::kStep) ++iterations_;
    if (arrival_ == Arrival::kStep || arrival_ == Arrival::kStart) ++fk_evaluations_;
    if (arrival_ == Arrival::kBack && left_ > 0) return Step(before_);
    if (is_met && arrival_ != Arrival::kBack) {
      has_converged_ = true;
      return {};
    }
    if (arrival_ == Arrival::kStart && first_sweeps_ > 0) return Sweep(0, first_sweeps_);
    Next next;
    const bool is_at_end = arrival_ == Arrival::kBack || (arrival_ == Arrival::kStep && is_stuck_);
    if (!is_at_end && Approach(squares, next)) return next;
    // The approach has come to its end; so may the next ones, at once.
    while (true) {
      RecordBest(squares, next);
      if (phase_ == Phase::kToStart) {
        Begin(Phase::kHere, kProgress, patience_);
        if (Approach(squares, next)) return next;
        continue;
      }
      const bool is_best = next.is_best;
      if (phase_ == Phase::kHere) restarts_ = MayGoOn() && !is_out_of_reach() ? most_restarts_ : 0;
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
        ++fk_evaluations_;  // of the best pose, whose errors are told
        next = {};
      }
      next.is_best = is_best;
      return next;
    }
  }

  /// Takes in the largest change of an angle that the step's optimum asks for; 0 where there was no step.
  void Stepped(double largest) { is_stuck_ = largest < stall_change_; }

  /// Counts a sweep. Returns whether there may be another.
  bool CountSweep() {
    ++iterations_;
    ++fk_evaluations_;
    return MayGoOn();
  }

  /// Returns whether a step with `damping` gets extra passes of its active set.
  static bool HasExtraPasses(double damping) { return damping < kSmallDamping; }

  bool has_converged() const { return has_converged_; }
  bool HasStalled() const { return !has_converged_ && MayGoOn(); }
  int iterations() const { return iterations_; }
  int fk_evaluations() const { return fk_evaluations_; }

 private:
  // The damping is this share of the squared residual, times a factor that follows the steps' success.
  static constexpr double kDamping = 0.1;
  static constexpr double kMostDamping = 10;
  static constexpr double kDampingUp = 10;       // times the factor after a step that has raised the residual,
  static constexpr double kDampingDown = 3;      // divided by this after one that has not,
  static constexpr double kDampingFloor = 1e-3;  // at least 1, or this where the residual, and damping, stays large

  // Below this damping a step gets extra active-set passes.
  static constexpr double kSmallDamping = 0.01;

  // Steps are stuck when this many of them have not brought the squared residual down to the share kProgress; when
  // iterations are few, a share of them counts, so that restarts get theirs.
  static constexpr int kPatience = 6;
  static constexpr int kShareOfPatience = 5;
  static constexpr double kProgress = 0.7;
  static constexpr double kSettled = 1 - 1e-5;  // instead, where targets cannot be met

  static constexpr int kRestartSweeps = 2;

  enum class Phase : signed char { kToStart, kHere, kRestart, kSettle };
  enum class Arrival : signed char { kStart, kStep, kBack, kPlaced };

  bool MayGoOn() const { return iterations_ < max_iterations_; }

  void Begin(Phase phase, double progress, int patience) {
    phase_ = phase;
    progress_ = progress;
    left_ = most_left_ = patience;
    before_ = fallen_to_ = std::numeric_limits<double>::infinity();
    factor_ = 1;
  }

  /// Returns whether steps go on, as `next` says; if not, this approach is at its end.
  bool Approach(double squares, Next& next) {
    if (!MayGoOn()) return false;
    if (phase_ != Phase::kToStart && squares > before_) {
      ++fk_evaluations_;
      factor_ *= kDampingUp;
      --left_;
      arrival_ = Arrival::kBack;
      next.act = Act::kGoBack;
      return true;
    }
    factor_ = std::max(phase_ == Phase::kSettle ? kDampingFloor : 1.0, factor_ / kDampingDown);
    if (squares < progress_ * fallen_to_) {
      fallen_to_ = squares;
      left_ = most_left_;
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
            .damping = factor_ * std::clamp(kDamping * squares, numerics_.least_damping, kMostDamping)};
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
  int left_ = 0, most_left_ = 0, restart_ = 0, restarts_ = 0, most_restarts_ = 0;
  int iterations_ = 0, fk_evaluations_ = 0;
};

}  // namespace etude
