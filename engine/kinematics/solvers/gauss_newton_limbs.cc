// Compiled once for every kind of vectors that x86-64 CPUs have, as batch_lanes.cc is and for its reasons. Whatever
// their width, the numbers are added up in one order: that of `GaussNewtonStep`.
#include "engine/kinematics/solvers/gauss_newton_limbs.h"

#include <algorithm>
#include <limits>

#include "engine/kinematics/solvers/linear_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kinematics/solvers/gauss_newton_limbs.cc"
#include "hwy/foreach_target.h"  // before highway.h

// In this order: per target.
#include "engine/kinematics/solvers/four-inl.h"
#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "engine/kinematics/solvers/lanes-inl.h"
#include "engine/kinematics/solvers/limb_poses-inl.h"
#include "engine/kinematics/solvers/rows-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

class LimbLanes final : public GaussNewtonLimbs {
 public:
  explicit LimbLanes(const LimbPacks& packs)
      : packs_(packs),
        places_(static_cast<std::size_t>(packs.place_count)),
        trunk_angles_(static_cast<std::size_t>(LimbPacks::kWidth) * packs.slot_count),
        poses_(packs),
        numbers_(10 * places_),
        trunk_(packs.trunk.size()),
        trunk_hinges_(poses_.trunk_hinges()),
        hinges_(poses_.hinges()),
        sum_(1),
        limb_rows_(packs.packs.size() * LimbPacks::kWidth) {
    double* next = numbers_.begin();
    for (double** const row :
         {&now_, &last_, &best_, &start_, &lower_, &upper_, &to_start_, &to_lower_, &to_upper_, &change_}) {
      *row = next;
      next += places_;
    }
    // Places without a hinge stay at zero, and free.
    std::fill_n(lower_, places_, -1.0);
    std::fill_n(upper_, places_, 1.0);
    angles = start_;
    lower = lower_;
    upper = upper_;
  }

  double* TargetOf(int effector) override { return poses_.TargetOf(effector); }
  End EndOf(int effector) override { return poses_.EndOf(effector); }

