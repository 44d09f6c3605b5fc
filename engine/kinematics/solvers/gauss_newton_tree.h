#pragma once

// Trees as plain numbers in the order of use, for code that is compiled once per instruction set: no GLM.
#include <cstddef>
#include <span>
#include <vector>

namespace etude {

struct KinematicTree;

/// A tree for many problems, one in each lane (gauss_newton_lanes.cc).
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

  /// Takes a tree that is free of faults (`FindFault`).
  explicit GaussNewtonTree(const KinematicTree& tree);
};

/// A tree taken apart for vectors of four numbers: *limbs*, chains of joints from a leaf inwards that nothing branches
/// off, four side by side in a *pack*, and the *trunk*, the joints between them, one by one. Of paper B's body the
/// arms, the right leg and the neck are one pack. What a pack's limb lacks, a joint, an axis or an effector, it has as
/// one that changes nothing. Plain numbers in the order of use.
struct LimbPacks {
  static constexpr int kWidth = 4;
  static constexpr std::size_t kAlignment = kWidth * sizeof(double);

  /// One joint of each limb of a pack.
  struct Level {
    alignas(kAlignment) double R_PJ[3][3][kWidth] = {};  ///< columns
    alignas(kAlignment) double p_PJ[3][kWidth] = {};
    alignas(kAlignment) double has_hinge[3][kWidth] = {};  ///< 1, or 0 where the limb lacks it
    bool turns_axes = false;                               ///< `R_PJ` is not 1 for all of them
    int hinge_count = 0;                                   ///< of the joint that has the most
    int first_slot = 0;                                    ///< of its hinges: slot s has the places 4 s … 4 s + 3
    int ends = -1;                                         ///< its effectors in `ends`, if it has any
  };
  /// One effector each of four limbs: those without one have a target without weight.
  struct Ends {
    alignas(kAlignment) double p_LE[3][kWidth] = {};
    int effectors[kWidth] = {-1, -1, -1, -1};
  };
  struct Pack {
    int parents[kWidth] = {};  ///< joints of the trunk
    int first_level = 0, level_count = 0;
  };
  /// A limb, or another joint of the trunk (`pack` −1), that joins the trunk at a joint.
  struct Branch {
    int pack = -1;
    int number = 0;  ///< lane, or joint
  };
  struct TrunkJoint {
    int parent = -1;
    double R_PJ[3][3] = {};  ///< columns
    double p_PJ[3] = {};
    int first_hinge = 0, hinge_count = 0;  ///< hinge h has the place first_trunk_place + h
    int first_branch = 0, branch_count = 0;
  };

  std::vector<Pack> packs;
  std::vector<Level> levels;  ///< pack after pack, outwards
  std::vector<Ends> ends;
  std::vector<TrunkJoint> trunk;  ///< parents before children, the root first
  std::vector<Branch> branches;   ///< of joint after joint, in the order in which `GaussNewtonStep` adds them up
  std::vector<int> inwards;       ///< of the trunk without the root, each joint after all beyond it
  std::vector<int> places;        ///< of each degree of freedom
  std::vector<int> end_places;    ///< of each effector: 4 times its place in `ends`, plus its lane
  int slot_count = 0;
  int trunk_hinge_count = 0;
  int first_trunk_place = 0;
  int place_count = 0;  ///< whole vectors of any width

  /// Takes a tree that is free of faults (`FindFault`).
  explicit LimbPacks(const KinematicTree& tree);

  std::span<const Level> LevelsOf(const Pack& pack) const {
    return {levels.data() + pack.first_level, static_cast<std::size_t>(pack.level_count)};
  }
  std::span<const Branch> BranchesOf(const TrunkJoint& joint) const {
    return {branches.data() + joint.first_branch, static_cast<std::size_t>(joint.branch_count)};
  }
};

}  // namespace etude
