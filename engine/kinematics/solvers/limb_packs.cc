#include "engine/kinematics/solvers/limb_packs.h"

#include <algorithm>
#include <span>

#include "engine/kinematics/solvers/gauss_newton_tree.h"

namespace etude {
namespace {

constexpr int kMostLanes = 8;  // of doubles, in any CPU's vectors

// Joints from the trunk outwards, or none, and the effector at the end.
struct Limb {
  int parent = 0;  // joint of the tree
  std::vector<int> joints;
  int effector = -1;
};

class Maker {
 public:
  Maker(const KinematicTree& tree, LimbPacks& made) : tree_(tree), made_(made), effectors_(tree.joints.size()) {
    for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
      effectors_[tree.effectors[e].joint].push_back(static_cast<int>(e));
    }
    inwards_ = JointsInwards(tree);
    made.places.resize(tree.limits.size());
    made.end_places.resize(tree.effectors.size());
  }

  void Make() {
    FindTrunk();
    FindLimbs();
    for (std::size_t first = 0; first < limbs_.size(); first += LimbPacks::kWidth) {
      const std::size_t count = std::min<std::size_t>(LimbPacks::kWidth, limbs_.size() - first);
      AddPack({limbs_.data() + first, count});
    }
    AddTrunkHinges();
    AddBranches();
  }

 private:
  // Joints with more than one branch or more than one effector, and all before them.
  void FindTrunk() {
    const int joints = static_cast<int>(tree_.joints.size());
    std::vector<int> branches(tree_.joints.size());
    for (int n = 1; n < joints; ++n) ++branches[tree_.joints[n].parent];
    std::vector<bool> is_trunk(tree_.joints.size());
    is_trunk[0] = true;
    for (int n = joints - 1; n > 0; --n) {
      if (branches[n] > 1 || effectors_[n].size() > 1) is_trunk[n] = true;
      if (is_trunk[n]) is_trunk[tree_.joints[n].parent] = true;
    }
    trunk_.assign(tree_.joints.size(), -1);
    for (int n = 0; n < joints; ++n) {
      if (!is_trunk[n]) continue;
      const TreeJoint& joint = tree_.joints[n];
      trunk_[n] = static_cast<int>(made_.trunk.size());
      LimbPacks::TrunkJoint& made = made_.trunk.emplace_back();
      made.parent = n == 0 ? -1 : trunk_[joint.parent];
      made.hinge_count = joint.dof_count;
      for (int k = 0; k < 3; ++k) {
        made.p_PJ[k] = joint.p_PJ[k];
        for (int c = 0; c < 3; ++c) made.R_PJ[c][k] = joint.R_PJ[c][k];
      }
    }
    for (const int n : inwards_) {
      if (is_trunk[n]) made_.inwards.push_back(trunk_[n]);
    }
  }

  // An effector on the trunk is the end of a limb without joints.
  void FindLimbs() {
    for (std::size_t n = 0; n < tree_.joints.size(); ++n) {
      if (trunk_[n] < 0) continue;
      for (const int e : effectors_[n]) limbs_.push_back({static_cast<int>(n), {}, e});
    }
    std::vector<int> next(tree_.joints.size(), -1);
    for (const int n : inwards_) {
      if (trunk_[n] >= 0) continue;
      const int parent = tree_.joints[n].parent;
      if (trunk_[parent] < 0) {
        next[parent] = n;
        continue;
      }
      Limb& limb = limbs_.emplace_back(Limb{parent, {}, -1});
      for (int joint = n; joint >= 0; joint = next[joint]) limb.joints.push_back(joint);
      const std::vector<int>& ends = effectors_[limb.joints.back()];
      if (!ends.empty()) limb.effector = ends[0];
    }
    std::ranges::stable_sort(limbs_, [](const Limb& a, const Limb& b) { return a.joints.size() > b.joints.size(); });
  }

