#include "engine/kinematics/solvers/gauss_newton_tree.h"

#include <algorithm>
#include <cmath>

#include "engine/kinematics/tree.h"

namespace etude {
namespace {

constexpr int kMaxDofs = 3;  // maximum number of degrees of freedom of a joint

// Sets the axes of a joint, and finds whether each axis of the joint is ± an axis of its parent.
void DescribeAxes(const glm::dmat3& R_PJ, GaussNewtonTree::Joint& joint) {
  joint.renames_axes = true;
  for (int c = 0; c < 3; ++c) {
    int ones = 0;
    for (int r = 0; r < 3; ++r) {
      joint.R_PJ[c][r] = R_PJ[c][r];
      if (R_PJ[c][r] == 0) continue;
      joint.from[c] = r;
      joint.sign[c] = R_PJ[c][r];
      ones += std::abs(R_PJ[c][r]) == 1 ? 1 : 2;
    }
    joint.renames_axes &= ones == 1;
  }
}

constexpr int kMaxLanes = 8;  // maximum number of doubles in a vector of any CPU

// An unbranched chain of joints, possibly empty, beyond the joint `parent` of the tree.
struct Limb {
  int parent = 0, first_joint = -1, joint_count = 0;
  int effector = -1;  // index of the effector at the limb's end; −1 if there is none
  LimbPacks::Branch branch = {};
};

// Builds `LimbPacks`: finds the trunk, then the limbs, then groups the limbs into packs of four.
class LimbPacker {
 public:
  LimbPacker(const KinematicTree& tree, LimbPacks& made)
      : tree_(tree), made_(made), inwards_(JointsInwards(tree)), joints_(tree.joints.size()) {
    made.places.resize(tree.limits.size());
    made.end_places.resize(tree.effectors.size());
  }

  void Make() {
    FindTrunk();
    FindLimbs();
    made_.levels.reserve(joints_.size());
    made_.ends.reserve(joints_.size());
    for (std::size_t first = 0; first < limbs_.size(); first += LimbPacks::kWidth) {
      AddPack(std::span(limbs_).subspan(first, std::min<std::size_t>(LimbPacks::kWidth, limbs_.size() - first)));
    }
    AddTrunkHinges();
    AddBranches();
  }

 private:
  struct Joint {
    int child_count = 0, effector_count = 0;
    int next = -1;      // the next joint outwards, within a limb
    int effector = -1;  // the last effector of the joint
    int trunk = -1;     // the joint's index in the trunk, or −1
    bool is_trunk = false;
  };

  // Finds the trunk: joints with several branches or several effectors, and all joints between them and the root.
  void FindTrunk() {
    for (std::size_t e = 0; e < tree_.effectors.size(); ++e) {
      Joint& joint = joints_[tree_.effectors[e].joint];
      ++joint.effector_count;
      joint.effector = static_cast<int>(e);
    }
    // From the leaves inwards, mark the trunk joints and all their ancestors.
    for (std::size_t n = joints_.size() - 1; n > 0; --n) {
      Joint &joint = joints_[n], &parent = joints_[tree_.joints[n].parent];
      joint.is_trunk |= joint.child_count > 1 || joint.effector_count > 1;
      parent.is_trunk |= joint.is_trunk;
      ++parent.child_count;
    }
    joints_[0].is_trunk = true;
    // Copy the trunk joints as plain numbers.
    made_.trunk.reserve(joints_.size());
    made_.inwards.reserve(joints_.size());
    for (std::size_t n = 0; n < joints_.size(); ++n) {
      if (!joints_[n].is_trunk) continue;
      const TreeJoint& from = tree_.joints[n];
      joints_[n].trunk = static_cast<int>(made_.trunk.size());
      LimbPacks::TrunkJoint& made = made_.trunk.emplace_back();
      made.parent = n == 0 ? -1 : joints_[from.parent].trunk;
      made.hinge_count = from.dof_count;
      for (int k = 0; k < 3; ++k) {
        made.p_PJ[k] = from.p_PJ[k];
        for (int c = 0; c < 3; ++c) made.R_PJ[c][k] = from.R_PJ[c][k];
      }
    }
    for (const int n : inwards_) {
      if (joints_[n].is_trunk) made_.inwards.push_back(joints_[n].trunk);
    }
  }

