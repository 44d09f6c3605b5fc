// Poses of many problems on the same tree, one in each lane: forward kinematics, in the order of `ComputeFrames`, and
// what targets ask there. Compiled once per target, hence this kind of guard.
#if defined(ETUDE_LANE_POSES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_LANE_POSES_INL_H_
#undef ETUDE_LANE_POSES_INL_H_
#else
#define ETUDE_LANE_POSES_INL_H_
#endif

#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "engine/kinematics/solvers/gauss_newton_tree.h"
#include "engine/kinematics/solvers/lanes-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

/// The angles of one degree of freedom.
template <class V>
struct AngleLanes {
  V now, last, best, start, lower, upper;
};

template <class T>
class LanePoses {
 public:
  using V = Lanes<T>;

  explicit LanePoses(const GaussNewtonTree& tree)
      : tree_(tree),
        hinges_(tree.dof_count),
        frames_(tree.joints.size()),
        targets_(tree.effectors.size()),
        asked_(tree.effectors.size()),
        miss_(1) {}

  /// The root and the targets of a problem: numbers as `IkBatch::Column` has them, `stride` apart.
  void Load(int n, const double* from, std::size_t stride) {
    const auto take = [&from, stride] {
      const double number = *from;
      from += stride;
      return number;
    };
    // In float, places are counted from the root, where they have the most digits.
    constexpr bool kFromRoot = sizeof(T) < sizeof(double);
    double origin[3] = {};
    for (int k = 0; k < 3; ++k) {
      const double place = take();
      if (kFromRoot) origin[k] = place;
      SetLane(frames_[0].position[k], n, place - origin[k]);
    }
    for (int k = 0; k < 9; ++k) SetLane(frames_[0].axes[k / 3][k % 3], n, take());
    for (TargetLanes<V>& target : targets_) {
      for (int k = 0; k < 3; ++k) SetLane(target.position[k], n, take() - origin[k]);
      for (int k = 0; k < 9; ++k) SetLane(target.axes[k / 3][k % 3], n, take());
      SetLane(target.position_weight, n, take() / kSquaredPositionScale);
      for (int k = 0; k < 3; ++k) SetLane(target.axis_weights[k], n, take());
    }
  }

  void Place(const AlignedList<AngleLanes<V>>& angles) {
    PlaceLimbs(angles);
    Linearise();
  }

  /// How far the poses are off.
  const MissLanes<V>& miss() const { return miss_[0]; }
  const AskedLanes<V>& AskedOf(std::size_t effector) const { return asked_[effector]; }
  /// With their screws at the poses; all else in them is the step's.
  AlignedList<HingeLanes<V>>& hinges() { return hinges_; }

 private:
  void PlaceLimbs(const AlignedList<AngleLanes<V>>& angles) {
    const FrameLanes<V>& root = frames_[0];
    for (std::size_t n = 1; n < tree_.joints.size(); ++n) {
      const GaussNewtonTree::Joint& joint = tree_.joints[n];
      const FrameLanes<V>& parent = frames_[joint.parent];
      FrameLanes<V>& frame = frames_[n];
      V p_RJ_W[3], axes[3][3];
      V p_PJ_W[3];
      Mix(parent.axes, joint.p_PJ, p_PJ_W);
      for (int k = 0; k < 3; ++k) {
        frame.position[k] = parent.position[k] + p_PJ_W[k];
        p_RJ_W[k] = frame.position[k] - root.position[k];
      }
      if (joint.renames_axes) {
        for (int c = 0; c < 3; ++c) {
          for (int k = 0; k < 3; ++k) axes[c][k] = parent.axes[joint.from[c]][k] * V(joint.sign[c]);
        }
      } else {
        for (int c = 0; c < 3; ++c) Mix(parent.axes, joint.R_PJ[c], axes[c]);
      }
      if (joint.dof_count > 0) TurnHinge<0>(joint, angles, p_RJ_W, axes);
      if (joint.dof_count > 1) TurnHinge<1>(joint, angles, p_RJ_W, axes);
      if (joint.dof_count > 2) TurnHinge<2>(joint, angles, p_RJ_W, axes);
      for (int c = 0; c < 3; ++c) Copy3(axes[c], frame.axes[c]);
    }
  }

  template <int kAxis>
  HWY_INLINE void TurnHinge(const GaussNewtonTree::Joint& joint, const AlignedList<AngleLanes<V>>& angles,
                            const V (&p_RJ_W)[3], V (&axes)[3][3]) {
    const int dof = joint.first_dof + kAxis;
    V s, c;
    SineAndCosine(angles[dof].now, s, c);
    TurnAxes<kAxis>(s, c, axes);
    SetScrew(axes[kAxis], p_RJ_W, hinges_[dof].screw);
  }

  void Linearise() {
    MissLanes<V> miss{V(0.0), V(0.0), V(0.0)};
    for (std::size_t e = 0; e < tree_.effectors.size(); ++e) {
      const GaussNewtonTree::Effector& effector = tree_.effectors[e];
      const FrameLanes<V>& limb = frames_[effector.joint];
      V p_WE[3];
      Mix(limb.axes, effector.p_LE, p_WE);
      for (int k = 0; k < 3; ++k) p_WE[k] = limb.position[k] + p_WE[k];
      HWY_NAMESPACE::Linearise(targets_[e], limb.axes, p_WE, frames_[0].position, asked_[e], miss);
    }
    miss_[0] = miss;
  }

  const GaussNewtonTree& tree_;
  AlignedList<HingeLanes<V>> hinges_;
  AlignedList<FrameLanes<V>> frames_;  // of each joint's limb
  AlignedList<TargetLanes<V>> targets_;
  AlignedList<AskedLanes<V>> asked_;
  AlignedList<MissLanes<V>> miss_;
};

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_LANE_POSES_INL_H_
