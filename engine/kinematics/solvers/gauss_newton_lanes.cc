// Solves many problems of one tree, each in one lane of the CPU's vectors. This file is compiled once per instruction
// set; the best set that the CPU supports is selected at run time (README.md).
#include <algorithm>
#include <limits>
#include <vector>

#include "engine/kinematics/solvers/gauss_newton_vectors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kinematics/solvers/gauss_newton_lanes.cc"
#include "hwy/foreach_target.h"  // must come before highway.h

// These headers are included once per instruction set, so their order matters.
#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "engine/kinematics/solvers/lane_poses-inl.h"
#include "engine/kinematics/solvers/vectors-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

/// Solves one problem per lane. Each cycle of `Run` places all poses, passes their residuals to the lanes' courses,
/// and steps. A lane does not step if its course requests another action. If more than half of the stepping lanes
/// have finished their active sets, the unfinished lanes continue theirs in the next cycle. The results of a lane
/// depend on its own problem alone; only their timing depends on the others.
template <class T>
class GaussNewtonLanes {
 public:
  GaussNewtonLanes(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                   GaussNewtonHelp& help)
      : tree_(tree),
        rules_(rules),
        queue_(queue),
        help_(help),
        lanes_(hn::Lanes(hn::ScalableTag<T>())),
        angles_(tree.dof_count),
        poses_(tree),
        hinges_(poses_.hinges()),
        movements_(tree.joints.size()),
        quadratics_(tree.quadratic_count),
        scratch_(tree.dof_count),
        registers_(kRegisterCount) {}

  void Run() {
    while (FillLanes()) {
      poses_.Place(angles_);
      Steer();
      Step();
    }
  }

 private:
  using V = Lanes<T>;
  using M = LaneMask<T>;

  struct Lane {
    int problem = -1;
    bool steps = false;  ///< true if the lane takes part in the step of this cycle
    int passes = 0;      ///< number of active-set passes that the current step took in earlier cycles
    GaussNewtonCourse course;
  };

  /// Variables with one number per lane.
  enum Register {
    kDamping,
    kToStart,    // 1 if the step is pulled to the start, else 0; all following variables but kLargest are flags, too
    kKeepsLast,  // the present pose is stored as the last pose
    kKeepsBest,  // the present pose is stored as the best pose
    kCounts,     // the lane takes part in this active-set pass
    kHasChanged,
    kMoves,
    kLargest,    // largest change of an angle in the step, radians
    kRegisterCount
  };

  T& At(Register which, std::size_t lane) { return reinterpret_cast<T*>(&registers_[which])[lane]; }
  HWY_INLINE M Flag(Register which) { return Below(V(0.0), registers_[which]); }
  HWY_INLINE void SetFlag(Register which, const M& flag) { registers_[which] = OrZero(flag, V(1.0)); }

  /// Gives a problem to every idle lane. Returns false if all lanes are idle.
  bool FillLanes() {
    bool has_problems = false;
    for (std::size_t n = 0; n < lanes_.size(); ++n) {
      Lane& lane = lanes_[n];
      if (lane.problem < 0 && !is_empty_) {
        lane.problem = queue_.Next();
        is_empty_ = lane.problem < 0;
        if (!is_empty_) Load(static_cast<int>(n));
      }
      has_problems |= lane.problem >= 0;
    }
    return has_problems;
  }

  /// Loads the next problem into lane n: its start, clamped to the ranges, becomes the present pose.
  void Load(int n) {
    Lane& lane = lanes_[n];
    lane.course = queue_.Course();
    lane.passes = 0;
    const auto [numbers, stride] = queue_.Problem();
    const double* from = numbers;
    const auto take = [&from, stride = stride] {
      const double number = *from;
      from += stride;
      return number;
    };
    const std::size_t dofs = angles_.size() * stride;
    for (std::size_t d = 0; d < angles_.size(); ++d) {
      const double lower = from[dofs], upper = from[2 * dofs], start = std::clamp(take(), lower, upper);
      SetLane(angles_[d].now, n, start);
      SetLane(angles_[d].start, n, start);
      SetLane(angles_[d].lower, n, lower);
      SetLane(angles_[d].upper, n, upper);
      SetLane(hinges_[d].side, n, 0);
    }
    poses_.Load(n, from + 2 * dofs, stride);
  }

  /// Gets the next action of every lane's course, and performs it unless it is a step.
  void Steer() {
    registers_[kKeepsLast] = registers_[kKeepsBest] = registers_[kCounts] = V(0.0);
    for (std::size_t n = 0; n < lanes_.size(); ++n) {
      Lane& lane = lanes_[n];
      lane.steps = lane.problem >= 0 && (lane.passes > 0 || Ask(lane, static_cast<int>(n)));
      if (lane.problem < 0) At(kDamping, n) = 1;  // give an idle lane harmless numbers, because it computes too
      if (lane.steps) At(kCounts, n) = 1;
    }
    const M keeps_last = Flag(kKeepsLast), keeps_best = Flag(kKeepsBest);
    for (AngleLanes<V>& angle : angles_) {
      angle.last = Select(keeps_last, angle.now, angle.last);
      angle.best = Select(keeps_best, angle.now, angle.best);
    }
  }