  void AddPack(std::span<const Limb> limbs) {
    LimbPacks::Pack& pack = made_.packs.emplace_back();
    const int number = static_cast<int>(made_.packs.size()) - 1;
    pack.levels.resize(std::max<std::size_t>(1, limbs[0].joints.size()));
    for (std::size_t lane = 0; lane < limbs.size(); ++lane) {
      pack.parents[lane] = trunk_[limbs[lane].parent];
      found_.push_back({&limbs[lane], {number, static_cast<int>(lane)}});
    }
    for (std::size_t l = 0; l < pack.levels.size(); ++l) {
      LimbPacks::Level& level = pack.levels[l];
      for (const Limb& limb : limbs) {
        if (l < limb.joints.size()) level.hinge_count = std::max(level.hinge_count, tree_.joints[limb.joints[l]].dof_count);
      }
      level.first_slot = made_.slot_count;
      made_.slot_count += level.hinge_count;
      for (int lane = 0; lane < LimbPacks::kWidth; ++lane) {
        for (int k = 0; k < 3; ++k) level.R_PJ[k][k][lane] = 1;
        if (lane >= static_cast<int>(limbs.size())) continue;
        const Limb& limb = limbs[lane];
        if (l < limb.joints.size()) SetJoint(limb.joints[l], lane, level);
        const bool is_last = l + 1 == pack.levels.size();
        if (is_last) {
          SetEnd(limb.effector, lane, level);
        } else if (l + 1 < limb.joints.size()) {
          for (const int e : effectors_[limb.joints[l]]) SetEnd(e, lane, level);
        }
      }
    }
  }

  void SetJoint(int n, int lane, LimbPacks::Level& level) {
    const TreeJoint& joint = tree_.joints[n];
    for (int k = 0; k < 3; ++k) {
      level.p_PJ[k][lane] = joint.p_PJ[k];
      for (int c = 0; c < 3; ++c) level.R_PJ[c][k][lane] = joint.R_PJ[c][k];
    }
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
    for (std::size_t n = 1; n < tree_.joints.size(); ++n) {
      if (trunk_[n] < 0) continue;
      LimbPacks::TrunkJoint& made = made_.trunk[trunk_[n]];
      made.first_hinge = made_.trunk_hinge_count;
      for (int h = 0; h < made.hinge_count; ++h) {
        made_.places[tree_.joints[n].first_dof + h] = LimbPacks::kWidth * made_.slot_count + made_.trunk_hinge_count++;
      }
    }
    const int places = LimbPacks::kWidth * made_.slot_count + made_.trunk_hinge_count;
    made_.place_count = (places + kMostLanes - 1) / kMostLanes * kMostLanes;
  }

  // First a joint's own effectors, then what is beyond it.
  void AddBranches() {
    for (const auto& [limb, branch] : found_) {
      if (limb->joints.empty()) made_.trunk[trunk_[limb->parent]].branches.push_back(branch);
    }
    for (const int n : inwards_) {
      const int parent = trunk_[tree_.joints[n].parent];
      if (parent < 0) continue;
      if (trunk_[n] >= 0) {
        made_.trunk[parent].branches.push_back({-1, trunk_[n]});
        continue;
      }
      for (const auto& [limb, branch] : found_) {
        if (!limb->joints.empty() && limb->joints[0] == n) made_.trunk[parent].branches.push_back(branch);
      }
    }
  }

  struct Found {
    const Limb* limb;
    LimbPacks::Branch branch;
  };

  const KinematicTree& tree_;
  LimbPacks& made_;
  std::vector<std::vector<int>> effectors_;  // of each joint
  std::vector<int> inwards_;
  std::vector<int> trunk_;  // of each joint: which one of the trunk it is, or −1
  std::vector<Limb> limbs_;
  std::vector<Found> found_;
};

}  // namespace

LimbPacks::LimbPacks(const KinematicTree& tree) { Maker(tree, *this).Make(); }

}  // namespace etude
