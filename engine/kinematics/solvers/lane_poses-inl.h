// The forward kinematics of gauss_newton_lanes.cc. This file is included once per instruction set, hence the unusual
// include guard.
#if defined(ETUDE_LANE_POSES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ETUDE_LANE_POSES_INL_H_
#undef ETUDE_LANE_POSES_INL_H_
#else
#define ETUDE_LANE_POSES_INL_H_
#endif

#include "engine/kinematics/solvers/gauss_newton_kernel-inl.h"
#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "engine/kinematics/solvers/vectors-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

/// The angles of one degree of freedom, one problem per lane.
template <class V>
struct AngleLanes {
  V now, last, best, start, lower, upper;
};

/// Computes the forward kinematics of one pose per lane, in the order of `ComputeFrames`, and linearises the targets.
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

  /// Loads root and targets of a problem into lane n. The problem's numbers are `stride` apart, as in
  /// `IkBatch::column`.
  void Load(int n, const double* from, std::size_t stride) {
    const auto take = [&from, stride] {
      const double number = *from;
      from += stride;
      return number;
    };
    // In float, positions are stored relative to the root: smaller numbers have a finer resolution.
    constexpr bool kFromRoot = sizeof(T) < sizeof(double);
    double origin[3] = {};
    for (int k = 0; k < 3; ++k) {
      const double coordinate = take();
      if (kFromRoot) origin[k] = coordinate;
      SetLane(frames_[0].position[k], n, coordinate - origin[k]);
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

  /// Returns the residuals of all lanes.
  const ResidualLanes<V>& miss() const { return miss_[0]; }
  const TargetQuadraticLanes<V>& AskedOf(std::size_t effector) const { return asked_[effector]; }
  /// Returns the hinges. Forward kinematics (`Place`) sets each hinge's `screw`; a step uses the other members.
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
      // Compute the position of the joint.
      MixNumbers(parent.axes, joint.p_PJ, p_PJ_W);
      for (int k = 0; k < 3; ++k) {
        frame.position[k] = parent.position[k] + p_PJ_W[k];
        p_RJ_W[k] = frame.position[k] - root.position[k];
      }
      // Compute the axes before the joint turns. If each of them is ± an axis of the parent, copy the parent's.
      if (joint.renames_axes) {
        for (int c = 0; c < 3; ++c) {
          for (int k = 0; k < 3; ++k) axes[c][k] = parent.axes[joint.from[c]][k] * V(joint.sign[c]);
        }
      } else {
        for (int c = 0; c < 3; ++c) MixNumbers(parent.axes, joint.R_PJ[c], axes[c]);
      }
      // Apply the joint's rotations, in the order X, Y, Z.
      if (joint.dof_count > 0) TurnHinge<0>(joint, angles, p_RJ_W, axes);
      if (joint.dof_count > 1) TurnHinge<1>(joint, angles, p_RJ_W, axes);
      if (joint.dof_count > 2) TurnHinge<2>(joint, angles, p_RJ_W, axes);
      for (int c = 0; c < 3; ++c) Copy3(axes[c], frame.axes[c]);
    }
  }

  static HWY_INLINE void MixNumbers(const V (&axes)[3][3], const double (&numbers)[3], V (&out)[3]) {
    const V by[3] = {V(numbers[0]), V(numbers[1]), V(numbers[2])};
    Mix(axes, by, out);
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
    ResidualLanes<V> miss{V(0.0), V(0.0), V(0.0)};
    for (std::size_t e = 0; e < tree_.effectors.size(); ++e) {
      const GaussNewtonTree::Effector& effector = tree_.effectors[e];
      const FrameLanes<V>& limb = frames_[effector.joint];
      V p_WE[3];
      MixNumbers(limb.axes, effector.p_LE, p_WE);
      for (int k = 0; k < 3; ++k) p_WE[k] = limb.position[k] + p_WE[k];
      HWY_NAMESPACE::Linearise(targets_[e], limb.axes, p_WE, frames_[0].position, asked_[e], miss);
    }
    miss_[0] = miss;
  }

  const GaussNewtonTree& tree_;
  AlignedList<HingeLanes<V>> hinges_;
  AlignedList<FrameLanes<V>> frames_;  // the frame of each joint's limb
  AlignedList<TargetLanes<V>> targets_;
  AlignedList<TargetQuadraticLanes<V>> asked_;
  AlignedList<ResidualLanes<V>> miss_;
};

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif  // ETUDE_LANE_POSES_INL_H_