  /// Asks the GaussNewtonCourse of a lane's problem for the next action. If the action is a step, prepares the step and
  /// returns true; otherwise performs the action and returns false.
  bool Ask(Lane& lane, int n) {
    using enum GaussNewtonCourse::Act;
    const auto is_out_of_reach = [&] { return help_.IsOutOfReach(lane.problem); };
    const GaussNewtonCourse::Next next =
        lane.course.Arrive(GetLane(poses_.miss().squares, n), IsMet(lane, n), is_out_of_reach);
    // If the action is a step: store the pose as the last one, and set the step's variables.
    if (next.act == kStep) {
      At(kKeepsLast, n) = 1;
      At(kKeepsBest, n) = next.is_best;
      At(kDamping, n) = static_cast<T>(next.damping);
      At(kToStart, n) = next.to_start;
      return true;
    }
    // Any other action: copy stored poses, sweep, or finish the problem.
    if (next.is_best) {
      for (AngleLanes<V>& angle : angles_) SetLane(angle.best, n, GetLane(angle.now, n));
    }
    if (next.act == kGoBack) {
      for (AngleLanes<V>& angle : angles_) SetLane(angle.now, n, GetLane(angle.last, n));
    } else if (next.act == kTakeBest || (next.act == kEnd && !lane.course.has_converged())) {
      for (AngleLanes<V>& angle : angles_) SetLane(angle.now, n, GetLane(angle.best, n));
    }
    if (next.act == kSweep) {
      help_.Sweep(lane.problem, next, lane.course, Angles(n));
      for (std::size_t d = 0; d < angles_.size(); ++d) {
        // An angle may leave its range when it is rounded to float, so clamp it.
        const double lower = GetLane(angles_[d].lower, n), upper = GetLane(angles_[d].upper, n);
        SetLane(angles_[d].now, n, std::clamp<double>(static_cast<T>(scratch_[d]), lower, upper));
      }
    } else if (next.act == kEnd) {
      queue_.Finish(lane.problem, lane.course, Angles(n));
      lane.problem = -1;
    }
    return false;
  }

  bool IsMet(const Lane& lane, int n) {
    const auto measure = [&] { return help_.MeetsGoals(lane.problem, Angles(n)); };
    return rules_.AreMet(GetLane(poses_.miss().squared_distance, n), GetLane(poses_.miss().squared_chord, n), measure);
  }

  std::span<double> Angles(int n) {
    for (std::size_t d = 0; d < angles_.size(); ++d) scratch_[d] = GetLane(angles_[d].now, n);
    return scratch_;
  }

  /// Computes the step in all lanes that take one: active-set passes, then the change of angles.
  void Step() {
    int counting = 0;
    for (const Lane& lane : lanes_) counting += lane.steps;
    if (counting == 0) return;
    // Repeat passes until more than half of the stepping lanes have finished their active sets.
    while (true) {
      Eliminate();
      const M has_changed = Substitute();
      registers_[kHasChanged] = OrZero(has_changed, V(1.0));
      int unfinished = 0;
      for (std::size_t n = 0; n < lanes_.size(); ++n) {
        Lane& lane = lanes_[n];
        if (At(kCounts, n) == 0) continue;
        const bool is_finished = At(kHasChanged, n) == 0 || lane.passes == rules_.extra_passes ||
                                 !GaussNewtonCourse::HasExtraPasses(At(kDamping, n));
        lane.passes = is_finished ? 0 : lane.passes + 1;
        if (is_finished) At(kCounts, n) = 0;
        unfinished += !is_finished;
      }
      if (2 * unfinished < counting) break;  // the unfinished lanes continue in the next cycle
    }
    // Change the angles of the lanes that have finished their active sets.
    for (std::size_t n = 0; n < lanes_.size(); ++n) At(kMoves, n) = lanes_[n].steps && lanes_[n].passes == 0;
    Move();
    for (std::size_t n = 0; n < lanes_.size(); ++n) {
      if (At(kMoves, n) > 0) lanes_[n].course.Stepped(At(kLargest, n));
    }
  }