  // Finds the limbs, the longest first. An effector on the trunk counts as a limb without joints.
  void FindLimbs() {
    limbs_.reserve(tree_.effectors.size() + joints_.size());
    for (std::size_t e = 0; e < tree_.effectors.size(); ++e) {
      const int joint = tree_.effectors[e].joint;
      if (joints_[joint].is_trunk) limbs_.push_back({.parent = joint, .effector = static_cast<int>(e)});
    }
    for (const int n : inwards_) {
      const int parent = tree_.joints[n].parent;
      if (joints_[n].is_trunk) continue;
      joints_[parent].next = n;
      if (!joints_[parent].is_trunk) continue;
      Limb& limb = limbs_.emplace_back(Limb{.parent = parent, .first_joint = n});
      for (int joint = n; joint >= 0; joint = joints_[joint].next) {
        ++limb.joint_count;
        limb.effector = joints_[joint].effector;
      }
    }
    std::ranges::stable_sort(limbs_, [](const Limb& a, const Limb& b) { return a.joint_count > b.joint_count; });
  }

  void AddPack(std::span<Limb> limbs) {
    // Assign each limb of the pack to a lane.
    const int number = static_cast<int>(made_.packs.size());
    LimbPacks::Pack& pack = made_.packs.emplace_back();
    pack.first_level = static_cast<int>(made_.levels.size());
    pack.level_count = std::max(1, limbs[0].joint_count);
    int joints[LimbPacks::kWidth] = {-1, -1, -1, -1};
    for (int lane = 0; lane < static_cast<int>(limbs.size()); ++lane) {
      Limb& limb = limbs[lane];
      limb.branch = {number, lane};
      pack.parents[lane] = joints_[limb.parent].trunk;
      joints[lane] = limb.first_joint;
    }
    // Add the levels from the trunk outwards. A level contains one joint of every limb, and its effector; shorter limbs
    // end in the last level.
    for (int l = 0; l < pack.level_count; ++l) {
      LimbPacks::Level& level = made_.levels.emplace_back();
      level.first_slot = made_.slot_count;
      for (int lane = 0; lane < LimbPacks::kWidth; ++lane) {
        for (int k = 0; k < 3; ++k) level.R_PJ[k][k][lane] = 1;
        int& joint = joints[lane];
        const bool is_last = l + 1 == pack.level_count;
        if (is_last && lane < static_cast<int>(limbs.size())) SetEnd(limbs[lane].effector, lane, level);
        if (joint < 0) continue;
        SetJoint(tree_.joints[joint], lane, level);
        const bool has_more = joints_[joint].next >= 0;
        if (has_more) SetEnd(joints_[joint].effector, lane, level);
        joint = joints_[joint].next;
      }
      made_.slot_count += level.hinge_count;
    }
  }

  void SetJoint(const TreeJoint& joint, int lane, LimbPacks::Level& level) {
    for (int k = 0; k < 3; ++k) {
      level.p_PJ[k][lane] = joint.p_PJ[k];
      for (int c = 0; c < 3; ++c) level.R_PJ[c][k][lane] = joint.R_PJ[c][k];
    }
    level.turns_axes |= joint.R_PJ != glm::dmat3(1);
    level.hinge_count = std::max(level.hinge_count, joint.dof_count);
    for (int h = 0; h < joint.dof_count; ++h) {
      level.has_hinge[h][lane] = 1;
      made_.places[joint.first_dof + h] = LimbPacks::kWidth * (level.first_slot + h) + lane;
    }
  }

  void SetEnd(int effector, int lane, LimbPacks::Level& level) {
    if (effector < 0) return;
    if (level.ends < 0) {
      level.ends = static_cast<int>(made_.ends.size());
      made_.ends.emplace_back();
    }
    LimbPacks::Ends& ends = made_.ends[level.ends];
    ends.effectors[lane] = effector;
    made_.end_places[effector] = LimbPacks::kWidth * level.ends + lane;
    for (int k = 0; k < 3; ++k) ends.p_LE[k][lane] = tree_.effectors[effector].p_LE[k];
  }

  void AddTrunkHinges() {
    made_.first_trunk_place = LimbPacks::kWidth * made_.slot_count;
    for (std::size_t n = 1; n < joints_.size(); ++n) {
      if (!joints_[n].is_trunk) continue;
      LimbPacks::TrunkJoint& made = made_.trunk[joints_[n].trunk];
      made.first_hinge = made_.trunk_hinge_count;
      for (int h = 0; h < made.hinge_count; ++h) {
        made_.places[tree_.joints[n].first_dof + h] = made_.first_trunk_place + made_.trunk_hinge_count++;
      }
    }
    const int places = made_.first_trunk_place + made_.trunk_hinge_count;
    made_.place_count = (places + kMaxLanes - 1) / kMaxLanes * kMaxLanes;
  }

