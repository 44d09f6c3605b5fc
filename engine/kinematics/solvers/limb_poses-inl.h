// The forward kinematics of gauss_newton_limbs.cc. This file is included once per instruction set, hence the unusual
// include guard.
#if defined(ETUDE_LIMB_POSES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_LIMB_POSES_INL_H_
#undef ETUDE_LIMB_POSES_INL_H_
#else
#define ETUDE_LIMB_POSES_INL_H_
#endif

#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "engine/kinematics/solvers/vectors-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

// Forward kinematics of one pose, in the order of `ComputeFrames`, and its linearised targets.
class LimbPoses {
 public:
  explicit LimbPoses(const LimbPacks& packs)
      : packs_(packs),
        sines_(packs.place_count),
        cosines_(packs.place_count),
        trunk_(packs.trunk.size()),
        trunk_hinges_(packs.trunk_hinge_count),
        hinges_(packs.slot_count),
        ends_(packs.ends.size()),
        squares_of_(packs.end_places.size()) {}

  /// Places a pose: `angles` in the order of `LimbPacks`, `root` as p_WL and R_WL column by column.
  void Place(const double* angles, const double (&root)[12]) {
    // Compute the sines and cosines of all angles, then place the trunk, then the limbs.
    ForEachVector(sines_.size(), [&](std::size_t i) HWY_ATTR {
      RowVector sine, cosine;
      SineAndCosine(LoadVector(angles + i), sine, cosine);
      StoreVector(sine, sines_.begin() + i);
      StoreVector(cosine, cosines_.begin() + i);
    });
    PlaceTrunk(root);
    miss_ = {};
    for (const LimbPacks::Pack& pack : packs_.packs) PlaceLimbs(pack, root);
    for (const double squares : squares_of_) miss_.squares += squares;
  }

  /// Returns the residual of the pose.
  const ResidualLanes<double>& miss() const { return miss_; }
  const TargetQuadraticLanes<Four>& AskedAt(int ends) const { return ends_[ends].asked; }
  /// Returns the hinges. The forward kinematics sets their screws; the step uses their other members.
  AlignedList<HingeLanes<Four>>& hinges() { return hinges_; }
  AlignedList<TrunkHinge>& trunk_hinges() { return trunk_hinges_; }

