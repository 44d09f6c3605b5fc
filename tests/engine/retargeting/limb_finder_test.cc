#include "engine/retargeting/limb_finder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

/// Returns two arms of two joints on a root; `tip` is the rest transform of the first arm's tip.
Skeleton TwoArms(const LocalTransform& tip = {}) {
  Skeleton skeleton;
  for (const auto& [name, parent] : {std::pair{"root", -1}, {"a", 0}, {"a tip", 1}, {"b", 0}, {"b tip", 3}}) {
    skeleton.joints.push_back({.name = name, .parent = parent, .rest = {.translation = {0, 1, 0}}});
  }
  skeleton.joints[2].rest = tip;
  return skeleton;
}

TEST(SkeletonTree, KnowsWhoHangsFromWhom) {
  const Skeleton skeleton = TwoArms();
  const SkeletonTree tree(skeleton);
  EXPECT_TRUE(tree.DescendsFrom(2, 0));
  EXPECT_TRUE(tree.DescendsFrom(4, 3));
  EXPECT_FALSE(tree.DescendsFrom(2, 2)) << "not from itself";
  EXPECT_FALSE(tree.DescendsFrom(4, 1)) << "not from the other arm, though that stands before it";
  EXPECT_FALSE(tree.DescendsFrom(0, 4));
  EXPECT_EQ(tree.CommonAncestor(2, 4), 0);
  EXPECT_EQ(tree.CommonAncestor(2, 1), 1);
}

TEST(SkeletonTree, GivesPointsInTheFrameOfAJoint) {
  // The tip is at (1, 2, 0) + (2, 0, 0), turned by 90° about Z, and scaled by 2 along its own X.
  const LocalTransform tip{.translation = {2, 0, 0},
                           .rotation = glm::angleAxis(0.5 * 3.14159265358979, glm::dvec3(0, 0, 1)),
                           .scale = {2, 1, 1}};
  const Skeleton skeleton = TwoArms(tip);
  const glm::dvec3 inside = SkeletonTree(skeleton).InFrameOf(2, {2, 6, 7});
  EXPECT_LT(glm::distance(inside, {2, 0, 7}), 1e-12);
}

TEST(SkeletonTree, GivesNoPointThatOverflowsAlongAnyAxis) {
  for (int axis = 0; axis < 3; ++axis) {
    LocalTransform tip;
    tip.scale[axis] = 1e-305;
    const Skeleton skeleton = TwoArms(tip);
    glm::dvec3 point(1, 2 + 1, 1);
    EXPECT_TRUE(std::isfinite(glm::length(glm::dvec3(1e-305) * SkeletonTree(skeleton).InFrameOf(2, point))));
    EXPECT_NE(SkeletonTree(skeleton).InFrameOf(2, point), glm::dvec3(0)) << "large is not too large";
    point[axis] = 1e4;
    EXPECT_EQ(SkeletonTree(skeleton).InFrameOf(2, point), glm::dvec3(0)) << axis;
  }
}

}  // namespace
}  // namespace etude
