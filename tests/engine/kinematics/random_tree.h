#pragma once

#include "engine/base/euler.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {

/// Returns a random tree of `joints` joints with random branches, offsets and rest frames, 0 to 3 degrees of freedom
/// per joint, and four effectors, one of them near the root.
inline KinematicTree RandomTree(int trial, int joints) {
  RandomStream random({.suite_seed = 7, .scenario = "kinematics-test", .trial = trial}, "tree");
  const auto turn = [&] {
    return RotationXyz({random.Uniform(-kPi, kPi), random.Uniform(-1.5, 1.5), random.Uniform(-kPi, kPi)});
  };
  const auto below = [&](int count) { return static_cast<int>(random.IndexBelow(static_cast<std::uint64_t>(count))); };
  KinematicTree tree{.standing_root = turn()};
  tree.joints.push_back({.name = "root"});
  for (int i = 1; i < joints; ++i) {
    const int dofs = below(4);
    tree.joints.push_back({.name = "joint",
                           .parent = below(i),
                           .p_PJ = random.Normal3(),
                           .R_PJ = turn(),
                           .first_dof = tree.dof_count(),
                           .dof_count = dofs});
    tree.limits.insert(tree.limits.end(), static_cast<std::size_t>(dofs), AngleRange{-kPi, kPi});
  }
  for (const int joint : {joints - 1, joints / 2, below(joints), 1}) {
    tree.effectors.push_back({"tip", joint, random.Normal3()});
  }
  return tree;
}

}  // namespace etude