  /// Returns the memory of an effector's target, in the layout that `GaussNewtonLimbs` declares.
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
    TargetQuadraticLanes<Four> asked;
    FrameLanes<Four> frame;
  };

  EndsState& EndsOf(int effector) { return ends_[packs_.end_places[effector] / LimbPacks::kWidth]; }
  int Lane(int effector) const { return packs_.end_places[effector] % LimbPacks::kWidth; }

  void PlaceTrunk(const double (&root)[12]) {
    // Place the root.
    TrunkFrame& at_root = trunk_[0];
    alignas(64) double numbers[16] = {};
    for (int i = 0; i < 12; ++i) numbers[4 * (i / 3) + i % 3] = root[i];
    at_root.position = LoadFour(numbers);
    for (int c = 0; c < 3; ++c) at_root.axes[c] = LoadFour(numbers + 4 * (c + 1));
    for (std::size_t n = 1; n < packs_.trunk.size(); ++n) {
      const LimbPacks::TrunkJoint& joint = packs_.trunk[n];
      // Compute the frame of the joint before it turns, then its rotations about X, Y, Z.
      const TrunkFrame& parent = trunk_[joint.parent];
      Four axes[3];
      for (int c = 0; c < 3; ++c) axes[c] = MixRows(parent.axes, joint.R_PJ[c]);
      const Four position = parent.position + MixRows(parent.axes, joint.p_PJ);
      const Four p_RJ_W = position - at_root.position;
      if (joint.hinge_count > 0) TurnTrunk<0>(joint, p_RJ_W, axes);
      if (joint.hinge_count > 1) TurnTrunk<1>(joint, p_RJ_W, axes);
      if (joint.hinge_count > 2) TurnTrunk<2>(joint, p_RJ_W, axes);
      TrunkFrame& frame = trunk_[n];
      for (int c = 0; c < 3; ++c) frame.axes[c] = axes[c];
      frame.position = position;
    }
  }

  static HWY_INLINE Four MixRows(const Four (&axes)[3], const double (&by)[3]) {
    return axes[0] * Four(by[0]) + axes[1] * Four(by[1]) + axes[2] * Four(by[2]);
  }

  template <int kAxis>
  HWY_INLINE void TurnTrunk(const LimbPacks::TrunkJoint& joint, const Four& p_RJ_W, Four (&axes)[3]) {
    constexpr int i = (kAxis + 1) % 3, j = (kAxis + 2) % 3;
    const int hinge = joint.first_hinge + kAxis;
    const Four s(sines_[packs_.first_trunk_place + hinge]), c(cosines_[packs_.first_trunk_place + hinge]);
    const Four x = axes[i], y = axes[j];
    axes[i] = c * x + s * y;
    axes[j] = c * y - s * x;
    double* screw = trunk_hinges_[hinge].screw;
    PutFour(axes[kAxis], screw);
    PutFour(CrossAxes(p_RJ_W, axes[kAxis]), screw + 3);
  }

  /// Computes the forward kinematics of four limbs, outwards from the trunk joints to which the limbs are attached.
  void PlaceLimbs(const LimbPacks::Pack& pack, const double (&root)[12]) {
    FrameLanes<Four> frame;
    TakeFrames(pack, frame);
    const Four p_WR[3] = {Four(root[0]), Four(root[1]), Four(root[2])};
    for (const LimbPacks::Level& level : packs_.LevelsOf(pack)) {
      Four p_PJ_W[3], p_RJ_W[3];
      // Compute the position, the axes before the joints turn, the rotations, and the effectors.
      MixLoaded(frame.axes, level.p_PJ, p_PJ_W);
      for (int k = 0; k < 3; ++k) {
        frame.position[k] = frame.position[k] + p_PJ_W[k];
        p_RJ_W[k] = frame.position[k] - p_WR[k];
      }
      if (level.turns_axes) {
        Four turned[3][3];
        for (int c = 0; c < 3; ++c) MixLoaded(frame.axes, level.R_PJ[c], turned[c]);
        for (int c = 0; c < 3; ++c) Copy3(turned[c], frame.axes[c]);
      }
      if (level.hinge_count > 0) TurnLimbs<0>(level, p_RJ_W, frame.axes);
      if (level.hinge_count > 1) TurnLimbs<1>(level, p_RJ_W, frame.axes);
      if (level.hinge_count > 2) TurnLimbs<2>(level, p_RJ_W, frame.axes);
      if (level.ends >= 0) LineariseEnds(level.ends, frame, p_WR);
    }
  }

  static HWY_INLINE void MixLoaded(const Four (&axes)[3][3], const double (&from)[3][4], Four (&out)[3]) {
    const Four by[3] = {LoadFour(from[0]), LoadFour(from[1]), LoadFour(from[2])};
    Mix(axes, by, out);
  }

  /// Sets the lanes of `frame` to the frames of the trunk joints to which the limbs are attached.
  HWY_INLINE void TakeFrames(const LimbPacks::Pack& pack, FrameLanes<Four>& frame) {
    const TrunkFrame* from[LimbPacks::kWidth];
    for (int lane = 0; lane < LimbPacks::kWidth; ++lane) from[lane] = &trunk_[pack.parents[lane]];
    const auto take = [&from](const auto& part, Four(&out)[3]) HWY_ATTR {
      Four x = part(*from[0]), y = part(*from[1]), z = part(*from[2]), none = part(*from[3]);
      Transpose(x, y, z, none);
      out[0] = x;
      out[1] = y;
      out[2] = z;
    };
    for (int c = 0; c < 3; ++c) {
      take([c](const TrunkFrame& at) HWY_ATTR { return at.axes[c]; }, frame.axes[c]);
    }
    take([](const TrunkFrame& at) HWY_ATTR { return at.position; }, frame.position);
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

  HWY_INLINE void LineariseEnds(int number, const FrameLanes<Four>& limb, const Four (&p_WR)[3]) {
    const LimbPacks::Ends& ends = packs_.ends[number];
    FrameLanes<Four>& frame = ends_[number].frame;
    Four p_LE_W[3], p_WE[3];
    MixLoaded(limb.axes, ends.p_LE, p_LE_W);
    for (int k = 0; k < 3; ++k) p_WE[k] = limb.position[k] + p_LE_W[k];
    for (int c = 0; c < 3; ++c) Copy3(limb.axes[c], frame.axes[c]);
    Copy3(p_WE, frame.position);
    ResidualLanes<Four> miss{Four(0.0), Four(0.0), Four(0.0)};
    Linearise(ends_[number].target, limb.axes, p_WE, p_WR, ends_[number].asked, miss);
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
  AlignedList<double> sines_, cosines_;
  AlignedList<TrunkFrame> trunk_;
  AlignedList<TrunkHinge> trunk_hinges_;
  AlignedList<HingeLanes<Four>> hinges_;  // one per slot
  AlignedList<EndsState> ends_;
  AlignedList<double> squares_of_;  // |e|² of each effector
  ResidualLanes<double> miss_{};
};

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_LIMB_POSES_INL_H_