  /// Adds up the quadratics from the leaves to the root and eliminates every hinge on the way.
  void Eliminate() {
    for (std::size_t e = 0; e < tree_.effectors.size(); ++e) {
      const GaussNewtonTree::Effector& effector = tree_.effectors[e];
      // Initialise each limb's quadratic with the quadratics of the limb's effectors.
      QuadraticLanes<V>& limb = quadratics_[tree_.joints[effector.joint].quadratic];
      if (effector.is_first) {
        Gather<true>(poses_.AskedOf(e), limb);
      } else {
        Gather<false>(poses_.AskedOf(e), limb);
      }
    }
    // Set the quadratics of limbs that move no target to zero.
    for (const int n : tree_.unasked) {
      std::memset(static_cast<void*>(&quadratics_[tree_.joints[n].quadratic]), 0, sizeof(QuadraticLanes<V>));
    }
    const V damping = registers_[kDamping];
    const M to_start = Flag(kToStart);
    for (const GaussNewtonTree::Step& step : tree_.steps) {
      const GaussNewtonTree::Joint& joint = tree_.joints[step.joint];
      QuadraticLanes<V>& limb = quadratics_[joint.quadratic];
      // Eliminate a hinge, or add a limb's quadratic to its parent's.
      if (step.dof >= 0) {
        const AngleLanes<V>& angle = angles_[step.dof];
        EliminateHinge(damping, OrZero(to_start, angle.start - angle.now), angle.lower - angle.now,
                       angle.upper - angle.now, limb, hinges_[step.dof]);
        continue;
      }
      QuadraticLanes<V>& parent = quadratics_[tree_.joints[joint.parent].quadratic];
      for (int r = 0; r < 6; ++r) {
        for (int i = 6 * r; i < 6 * r + (kHasUpperTriangle<V> ? 6 : r + 1); ++i) {
          parent.matrix[i] = parent.matrix[i] + limb.matrix[i];
        }
      }
      for (int i = 0; i < 6; ++i) parent.vector[i] = parent.vector[i] + limb.vector[i];
    }
  }

  /// Computes the change of every hinge from the root to the leaves. Returns the lanes in which a hinge has changed its
  /// `side`: free, or fixed at the lower or upper end of its range.
  M Substitute() {
    const M counts = Flag(kCounts);
    M has_changed = Below(V(0.0), V(0.0));
    for (int k = 0; k < 6; ++k) movements_[0].numbers[k] = V(0.0);
    for (std::size_t i = tree_.inwards.size(); i-- > 0;) {
      const GaussNewtonTree::Joint& joint = tree_.joints[tree_.inwards[i]];
      V movement[6];
      for (int k = 0; k < 6; ++k) movement[k] = movements_[joint.parent].numbers[k];
      for (int d = joint.first_dof; d < joint.first_dof + joint.dof_count; ++d) {
        const AngleLanes<V>& angle = angles_[d];
        HingeLanes<V>& hinge = hinges_[d];
        V change, side;
        SubstituteHinge(angle.lower - angle.now, angle.upper - angle.now, hinge, change, side, movement);
        has_changed = has_changed || (counts && !AreEqual(side, hinge.side));
        hinge.side = Select(counts, side, hinge.side);
        hinge.change = Select(counts, change, hinge.change);
      }
      for (int k = 0; k < 6; ++k) movements_[tree_.inwards[i]].numbers[k] = movement[k];
    }
    return has_changed;
  }

  /// Adds the changes to the angles. In a lane in which a change is too large, all changes are scaled down together;
  /// lanes with an infinite change do not move.
  void Move() {
    V largest(0.0);
    M is_finite = AtLeast(V(0.0), V(0.0));
    for (const HingeLanes<V>& hinge : hinges_) {
      const V size = Magnitude(hinge.change);
      largest = Larger(largest, size);
      is_finite = is_finite && AtLeast(V(static_cast<double>(std::numeric_limits<T>::max())), size);
    }
    largest = OrZero(is_finite, largest);
    registers_[kLargest] = largest;
    const V limit(rules_.max_turn);
    const V share = Select(Below(limit, largest), limit / largest, V(1.0));
    const M moves = Flag(kMoves) && Below(V(0.0), largest);
    for (std::size_t d = 0; d < angles_.size(); ++d) {
      AngleLanes<V>& angle = angles_[d];
      const V moved = angle.now + share * hinges_[d].change;
      angle.now = Select(moves, Clamped(moved, angle.lower, angle.upper), angle.now);
    }
  }

  struct Movement {
    V numbers[6];
  };

  const GaussNewtonTree& tree_;
  const GaussNewtonRules& rules_;
  GaussNewtonQueue& queue_;
  GaussNewtonHelp& help_;
  bool is_empty_ = false;  // true if the queue has no more problems
  std::vector<Lane> lanes_;
  AlignedList<AngleLanes<V>> angles_;
  LanePoses<T> poses_;
  AlignedList<HingeLanes<V>>& hinges_;
  AlignedList<Movement> movements_;  // one per limb
  AlignedList<QuadraticLanes<V>> quadratics_;
  std::vector<double> scratch_;  // angles of one lane
  AlignedList<V> registers_;
};

void SolveFloats(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                 GaussNewtonHelp& help) {
  GaussNewtonLanes<float>(tree, rules, queue, help).Run();
}
void SolveDoubles(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                  GaussNewtonHelp& help) {
  GaussNewtonLanes<double>(tree, rules, queue, help).Run();
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(SolveFloats);
HWY_EXPORT(SolveDoubles);

void SolveInFloats(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                   GaussNewtonHelp& help) {
  HWY_DYNAMIC_DISPATCH(SolveFloats)(tree, rules, queue, help);
}
void SolveInDoubles(const GaussNewtonTree& tree, const GaussNewtonRules& rules, GaussNewtonQueue& queue,
                    GaussNewtonHelp& help) {
  HWY_DYNAMIC_DISPATCH(SolveDoubles)(tree, rules, queue, help);
}

}  // namespace etude
#endif  // HWY_ONCE
