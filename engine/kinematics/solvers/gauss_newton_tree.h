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
    int quadratic = -1;         ///< where what is asked of its limb is gathered
    bool hands_over = false;    ///< its parent goes on gathering there; else the limb's is added to the parent's
    bool is_empty = false;      ///< nothing is asked of it
  };
  struct Effector {
    int joint = 0;
    double p_LE[3] = {};
    bool is_first = false;  ///< of its limb
  };

  std::vector<Joint> joints;
  std::vector<Effector> effectors;
  std::vector<int> inwards;  ///< joints, each after all beyond it; by height, so that neighbours are independent
  int quadratic_count = 0;
  int dof_count = 0;

  /// `tree` must be free of faults (`FindFault`).
  explicit GaussNewtonTree(const KinematicTree& tree);
};

/// Joints without the root, each after all beyond it: by height.
std::vector<int> JointsInwards(const KinematicTree& tree);

}  // namespace etude
