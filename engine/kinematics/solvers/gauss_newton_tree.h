#pragma once

// Kinematic trees as plain arrays, stored in the order in which the solver reads them. They do not use GLM, because
// files that are compiled once per instruction set include this header.
#include <cstddef>
#include <span>
#include <vector>

namespace etude {

struct KinematicTree;

/// Returns the height of every joint: the number of its descendants on the longest way to a leaf (0 for a leaf).
std::vector<int> JointHeights(const KinematicTree& tree);

/// Returns the joints without the root, sorted by height: each comes after its descendants, and joints of one height
/// are independent of each other.
std::vector<int> JointsInwards(const KinematicTree& tree);

/// The tree in the form that the solver of many problems needs (gauss_newton_lanes.cc).
struct GaussNewtonTree {
  struct Joint {
    int parent = -1;
    int first_dof = 0, dof_count = 0;
    bool renames_axes = false;  ///< true if every axis of `R_PJ` is ± an axis of the parent
    int from[3] = {};           ///< for each axis: the index of the parent's axis along which it lies
    double sign[3] = {};        ///< for each axis: 1 if it points as the parent's axis does, −1 if opposite to it
    double R_PJ[3][3] = {};     ///< [column][row]
    double p_PJ[3] = {};
    int quadratic = -1;  ///< index of the limb's quadratic; the parent's limb may have the same index
  };
  struct Effector {
    int joint = 0;
    double p_LE[3] = {};
    bool is_first = false;  ///< true for the first effector of its limb
  };

  /// One step of elimination: a hinge, or, after all hinges of a joint, the addition of the limb's quadratic to the
  /// parent limb's quadratic.
  struct Step {
    int joint = 0;
    int dof = -1;  ///< −1 if the step is the addition
  };

  std::vector<Joint> joints;
  std::vector<Effector> effectors;
  std::vector<int> inwards;  ///< joints sorted by height, each after its descendants (`JointsInwards`)
  std::vector<Step> steps;   ///< in the order of `inwards`; joints of one height alternate, so that a CPU overlaps them
  std::vector<int> unasked;  ///< joints that move no effector
  int quadratic_count = 0;
  int dof_count = 0;

  /// `tree` must be free of faults (`FindFault`).
  explicit GaussNewtonTree(const KinematicTree& tree);
};

/// A tree divided for vectors of four numbers. *Limbs* are unbranched chains of joints that end in a leaf; four of them
/// side by side form a *pack*. The other joints, between the limbs, form the *trunk* and are computed one by one. In
/// paper B's body, the arms, the right leg and the neck form one pack. If a limb has fewer joints, axes or effectors
/// than others of its pack, neutral entries are added. All numbers are stored in the order of use.
struct LimbPacks {
  static constexpr int kWidth = 4;
  static constexpr std::size_t kAlignment = kWidth * sizeof(double);

  /// One joint of each limb of a pack.
  struct Level {
    alignas(kAlignment) double R_PJ[3][3][kWidth] = {};  ///< [column][row]
    alignas(kAlignment) double p_PJ[3][kWidth] = {};
    alignas(kAlignment) double has_hinge[3][kWidth] = {};  ///< 1 if the limb has this hinge, else 0
    bool turns_axes = false;                               ///< true if `R_PJ` of any limb is not the identity
    int hinge_count = 0;                                   ///< largest number of hinges of a joint of the level
    /// Slot of the first hinge; slot s holds the angle indices 4 s … 4 s + 3.
    int first_slot = 0;
    int ends = -1;  ///< index of this level's effectors in LimbPacks::ends; −1 if the level has no effectors
  };
  /// One effector of each of four limbs. For a limb without an effector, the target has weight 0.
  struct Ends {
    alignas(kAlignment) double p_LE[3][kWidth] = {};
    int effectors[kWidth] = {-1, -1, -1, -1};
  };
  struct Pack {
    int parents[kWidth] = {};  ///< the trunk joint to which each limb is attached
    int first_level = 0, level_count = 0;
  };
  /// A branch of a trunk joint: a limb, or another trunk joint (`pack` = −1).
  struct Branch {
    int pack = -1;
    int number = 0;  ///< lane of the limb, or index of the trunk joint
  };
  struct TrunkJoint {
    int parent = -1;
    double R_PJ[3][3] = {};  ///< [column][row]
    double p_PJ[3] = {};
    int first_hinge = 0, hinge_count = 0;  ///< hinge h has the angle index first_trunk_place + h
    int first_branch = 0, branch_count = 0;
  };

  std::vector<Pack> packs;
  std::vector<Level> levels;  ///< the levels of the first pack from the trunk outwards, then those of the next pack
  std::vector<Ends> ends;
  std::vector<TrunkJoint> trunk;  ///< parents before children, the root first
  std::vector<Branch> branches;   ///< by trunk joint, then in the order in which their quadratics are added
  std::vector<int> inwards;       ///< trunk joints without the root, each after its descendants
  std::vector<int> places;        ///< the angle index of each degree of freedom
  std::vector<int> end_places;    ///< for each effector: 4 times its index in `ends`, plus its lane
  int slot_count = 0;
  int trunk_hinge_count = 0;
  int first_trunk_place = 0;
  int place_count = 0;  ///< number of angle indices, rounded up to a multiple of every vector width

  /// `tree` must be free of faults (`FindFault`).
  explicit LimbPacks(const KinematicTree& tree);

  std::span<const Level> LevelsOf(const Pack& pack) const {
    return {levels.data() + pack.first_level, static_cast<std::size_t>(pack.level_count)};
  }
  std::span<const Branch> BranchesOf(const TrunkJoint& joint) const {
    return {branches.data() + joint.first_branch, static_cast<std::size_t>(joint.branch_count)};
  }
};

}  // namespace etude
