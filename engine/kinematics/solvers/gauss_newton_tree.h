#pragma once

#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// A tree as Gauss–Newton steps in lanes read it (gauss_newton_kernel-inl.h): plain numbers in the order of use.
struct GaussNewtonTree {
  struct Joint {
    int parent = -1;
    int first_dof = 0, dof_count = 0;
    bool renames_axes = false;  ///< `R_PJ` only swaps and turns round the parent's axes:
    int from[3] = {};           ///< which of them each axis is,
    double sign[3] = {};        ///< and whether it points the same way, ±1
    double R_PJ[3][3] = {};     ///< columns
    double p_PJ[3] = {};
    int quadratic = -1;  ///< where what is asked of its limb is gathered; its parent may go on there
  };
  struct Effector {
    int joint = 0;
    double p_LE[3] = {};
    bool is_first = false;  ///< of its limb
  };

  /// A hinge is eliminated, or, after all of a joint, what is asked of its limb is added to its parent's.
  struct Step {
    int joint = 0;
    int dof = -1;  ///< −1: the addition
  };

  std::vector<Joint> joints;
  std::vector<Effector> effectors;
  std::vector<int> inwards;  ///< joints, each after all beyond it; by height, so that neighbours are independent
  std::vector<Step> steps;   ///< in that order; joints of one height take turns, for processors to overlap them
  std::vector<int> unasked;  ///< joints with nothing beyond that has a target
  int quadratic_count = 0;
  int dof_count = 0;

  /// `tree` must be free of faults (`FindFault`).
  explicit GaussNewtonTree(const KinematicTree& tree);
};

/// Joints without the root, each after all beyond it: by height.
std::vector<int> JointsInwards(const KinematicTree& tree);

}  // namespace etude
