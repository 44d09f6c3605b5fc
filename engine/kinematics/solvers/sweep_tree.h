#pragma once

#include <vector>

#include "engine/kinematics/tree.h"

namespace etude {

/// A tree as `MomentSweep` reads it: plain numbers and a list of steps, the same for every problem. Forwards, the steps
/// are a sweep from the leaves to the root; backwards, they are forward kinematics. Its limbs have frames S of their
/// own: where R_PJ of the tree only swaps axes, as everywhere on the body, the sweep names the limb's axes after the
/// parent's, so that R_PJ is the identity here and nothing is left to do from limb to limb. P, J and L below are limbs
/// in the sweep's frames.
struct SweepTree {
  struct Joint {
    int parent = -1;
    int moments = -1;         ///< where the moments of its limb are
    bool is_first = false;    ///< its limb hands its moments on to its parent's, which has none before that
    bool is_aligned = false;  ///< `R_PJ` is the identity
    int base[3] = {};         ///< where its axes are before the joint turns: the parent's own where they are the same
    int axes[3] = {};         ///< where the limb's axes are
    double R_PJ[3][3] = {};   ///< rows
    double p_PJ[3] = {};
  };
  struct Effector {
    int joint = 0;
    bool is_first = false;  ///< of its limb
    double p_LE[3] = {};
    int names[3] = {};     ///< of each axis of the sweep's: which of the tree's it is
    double signs[3] = {};  ///< and whether it points the same way, ±1
  };
  /// One hinge of a joint turns, or, after all of these, the joint's limb meets its parent's.
  struct Step {
    int joint = 0;
    int hinge = -1;             ///< −1: meets its parent
    int i = 0, j = 0;           ///< the hinge turns axis i towards axis j
    int from = 0, towards = 0;  ///< where these axes are before the turn
    int turned = 0;             ///< where they are after it, one after the other
  };

  std::vector<Joint> joints;
  std::vector<Effector> effectors;
  /// Each joint's after those of all joints beyond it, limbs without effectors left out. Limbs that do not depend on
  /// each other take turns, so that a processor can work on several at once.
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
