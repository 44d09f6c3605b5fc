// Solves problems one after the other, with four limbs side by side in the lanes of a vector. The trunk's joints are
// computed one by one, with a matrix row per vector. This file is compiled once per instruction set; the best set
// that the CPU supports is selected at run time (README.md). With vectors of any width, numbers are added in the
// order of the tests' plain_gauss_newton.cc.
#include <algorithm>
#include <limits>

#include "engine/kinematics/solvers/gauss_newton_vectors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kinematics/solvers/gauss_newton_limbs.cc"
#include "hwy/foreach_target.h"  // must come before highway.h

// These headers are included once per instruction set, so their order matters.
#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "engine/kinematics/solvers/limb_poses-inl.h"
#include "engine/kinematics/solvers/vectors-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

// Solves one problem, step by step as its course decides.
class LimbLanes final : public GaussNewtonLimbs {
 public:
  explicit LimbLanes(const LimbPacks& packs)
      : packs_(packs),
        index_count_(static_cast<std::size_t>(packs.place_count)),
        poses_(packs),
        numbers_(10 * index_count_),
        trunk_(packs.trunk.size()),
        trunk_hinges_(poses_.trunk_hinges()),
        hinges_(poses_.hinges()),
        sum_(1),
        limb_rows_(packs.packs.size() * LimbPacks::kWidth),
        scratch_(packs.places.size()) {
    double* next = numbers_.begin();
    for (double** const row :
         {&now_, &last_, &best_, &start_, &lower_, &upper_, &to_start_, &to_lower_, &to_upper_, &change_}) {
      *row = next;
      next += index_count_;
    }
    // Padding entries belong to no hinge. They keep the angle 0 in the range ±1, so they never reach a limit.
    std::fill_n(lower_, index_count_, -1.0);
    std::fill_n(upper_, index_count_, 1.0);
    angles = start_;
    lower = lower_;
    upper = upper_;
  }

  double* TargetOf(int effector) override { return poses_.TargetOf(effector); }
  End EndOf(int effector) override { return poses_.EndOf(effector); }

  void Solve(const GaussNewtonRules& rules, GaussNewtonCourse& course, GaussNewtonHelp& help) override {
    using enum GaussNewtonCourse::Act;
    // Free all hinges, and begin at the start angles.
    for (HingeLanes<Four>& hinge : hinges_) hinge.side = Four(0.0);
    for (TrunkHinge& hinge : trunk_hinges_) hinge.side = 0;
    Copy(start_, now_);
    const auto is_out_of_reach = [&] { return help.IsOutOfReach(0); };
    while (true) {
      // Place the pose, get the course's next action, and perform it.
      poses_.Place(now_, root);
      const GaussNewtonCourse::Next next = course.Arrive(poses_.miss().squares, IsMet(rules, help), is_out_of_reach);
      if (next.is_best) Copy(now_, best_);
      switch (next.act) {
        case kStep:
          Copy(now_, last_);
          course.Stepped(Step(next, rules));
          if (rules.traces) help.Record(Angles());
          break;
        case kGoBack:
          Copy(last_, now_);
          break;
        case kTakeBest:
          Copy(best_, now_);
          break;
        case kSweep:
          help.Sweep(0, next, course, Angles());
          for (std::size_t d = 0; d < scratch_.size(); ++d) now_[packs_.places[d]] = scratch_[d];
          break;
        case kEnd:
          Copy(course.has_converged() ? now_ : best_, start_);
          return;
      }
    }
  }

 private:
  struct TrunkState {
    QuadraticRows quadratic;
    SixRow movement;
  };

  HWY_INLINE void Copy(const double* from, double* to) {
    ForEachVector(index_count_, [&](std::size_t i) HWY_ATTR { StoreVector(LoadVector(from + i), to + i); });
  }

  bool IsMet(const GaussNewtonRules& rules, GaussNewtonHelp& help) {
    const auto measure = [&] { return help.MeetsGoals(0, Angles()); };
    return rules.AreMet(poses_.miss().squared_distance, poses_.miss().squared_chord, measure);
  }

  std::span<double> Angles() {
    for (std::size_t d = 0; d < scratch_.size(); ++d) scratch_[d] = now_[packs_.places[d]];
    return {scratch_.begin(), scratch_.size()};
  }

