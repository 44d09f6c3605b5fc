// Poses of a tree whose limbs are in lanes (limb_packs.h): forward kinematics, in the order of `ComputeFrames`, and
// what targets ask there. Compiled once per target, hence this kind of guard.
#if defined(ETUDE_LIMB_POSES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_LIMB_POSES_INL_H_
#undef ETUDE_LIMB_POSES_INL_H_
#else
#define ETUDE_LIMB_POSES_INL_H_
#endif

#include <algorithm>

#include "engine/kinematics/solvers/four-inl.h"
#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "engine/kinematics/solvers/gauss_newton_limbs.h"
#include "engine/kinematics/solvers/lanes-inl.h"
#include "engine/kinematics/solvers/rows-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

// Rows of one number for each place of a tree, as many at a time as fit into a vector.
using Places = Lanes<double>;

template <class Do>
HWY_INLINE void ForPlaces(std::size_t count, const Do& act) {
  constexpr std::size_t kLanes = sizeof(Places) / sizeof(double);
  for (std::size_t i = 0; i < count; i += kLanes) act(i);
}
HWY_INLINE Places LoadPlaces(const double* from) { return Places(hn::Load(Places::Tag(), from)); }
HWY_INLINE void StorePlaces(const Places& a, double* to) { hn::Store(a.v, Places::Tag(), to); }

class LimbPoses {
 public:
  explicit LimbPoses(const LimbPacks& packs)
      : packs_(packs),
        places_(static_cast<std::size_t>(packs.place_count)),
        trunk_angles_(static_cast<std::size_t>(LimbPacks::kWidth) * packs.slot_count),
        sines_(places_),
        cosines_(places_),
        trunk_(packs.trunk.size()),
        trunk_hinges_(packs.trunk_hinge_count),
        hinges_(packs.slot_count),
        ends_(packs.ends.size()),
        squares_of_(packs.end_places.size()) {}

  /// `angles` at their places; the root's p_WL, and R_WL column by column.
  void Place(const double* angles, const double (&root)[12]) {
    ForPlaces(places_, [&](std::size_t i) HWY_ATTR {
      Places sine, cosine;
      SineAndCosine(LoadPlaces(angles + i), sine, cosine);
      StorePlaces(sine, sines_.begin() + i);
      StorePlaces(cosine, cosines_.begin() + i);
    });
    PlaceTrunk(root);
    miss_ = {};
    for (const LimbPacks::Pack& pack : packs_.packs) PlaceLimbs(pack, root);
    for (const double squares : squares_of_) miss_.squares += squares;
  }

  /// How far the pose is off: |e|², and the largest distance and chord that count.
  const MissLanes<double>& miss() const { return miss_; }
  const AskedLanes<Four>& AskedAt(int ends) const { return ends_[ends].asked; }
  /// With their screws at the pose; all else in them is the step's.
  AlignedList<HingeLanes<Four>>& hinges() { return hinges_; }
  AlignedList<TrunkHinge>& trunk_hinges() { return trunk_hinges_; }

  /// As in `GaussNewtonLimbs`.
  double* TargetOf(int effector) { return reinterpret_cast<double*>(&EndsOf(effector).target) + Lane(effector); }
  GaussNewtonLimbs::End EndOf(int effector) {
    const double* from = reinterpret_cast<const double*>(&EndsOf(effector).frame) + Lane(effector);
    GaussNewtonLimbs::End end;
    for (int i = 0; i < 9; ++i) end.axes[i / 3][i % 3] = from[LimbPacks::kWidth * i];
    for (int k = 0; k < 3; ++k) end.position[k] = from[LimbPacks::kWidth * (9 + k)];
    return end;
  }

 private:
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

  void PlaceTrunk(const double (&root)[12]) {
    TrunkFrame& at_root = trunk_[0];
    alignas(64) double numbers[16] = {};
    for (int i = 0; i < 12; ++i) numbers[4 * (i / 3) + i % 3] = root[i];
    at_root.position = LoadFour(numbers);
    for (int c = 0; c < 3; ++c) at_root.axes[c] = LoadFour(numbers + 4 * (c + 1));
    for (std::size_t n = 1; n < packs_.trunk.size(); ++n) {
      const LimbPacks::TrunkJoint& joint = packs_.trunk[n];
      const TrunkFrame& parent = trunk_[joint.parent];
      Four axes[3];
      for (int c = 0; c < 3; ++c) axes[c] = Mix(parent.axes, joint.R_PJ[c]);
      const Four position = parent.position + Mix(parent.axes, joint.p_PJ);
      const Four p_RJ_W = position - at_root.position;
      if (joint.hinge_count > 0) TurnTrunk<0>(joint, p_RJ_W, axes);
      if (joint.hinge_count > 1) TurnTrunk<1>(joint, p_RJ_W, axes);
      if (joint.hinge_count > 2) TurnTrunk<2>(joint, p_RJ_W, axes);
      TrunkFrame& frame = trunk_[n];
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

  void PlaceLimbs(const LimbPacks::Pack& pack, const double (&root)[12]) {
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
    for (int lane = 0; lane < LimbPacks::kWidth; ++lane) from[lane] = &trunk_[pack.parents[lane]];
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
    const Four s = LoadFour(sines_.begin() + 4 * slot), c = LoadFour(cosines_.begin() + 4 * slot);
    TurnAxes<kAxis>(s, c, axes);
    Four(&screw)[6] = hinges_[slot].screw;
    SetScrew(axes[kAxis], p_RJ_W, screw);
    const Four has_hinge = LoadFour(level.has_hinge[kAxis]);
    for (Four& component : screw) component = component * has_hinge;
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
      miss_.squared_distance = std::max(miss_.squared_distance, distances[lane]);
      miss_.squared_chord = std::max(miss_.squared_chord, chords[lane]);
      if (ends.effectors[lane] >= 0) squares_of_[ends.effectors[lane]] = squares[lane];
    }
  }

  const LimbPacks& packs_;
  const std::size_t places_;
  const std::size_t trunk_angles_;  // the place of the trunk's first angle
  AlignedList<double> sines_, cosines_;
  AlignedList<TrunkFrame> trunk_;
  AlignedList<TrunkHinge> trunk_hinges_;
  AlignedList<HingeLanes<Four>> hinges_;  // of each slot
  AlignedList<EndsState> ends_;
  AlignedList<double> squares_of_;  // of each effector
  MissLanes<double> miss_{};
};

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_LIMB_POSES_INL_H_
