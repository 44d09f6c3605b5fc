#pragma once

#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// A tree in the form that `MomentSweep` needs: plain numbers, and a list of steps that is the same for every
/// problem. The steps in their order are a sweep from the leaves to the root; in reverse order they are forward
/// kinematics. Each limb has a frame S instead of the tree's frame. If the tree's R_PJ maps every axis to ± an axis,
/// as at every joint of paper B's body, S has the axes of the parent's S while all angles of the joint are zero. R_PJ
/// is then the identity and needs no computation. The names P, J and L have the meaning that `TreeJoint` gives them,
/// but with the frames S.
struct SweepTree {
  struct Joint {
    int parent = -1;
    int moments = -1;         ///< index of the moments of its limb
    bool is_first = false;    ///< true if the parent's limb receives this limb's moments before all others
    bool is_aligned = false;  ///< true if `R_PJ` is the identity
    int base[3] = {};         ///< indices of the axes before the hinges turn; an axis of the parent keeps its index
    int axes[3] = {};         ///< indices of the axes after all hinges of the joint have turned
    double R_PJ[3][3] = {};   ///< [row][column]
    double p_PJ[3] = {};
  };
  struct Effector {
    int joint = 0;
    bool is_first = false;  ///< true for the first effector of its limb
    double p_LE[3] = {};
    int names[3] = {};     ///< for each axis of S: the index (0, 1 or 2) of the parallel axis of the effector
    double signs[3] = {};  ///< for each axis of S: 1 if the parallel axis points in the same direction, else −1
  };
  /// A step of one joint. Either one of its hinges turns, or, after all its hinges, the moments of the joint's limb
  /// (moment_sweep.cc) are added to those of the parent limb.
  struct Step {
    int joint = 0;
    int hinge = -1;             ///< −1 for the step to the parent
    int i = 0, j = 0;           ///< the hinge turns axis i towards axis j
    int from = 0, towards = 0;  ///< indices of the axes i and j as they are before the turn
    int turned = 0;             ///< index of the turned axis i; the turned axis j has the index `turned` + 1
  };

  std::vector<Joint> joints;
  std::vector<Effector> effectors;
  /// The steps of a joint come after those of its descendants; limbs with no effector on or beyond them are left out.
  /// Independent limbs alternate, so that a CPU can overlap them.
  std::vector<Step> steps;
  int axis_count = 0;
  int moments_count = 0;

  explicit SweepTree(const KinematicTree& tree);

 private:
  void NameAxes(const KinematicTree& tree);
  void PlaceAxes();
  void PlaceMoments();
};

}  // namespace etude