  /// Computes a step with its active-set passes, and moves the angles. Returns the largest change of an angle.
  double Step(const GaussNewtonCourse::Next& next, const GaussNewtonRules& rules) {
    ForEachVector(index_count_, [&](std::size_t i) HWY_ATTR {
      const RowVector now = LoadVector(now_ + i);
      StoreVector(next.to_start ? LoadVector(start_ + i) - now : RowVector(0.0), to_start_ + i);
      StoreVector(LoadVector(lower_ + i) - now, to_lower_ + i);
      StoreVector(LoadVector(upper_ + i) - now, to_upper_ + i);
    });
    // Eliminate inwards, substitute outwards, until the active set is settled.
    const Four damping(next.damping);
    bool limbs_have_changed = true;
    for (int pass = 0;; ++pass) {
      if (limbs_have_changed) {
        for (std::size_t p = 0; p < packs_.packs.size(); ++p) EliminateLimbs(p, damping);
      }
      EliminateTrunk(damping);
      const bool trunk_has_changed = SubstituteTrunk();
      limbs_have_changed = false;
      for (const LimbPacks::Pack& pack : packs_.packs) limbs_have_changed |= SubstituteLimbs(pack);
      if (!trunk_has_changed && !limbs_have_changed) break;
      if (pass == rules.extra_passes || !GaussNewtonCourse::HasExtraPasses(next.damping)) break;
    }
    return Move(rules.max_turn);
  }

  /// Eliminates the hinges of four limbs, from their ends to the trunk.
  void EliminateLimbs(std::size_t number, const Four& damping) {
    const LimbPacks::Pack& pack = packs_.packs[number];
    QuadraticLanes<Four>& sum = sum_[0];  // a member, because GCC would store a local variable twice
    bool is_empty = true;
    for (int l = pack.first_level + pack.level_count; l-- > pack.first_level;) {
      const LimbPacks::Level& level = packs_.levels[l];
      // Add the quadratics of the effectors at this level.
      if (level.ends >= 0 && is_empty) {
        Gather<true>(poses_.AskedAt(level.ends), sum);
        is_empty = false;
      } else if (level.ends >= 0) {
        Gather<false>(poses_.AskedAt(level.ends), sum);
      } else if (is_empty) {
        std::memset(static_cast<void*>(&sum), 0, sizeof(sum));
        is_empty = false;
      }
      // Eliminate the level's hinges.
      for (int slot = level.first_slot + level.hinge_count; slot-- > level.first_slot;) {
        const int index = LimbPacks::kWidth * slot;
        EliminateHinge(damping, LoadFour(to_start_ + index), LoadFour(to_lower_ + index), LoadFour(to_upper_ + index),
                       sum, hinges_[slot]);
      }
    }
    // Store each limb's quadratic, without the eliminated hinges, row by row. EliminateTrunk adds it to the trunk's
    // quadratic.
    QuadraticRows* rows = &limb_rows_[number * LimbPacks::kWidth];
    for (int r = 0; r < 6; ++r) PutRows(sum.matrix + 6 * r, [&](int lane) -> SixRow& { return rows[lane].matrix[r]; });
    PutRows(sum.vector, [&](int lane) -> SixRow& { return rows[lane].vector; });
  }

  /// Eliminates the hinges of the trunk, inwards to the root.
  void EliminateTrunk(const Four& damping) {
    for (const int n : packs_.inwards) {
      const LimbPacks::TrunkJoint& joint = packs_.trunk[n];
      SixRow m[6], v{Four(0.0), Four(0.0)};
      for (SixRow& row : m) row = v;
      bool is_first = true;
      // Add up the quadratics of all branches, then eliminate the joint's hinges.
      for (const LimbPacks::Branch& branch : packs_.BranchesOf(joint)) {
        const QuadraticRows& from = branch.pack < 0 ? trunk_[branch.number].quadratic
                                                    : limb_rows_[branch.pack * LimbPacks::kWidth + branch.number];
        for (int r = 0; r < 6; ++r) m[r] = is_first ? from.matrix[r] : m[r] + from.matrix[r];
        v = is_first ? from.vector : v + from.vector;
        is_first = false;
      }
      for (int h = joint.first_hinge + joint.hinge_count; h-- > joint.first_hinge;) {
        const std::size_t index = packs_.first_trunk_place + h;
        EliminateHinge(damping, to_start_[index], to_lower_[index], to_upper_[index], m, v, trunk_hinges_[h]);
      }
      QuadraticRows& to = trunk_[n].quadratic;
      for (int r = 0; r < 6; ++r) to.matrix[r] = m[r];
      to.vector = v;
    }
  }