  void Solve(const LaneGoals& goals, int extra_passes, GaussNewtonCourse& course, GaussNewtonHelp& help) override {
    using enum GaussNewtonCourse::Act;
    for (HingeLanes<Four>& hinge : hinges_) hinge.side = Four(0.0);
    for (TrunkHinge& hinge : trunk_hinges_) hinge.side = 0;
    Copy(start_, now_);
    const auto is_out_of_reach = [&] { return help.IsOutOfReach(); };
    while (true) {
      poses_.Place(now_, root);
      const GaussNewtonCourse::Next next = course.Arrive(poses_.miss().squares, IsMet(goals, help), is_out_of_reach);
      if (next.is_best) Copy(now_, best_);
      switch (next.act) {
        case kStep:
          Copy(now_, last_);
          course.Stepped(Step(next, extra_passes));
          break;
        case kGoBack:
          Copy(last_, now_);
          break;
        case kTakeBest:
          Copy(best_, now_);
          break;
        case kSweep:
          help.Sweep(next, course, {now_, places_});
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
    ForPlaces(places_, [&](std::size_t i) HWY_ATTR { StorePlaces(LoadPlaces(from + i), to + i); });
  }

  bool IsMet(const LaneGoals& goals, GaussNewtonHelp& help) {
    const double distance = poses_.miss().squared_distance, chord = poses_.miss().squared_chord;
    // So that what is no number meets nothing.
    if (!(distance < goals.squared_distance_missed && chord < goals.squared_chord_missed)) return false;
    if (distance < goals.squared_distance_met && chord < goals.squared_chord_met) return true;
    return help.MeetsGoals({now_, places_});
  }

  /// Returns the largest change of an angle.
  double Step(const GaussNewtonCourse::Next& next, int extra_passes) {
    ForPlaces(places_, [&](std::size_t i) HWY_ATTR {
      const Places now = LoadPlaces(now_ + i);
      StorePlaces(next.to_start ? LoadPlaces(start_ + i) - now : Places(0.0), to_start_ + i);
      StorePlaces(LoadPlaces(lower_ + i) - now, to_lower_ + i);
      StorePlaces(LoadPlaces(upper_ + i) - now, to_upper_ + i);
    });
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
      if (pass == extra_passes || !GaussNewtonCourse::HasExtraPasses(next.damping)) break;
    }
    return Move();
  }

  void EliminateLimbs(std::size_t number, const Four& damping) {
    const LimbPacks::Pack& pack = packs_.packs[number];
    QuadraticLanes<Four>& sum = sum_[0];  // in memory: what GCC knows to be local it keeps twice
    bool is_empty = true;
    for (int l = pack.first_level + pack.level_count; l-- > pack.first_level;) {
      const LimbPacks::Level& level = packs_.levels[l];
      if (level.ends >= 0 && is_empty) {
        Gather<true>(poses_.AskedAt(level.ends), sum);
        is_empty = false;
      } else if (level.ends >= 0) {
        Gather<false>(poses_.AskedAt(level.ends), sum);
      } else if (is_empty) {
        std::memset(static_cast<void*>(&sum), 0, sizeof(sum));
        is_empty = false;
      }
      for (int slot = level.first_slot + level.hinge_count; slot-- > level.first_slot;) {
        const int place = LimbPacks::kWidth * slot;
        EliminateHinge(damping, LoadFour(to_start_ + place), LoadFour(to_lower_ + place), LoadFour(to_upper_ + place),
                       sum, hinges_[slot]);
      }
    }
    QuadraticRows* rows = &limb_rows_[number * LimbPacks::kWidth];
    for (int r = 0; r < 6; ++r) PutRows(sum.matrix + 6 * r, [&](int lane) -> SixRow& { return rows[lane].matrix[r]; });
    PutRows(sum.vector, [&](int lane) -> SixRow& { return rows[lane].vector; });
  }

  /// Six numbers of every limb as a row for each.
  template <class RowOf>
  static HWY_INLINE void PutRows(const Four* numbers, const RowOf& row_of) {
    Four a = numbers[0], b = numbers[1], c = numbers[2], d = numbers[3];
    Transpose(a, b, c, d);
    Four e = numbers[4], f = numbers[5], g, h;
    TransposeTwo(e, f, g, h);
    row_of(0) = {a, e};
    row_of(1) = {b, f};
    row_of(2) = {c, g};
    row_of(3) = {d, h};
  }

  void EliminateTrunk(const Four& damping) {
    for (const int n : packs_.inwards) {
      const LimbPacks::TrunkJoint& joint = packs_.trunk[n];
      SixRow m[6], v{Four(0.0), Four(0.0)};
      for (SixRow& row : m) row = v;
      bool is_first = true;
      for (const LimbPacks::Branch& branch : packs_.BranchesOf(joint)) {
        const QuadraticRows& from = branch.pack < 0 ? trunk_[branch.number].quadratic
                                                    : limb_rows_[branch.pack * LimbPacks::kWidth + branch.number];
        for (int r = 0; r < 6; ++r) m[r] = is_first ? from.matrix[r] : m[r] + from.matrix[r];
        v = is_first ? from.vector : v + from.vector;
        is_first = false;
      }
      for (int h = joint.first_hinge + joint.hinge_count; h-- > joint.first_hinge;) {
        const std::size_t place = trunk_angles_ + h;
        EliminateHinge(damping, to_start_[place], to_lower_[place], to_upper_[place], m, v, trunk_hinges_[h]);
      }
      QuadraticRows& to = trunk_[n].quadratic;
      for (int r = 0; r < 6; ++r) to.matrix[r] = m[r];
      to.vector = v;
    }
  }

  /// From the root on. Returns whether a hinge has changed sides.
  bool SubstituteTrunk() {
    SixRow& at_rest = trunk_[0].movement;
    at_rest = {Four(0.0), Four(0.0)};
    bool has_changed = false;
    for (std::size_t i = packs_.inwards.size(); i-- > 0;) {
      const int n = packs_.inwards[i];
      const LimbPacks::TrunkJoint& joint = packs_.trunk[n];
      SixRow movement = trunk_[joint.parent].movement;
      for (int h = joint.first_hinge; h < joint.first_hinge + joint.hinge_count; ++h) {
        const std::size_t place = trunk_angles_ + h;
        has_changed |= SubstituteHinge(to_lower_[place], to_upper_[place], trunk_hinges_[h], change_[place], movement);
      }
      trunk_[n].movement = movement;
    }
    return has_changed;
  }

  bool SubstituteLimbs(const LimbPacks::Pack& pack) {
    const SixRow* from[LimbPacks::kWidth];
    for (int lane = 0; lane < LimbPacks::kWidth; ++lane) from[lane] = &trunk_[pack.parents[lane]].movement;
    Four movement[6], none;
    for (int k = 0; k < 4; ++k) movement[k] = from[k]->low;
    Transpose(movement[0], movement[1], movement[2], movement[3]);
    Four last = from[2]->high;
    movement[4] = from[0]->high;
    movement[5] = from[1]->high;
    none = from[3]->high;
    Transpose(movement[4], movement[5], last, none);
    FourMask has_changed = Below(Four(0.0), Four(0.0));
    for (const LimbPacks::Level& level : packs_.LevelsOf(pack)) {
      for (int slot = level.first_slot; slot < level.first_slot + level.hinge_count; ++slot) {
        const int place = LimbPacks::kWidth * slot;
        HingeLanes<Four>& hinge = hinges_[slot];
        Four change, side;
        SubstituteHinge(LoadFour(to_lower_ + place), LoadFour(to_upper_ + place), hinge, change, side, movement);
        has_changed = has_changed || !AreEqual(side, hinge.side);
        hinge.side = side;
        StoreFour(change, change_ + place);
      }
    }
    return Any(has_changed);
  }

  /// By all changes, shortened where they are too long.
  double Move() {
    Places largest(0.0);
    auto is_finite = AtLeast(Places(0.0), Places(0.0));
    ForPlaces(places_, [&](std::size_t i) HWY_ATTR {
      const Places size = Magnitude(LoadPlaces(change_ + i));
      largest = Larger(largest, size);
      is_finite = is_finite && AtLeast(Places(std::numeric_limits<double>::max()), size);
    });
    const double most = hn::GetLane(hn::MaxOfLanes(Places::Tag(), largest.v));
    if (Any(!is_finite) || !(most > 0)) return 0;
    const Places share(most > kLargestTurn ? kLargestTurn / most : 1);
    ForPlaces(places_, [&](std::size_t i) HWY_ATTR {
      const Places least = LoadPlaces(lower_ + i), most_allowed = LoadPlaces(upper_ + i);
      const Places moved = LoadPlaces(now_ + i) + share * LoadPlaces(change_ + i);
      StorePlaces(Select(Below(moved, least), least, Select(Below(most_allowed, moved), most_allowed, moved)),
                  now_ + i);
    });
    return most;
  }

  const LimbPacks& packs_;
  const std::size_t places_;
  const std::size_t trunk_angles_;  // the place of the trunk's first angle
  LimbPoses poses_;
  AlignedList<double> numbers_;  // these rows, of all places
  double *now_, *last_, *best_, *start_, *lower_, *upper_;
  double *to_start_, *to_lower_, *to_upper_, *change_;  // in a step
  AlignedList<TrunkState> trunk_;                       // of each of its joints
  AlignedList<TrunkHinge>& trunk_hinges_;
  AlignedList<HingeLanes<Four>>& hinges_;
  AlignedList<QuadraticLanes<Four>> sum_;  // of a pack on its way inwards
  AlignedList<QuadraticRows> limb_rows_;   // of each limb, when its hinges are eliminated
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
