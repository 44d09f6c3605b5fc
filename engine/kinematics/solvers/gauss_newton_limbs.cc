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
        numbers_(12 * places_),
        trunk_(packs.trunk.size()),
        trunk_hinges_(packs.trunk_hinge_count),
        hinges_(packs.slot_count),
        ends_(packs.ends.size()),
        sum_(1),
        limb_rows_(packs.packs.size() * LimbPacks::kWidth),
        squares_of_(packs.end_places.size()) {
    double* next = numbers_.begin();
    for (double** const row : {&now_, &last_, &best_, &start_, &lower_, &upper_, &to_start_, &to_lower_, &to_upper_,
                               &change_, &sines_, &cosines_}) {
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

  double* TargetOf(int effector) override {
    return reinterpret_cast<double*>(&EndsOf(effector).target) + Lane(effector);
  }

  End EndOf(int effector) override {
    const double* from = reinterpret_cast<const double*>(&EndsOf(effector).frame) + Lane(effector);
    End end;
    for (int i = 0; i < 9; ++i) end.axes[i / 3][i % 3] = from[LimbPacks::kWidth * i];
    for (int k = 0; k < 3; ++k) end.position[k] = from[LimbPacks::kWidth * (9 + k)];
    return end;
  }

  void Solve(const LaneGoals& goals, int extra_passes, GaussNewtonCourse& course, GaussNewtonHelp& help) override {
    using enum GaussNewtonCourse::Act;
    for (HingeLanes<Four>& hinge : hinges_) hinge.side = Four(0.0);
    for (TrunkHinge& hinge : trunk_hinges_) hinge.side = 0;
    Copy(start_, now_);
    const auto is_out_of_reach = [&] { return help.IsOutOfReach(); };
    while (true) {
      Place();
      const GaussNewtonCourse::Next next = course.Arrive(squares_, IsMet(goals, help), is_out_of_reach);
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
  using V = Lanes<double>;

  /// Of the trunk's joints and of limbs' ends.
  struct TrunkState {
    TrunkFrame frame;
    QuadraticRows quadratic;
    SixRow movement;
  };
  struct EndsState {
    TargetLanes<Four> target;
    AskedLanes<Four> asked;
    FrameLanes<Four> frame;
  };
  struct Three {
    Four v[3];
  };

  EndsState& EndsOf(int effector) { return ends_[packs_.end_places[effector] / LimbPacks::kWidth]; }
  int Lane(int effector) const { return packs_.end_places[effector] % LimbPacks::kWidth; }

  template <class Put>
  HWY_INLINE void ForPlaces(const Put& put) {
    constexpr std::size_t kLanes = sizeof(V) / sizeof(double);
    for (std::size_t i = 0; i < places_; i += kLanes) put(i);
  }
  static HWY_INLINE V Load(const double* from) { return V(hn::Load(V::Tag(), from)); }
  static HWY_INLINE void Store(const V& a, double* to) { hn::Store(a.v, V::Tag(), to); }

  HWY_INLINE void Copy(const double* from, double* to) {
    ForPlaces([&](std::size_t i) HWY_ATTR { Store(Load(from + i), to + i); });
  }

  // ---- Forward kinematics, and what targets ask ----

  void Place() {
    ForPlaces([&](std::size_t i) HWY_ATTR {
      V sine, cosine;
      SineAndCosine(Load(now_ + i), sine, cosine);
      Store(sine, sines_ + i);
      Store(cosine, cosines_ + i);
    });
    PlaceTrunk();
    squared_distance_ = squared_chord_ = 0;
    for (const LimbPacks::Pack& pack : packs_.packs) PlaceLimbs(pack);
    squares_ = 0;
    for (const double squares : squares_of_) squares_ += squares;
  }

  void PlaceTrunk() {
    TrunkFrame& at_root = trunk_[0].frame;
    alignas(64) double numbers[16] = {};
    for (int i = 0; i < 12; ++i) numbers[4 * (i / 3) + i % 3] = root[i];
    at_root.position = LoadFour(numbers);
    for (int c = 0; c < 3; ++c) at_root.axes[c] = LoadFour(numbers + 4 * (c + 1));
    for (std::size_t n = 1; n < packs_.trunk.size(); ++n) {
      const LimbPacks::TrunkJoint& joint = packs_.trunk[n];
      const TrunkFrame& parent = trunk_[joint.parent].frame;
      Four axes[3];
      for (int c = 0; c < 3; ++c) axes[c] = Mix(parent.axes, joint.R_PJ[c]);
      const Four position = parent.position + Mix(parent.axes, joint.p_PJ);
      const Four p_RJ_W = position - at_root.position;
      if (joint.hinge_count > 0) TurnTrunk<0>(joint, p_RJ_W, axes);
      if (joint.hinge_count > 1) TurnTrunk<1>(joint, p_RJ_W, axes);
      if (joint.hinge_count > 2) TurnTrunk<2>(joint, p_RJ_W, axes);
      TrunkFrame& frame = trunk_[n].frame;
      for (int c = 0; c < 3; ++c) frame.axes[c] = axes[c];
      frame.position = position;
    }
  }

  static HWY_INLINE Four Mix(const Four (&axes)[3], const double (&by)[3]) {
    return axes[0] * Four(by[0]) + axes[1] * Four(by[1]) + axes[2] * Four(by[2]);
  }

  template <int kAxis>
  HWY_INLINE void TurnTrunk(const LimbPacks::TrunkJoint& joint, const Four& p_RJ_W, Four (&axes)[3]) {
    constexpr int i = (kAxis + 1) % 3, j = (kAxis + 2) % 3;
    const int hinge = joint.first_hinge + kAxis;
    const Four s(sines_[trunk_angles_ + hinge]), c(cosines_[trunk_angles_ + hinge]);
    const Four x = axes[i], y = axes[j];
    axes[i] = c * x + s * y;
    axes[j] = c * y - s * x;
    double* screw = trunk_hinges_[hinge].screw;
    PutFour(axes[kAxis], screw);
    PutFour(CrossAxes(p_RJ_W, axes[kAxis]), screw + 3);
  }

  void PlaceLimbs(const LimbPacks::Pack& pack) {
    Three root_position, position, axes[3];
    TakeFrames(pack, position, axes);
    for (int k = 0; k < 3; ++k) root_position.v[k] = Four(root[k]);
    for (const LimbPacks::Level& level : packs_.LevelsOf(pack)) {
      Four turned[3][3];
      for (int k = 0; k < 3; ++k) {
        position.v[k] =
            position.v[k] + (axes[0].v[k] * LoadFour(level.p_PJ[0]) + axes[1].v[k] * LoadFour(level.p_PJ[1]) +
                             axes[2].v[k] * LoadFour(level.p_PJ[2]));
      }
      for (int c = 0; c < 3; ++c) {
        if (!level.turns_axes) Copy3(axes[c].v, turned[c]);
        for (int k = 0; k < 3 && level.turns_axes; ++k) {
          turned[c][k] = axes[0].v[k] * LoadFour(level.R_PJ[c][0]) + axes[1].v[k] * LoadFour(level.R_PJ[c][1]) +
                         axes[2].v[k] * LoadFour(level.R_PJ[c][2]);
        }
      }
      Four p_RJ_W[3];
      for (int k = 0; k < 3; ++k) p_RJ_W[k] = position.v[k] - root_position.v[k];
      if (level.hinge_count > 0) TurnLimbs<0>(level, p_RJ_W, turned);
      if (level.hinge_count > 1) TurnLimbs<1>(level, p_RJ_W, turned);
      if (level.hinge_count > 2) TurnLimbs<2>(level, p_RJ_W, turned);
      for (int c = 0; c < 3; ++c) Copy3(turned[c], axes[c].v);
      if (level.ends >= 0) LineariseEnds(level.ends, position.v, turned, root_position.v);
    }
  }

  /// The frames of the joints that limbs hang on, one in each lane.
  HWY_INLINE void TakeFrames(const LimbPacks::Pack& pack, Three& position, Three (&axes)[3]) {
    const TrunkFrame* from[LimbPacks::kWidth];
    for (int lane = 0; lane < LimbPacks::kWidth; ++lane) from[lane] = &trunk_[pack.parents[lane]].frame;
    for (int c = 0; c < 3; ++c) {
      Four x = from[0]->axes[c], y = from[1]->axes[c], z = from[2]->axes[c], none = from[3]->axes[c];
      Transpose(x, y, z, none);
      axes[c].v[0] = x;
      axes[c].v[1] = y;
      axes[c].v[2] = z;
    }
    Four x = from[0]->position, y = from[1]->position, z = from[2]->position, none = from[3]->position;
    Transpose(x, y, z, none);
    position.v[0] = x;
    position.v[1] = y;
    position.v[2] = z;
  }

  template <int kAxis>
  HWY_INLINE void TurnLimbs(const LimbPacks::Level& level, const Four (&p_RJ_W)[3], Four (&axes)[3][3]) {
    const int slot = level.first_slot + kAxis;
    const Four s = LoadFour(sines_ + 4 * slot), c = LoadFour(cosines_ + 4 * slot);
    TurnAxes<kAxis>(s, c, axes);
    Four(&screw)[6] = hinges_[slot].screw;
    SetScrew(axes[kAxis], p_RJ_W, screw);
    const Four has_hinge = LoadFour(level.has_hinge[kAxis]);
    for (int k = 0; k < 6; ++k) screw[k] = screw[k] * has_hinge;
  }

  HWY_INLINE void LineariseEnds(int number, const Four (&p_WL)[3], const Four (&R_WE)[3][3], const Four (&p_WR)[3]) {
    const LimbPacks::Ends& ends = packs_.ends[number];
    Four p_WE[3];
    for (int k = 0; k < 3; ++k) {
      p_WE[k] = p_WL[k] + (R_WE[0][k] * LoadFour(ends.p_LE[0]) + R_WE[1][k] * LoadFour(ends.p_LE[1]) +
                           R_WE[2][k] * LoadFour(ends.p_LE[2]));
    }
    FrameLanes<Four>& frame = ends_[number].frame;
    for (int c = 0; c < 3; ++c) Copy3(R_WE[c], frame.axes[c]);
    Copy3(p_WE, frame.position);
    MissLanes<Four> miss{Four(0.0), Four(0.0), Four(0.0)};
    Linearise(ends_[number].target, R_WE, p_WE, p_WR, ends_[number].asked, miss);
    alignas(64) double squares[4], distances[4], chords[4];
    StoreFour(miss.squares, squares);
    StoreFour(miss.squared_distance, distances);
    StoreFour(miss.squared_chord, chords);
    for (int lane = 0; lane < LimbPacks::kWidth; ++lane) {
      squared_distance_ = std::max(squared_distance_, distances[lane]);
      squared_chord_ = std::max(squared_chord_, chords[lane]);
      if (ends.effectors[lane] >= 0) squares_of_[ends.effectors[lane]] = squares[lane];
    }
  }

  bool IsMet(const LaneGoals& goals, GaussNewtonHelp& help) {
    // So that what is no number meets nothing.
    if (!(squared_distance_ < goals.squared_distance_missed && squared_chord_ < goals.squared_chord_missed))
      return false;
    if (squared_distance_ < goals.squared_distance_met && squared_chord_ < goals.squared_chord_met) return true;
    return help.MeetsGoals({now_, places_});
  }

  // ---- The step ----

  /// Returns the largest change of an angle.
  double Step(const GaussNewtonCourse::Next& next, int extra_passes) {
    ForPlaces([&](std::size_t i) HWY_ATTR {
      const V now = Load(now_ + i);
      Store(next.to_start ? Load(start_ + i) - now : V(0.0), to_start_ + i);
      Store(Load(lower_ + i) - now, to_lower_ + i);
      Store(Load(upper_ + i) - now, to_upper_ + i);
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
        Gather<true>(ends_[level.ends].asked, sum);
        is_empty = false;
      } else if (level.ends >= 0) {
        Gather<false>(ends_[level.ends].asked, sum);
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
    V largest(0.0);
    auto is_finite = AtLeast(V(0.0), V(0.0));
    ForPlaces([&](std::size_t i) HWY_ATTR {
      const V size = Magnitude(Load(change_ + i));
      largest = Larger(largest, size);
      is_finite = is_finite && AtLeast(V(std::numeric_limits<double>::max()), size);
    });
    const double most = hn::GetLane(hn::MaxOfLanes(V::Tag(), largest.v));
    if (Any(!is_finite) || !(most > 0)) return 0;
    const V share(most > kLargestTurn ? kLargestTurn / most : 1);
    ForPlaces([&](std::size_t i) HWY_ATTR {
      const V least = Load(lower_ + i), most_allowed = Load(upper_ + i);
      const V moved = Load(now_ + i) + share * Load(change_ + i);
      Store(Select(Below(moved, least), least, Select(Below(most_allowed, moved), most_allowed, moved)), now_ + i);
    });
    return most;
  }

  const LimbPacks& packs_;
  const std::size_t places_;
  const std::size_t trunk_angles_;  // the place of the trunk's first angle
  AlignedList<double> numbers_;     // these rows, of all places
  double *now_, *last_, *best_, *start_, *lower_, *upper_;
  double *to_start_, *to_lower_, *to_upper_, *change_;  // in a step
  double *sines_, *cosines_;
  AlignedList<TrunkState> trunk_;
  AlignedList<TrunkHinge> trunk_hinges_;
  AlignedList<HingeLanes<Four>> hinges_;  // of each slot
  AlignedList<EndsState> ends_;
  AlignedList<QuadraticLanes<Four>> sum_;  // of a pack on its way inwards
  AlignedList<QuadraticRows> limb_rows_;   // of each limb, when its hinges are eliminated
  AlignedList<double> squares_of_;         // of each effector
  double squares_ = 0, squared_distance_ = 0, squared_chord_ = 0;
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