  /// Computes the changes of the trunk's hinges, outwards from the root. Returns true if the `side` of a hinge has
  /// changed.
  bool SubstituteTrunk() {
    SixRow& at_rest = trunk_[0].movement;
    at_rest = {Four(0.0), Four(0.0)};
    bool has_changed = false;
    for (std::size_t i = packs_.inwards.size(); i-- > 0;) {
      const int n = packs_.inwards[i];
      const LimbPacks::TrunkJoint& joint = packs_.trunk[n];
      SixRow movement = trunk_[joint.parent].movement;
      for (int h = joint.first_hinge; h < joint.first_hinge + joint.hinge_count; ++h) {
        const std::size_t index = packs_.first_trunk_place + h;
        has_changed |= SubstituteHinge(to_lower_[index], to_upper_[index], trunk_hinges_[h], change_[index], movement);
      }
      trunk_[n].movement = movement;
    }
    return has_changed;
  }

  /// Computes the changes of four limbs' hinges. Returns true if the `side` of a hinge has changed.
  bool SubstituteLimbs(const LimbPacks::Pack& pack) {
    const SixRow* from[LimbPacks::kWidth];
    for (int lane = 0; lane < LimbPacks::kWidth; ++lane) from[lane] = &trunk_[pack.parents[lane]].movement;
    Four movement[6], none;
    // Transpose the movements of the trunk joints into lanes.
    for (int k = 0; k < 4; ++k) movement[k] = from[k]->low;
    Transpose(movement[0], movement[1], movement[2], movement[3]);
    Four last = from[2]->high;
    movement[4] = from[0]->high;
    movement[5] = from[1]->high;
    none = from[3]->high;
    Transpose(movement[4], movement[5], last, none);
    // Back-substitution: compute the changes of the hinges outwards, level by level.
    FourMask has_changed = Below(Four(0.0), Four(0.0));
    for (const LimbPacks::Level& level : packs_.LevelsOf(pack)) {
      for (int slot = level.first_slot; slot < level.first_slot + level.hinge_count; ++slot) {
        const int index = LimbPacks::kWidth * slot;
        HingeLanes<Four>& hinge = hinges_[slot];
        Four change, side;
        SubstituteHinge(LoadFour(to_lower_ + index), LoadFour(to_upper_ + index), hinge, change, side, movement);
        has_changed = has_changed || !AreEqual(side, hinge.side);
        hinge.side = side;
        StoreFour(change, change_ + index);
      }
    }
    return Any(has_changed);
  }

  /// Adds the changes to the angles. If a change is too large, all changes are scaled down together; if a change is
  /// infinite, no angle moves. Returns the largest change.
  double Move(double max_change) {
    RowVector largest(0.0);
    auto is_finite = AtLeast(RowVector(0.0), RowVector(0.0));
    ForEachVector(index_count_, [&](std::size_t i) HWY_ATTR {
      const RowVector size = Magnitude(LoadVector(change_ + i));
      largest = Larger(largest, size);
      is_finite = is_finite && AtLeast(RowVector(std::numeric_limits<double>::max()), size);
    });
    const double largest_change = hn::GetLane(hn::MaxOfLanes(RowVector::Tag(), largest.v));
    if (Any(!is_finite) || !(largest_change > 0)) return 0;
    const RowVector share(largest_change > max_change ? max_change / largest_change : 1);
    ForEachVector(index_count_, [&](std::size_t i) HWY_ATTR {
      const RowVector lower_end = LoadVector(lower_ + i), upper_end = LoadVector(upper_ + i);
      const RowVector moved = LoadVector(now_ + i) + share * LoadVector(change_ + i);
      StoreVector(Clamped(moved, lower_end, upper_end), now_ + i);
    });
    return largest_change;
  }

  const LimbPacks& packs_;
  const std::size_t index_count_;
  LimbPoses poses_;
  AlignedList<double> numbers_;  // memory of the following rows, one number per index of `LimbPacks::places`
  double *now_, *last_, *best_, *start_, *lower_, *upper_;
  double *to_start_, *to_lower_, *to_upper_, *change_;  // rows of the current step
  AlignedList<TrunkState> trunk_;                       // one per trunk joint
  AlignedList<TrunkHinge>& trunk_hinges_;
  AlignedList<HingeLanes<Four>>& hinges_;
  AlignedList<QuadraticLanes<Four>> sum_;  // quadratic of a pack during elimination
  AlignedList<QuadraticRows> limb_rows_;   // one per limb, after its hinges are eliminated
  AlignedList<double> scratch_;            // angles in the order of the tree
};

std::unique_ptr<GaussNewtonLimbs> MakeLimbs(const LimbPacks& packs) { return std::make_unique<LimbLanes>(packs); }

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(MakeLimbs);

std::unique_ptr<GaussNewtonLimbs> GaussNewtonLimbs::Make(const LimbPacks& packs) {
  return HWY_DYNAMIC_DISPATCH(MakeLimbs)(packs);
}

}  // namespace etude
#endif  // HWY_ONCE