  // Lists the branches of each trunk joint: first its own effectors, then the limbs and trunk joints beyond it.
  void AddBranches() {
    for (std::size_t n = 0; n < joints_.size(); ++n) {
      if (!joints_[n].is_trunk) continue;
      LimbPacks::TrunkJoint& made = made_.trunk[joints_[n].trunk];
      made.first_branch = static_cast<int>(made_.branches.size());
      for (const Limb& limb : limbs_) {
        if (limb.parent == static_cast<int>(n) && limb.joint_count == 0) made_.branches.push_back(limb.branch);
      }
      for (const int child : inwards_) {
        if (tree_.joints[child].parent != static_cast<int>(n)) continue;
        if (joints_[child].is_trunk) {
          made_.branches.push_back({-1, joints_[child].trunk});
        } else {
          const auto begins_there = [child](const Limb& limb) { return limb.first_joint == child; };
          made_.branches.push_back(std::ranges::find_if(limbs_, begins_there)->branch);
        }
      }
      made.branch_count = static_cast<int>(made_.branches.size()) - made.first_branch;
    }
  }

  const KinematicTree& tree_;
  LimbPacks& made_;
  const std::vector<int> inwards_;
  std::vector<Joint> joints_;
  std::vector<Limb> limbs_;
};

}  // namespace

std::vector<int> JointHeights(const KinematicTree& tree) {
  std::vector<int> height(tree.joints.size());
  for (std::size_t n = tree.joints.size() - 1; n > 0; --n) {
    int& above = height[tree.joints[n].parent];
    above = std::max(above, height[n] + 1);
  }
  return height;
}

std::vector<int> JointsInwards(const KinematicTree& tree) {
  const std::vector<int> height = JointHeights(tree);
  std::vector<int> inwards;
  inwards.reserve(tree.joints.size());
  for (int h = 0; h < height[0]; ++h) {
    for (std::size_t n = 1; n < tree.joints.size(); ++n) {
      if (height[n] == h) inwards.push_back(static_cast<int>(n));
    }
  }
  return inwards;
}

GaussNewtonTree::GaussNewtonTree(const KinematicTree& tree)
    : joints(tree.joints.size()), inwards(JointsInwards(tree)), dof_count(tree.dof_count()) {
  for (std::size_t n = 1; n < joints.size(); ++n) {
    const TreeJoint& from = tree.joints[n];
    joints[n].parent = from.parent;
    joints[n].first_dof = from.first_dof;
    joints[n].dof_count = from.dof_count;
    for (int k = 0; k < 3; ++k) joints[n].p_PJ[k] = from.p_PJ[k];
    DescribeAxes(from.R_PJ, joints[n]);
  }
  // Assign memory to the quadratic of each limb. A limb without effectors of its own shares the memory of its first
  // branch.
  for (const etude::Effector& from : tree.effectors) {
    Effector& made = effectors.emplace_back(Effector{from.joint, {from.p_LE.x, from.p_LE.y, from.p_LE.z}});
    int& quadratic = joints[from.joint].quadratic;
    made.is_first = quadratic < 0;
    if (made.is_first) quadratic = quadratic_count++;
  }
  for (const int n : inwards) {
    Joint& joint = joints[n];
    if (joint.quadratic < 0) {
      joint.quadratic = quadratic_count++;
      unasked.push_back(n);
    }
    int& quadratic = joints[joint.parent].quadratic;
    if (quadratic < 0) quadratic = joint.quadratic;
  }
  // List the steps of elimination by the joints' heights in the tree, leaves first. For each height, list the last
  // hinge of every joint, then the last but one of every joint, and so on; then the additions to the parents.
  const std::vector<int> heights = JointHeights(tree);
  for (auto first = inwards.begin(); first != inwards.end();) {
    const auto is_higher = [&](int n) { return heights[n] > heights[*first]; };
    const auto last = std::find_if(first, inwards.end(), is_higher);
    for (int turn = 1; turn <= kMaxDofs; ++turn) {
      for (auto n = first; n != last; ++n) {
        if (turn <= joints[*n].dof_count) steps.push_back({*n, joints[*n].first_dof + joints[*n].dof_count - turn});
      }
    }
    for (auto n = first; n != last; ++n) {
      const int parent = joints[*n].parent;
      if (parent != 0 && joints[parent].quadratic != joints[*n].quadratic) steps.push_back({*n, -1});
    }
    first = last;
  }
}

LimbPacks::LimbPacks(const KinematicTree& tree) { LimbPacker(tree, *this).Make(); }

}  // namespace etude
