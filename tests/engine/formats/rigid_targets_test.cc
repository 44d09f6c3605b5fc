#include "engine/formats/rigid_targets.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns a row with target i at (i, 2, 3) × `unit`, turned by `w`.
std::string TargetRow(double unit, double w = 1) {
  std::ostringstream row;
  for (int i = 0; i < 17; ++i) {
    row << (i > 0 ? " " : "") << unit * i << ' ' << unit * 2 << ' ' << unit * 3 << " 0 0 0 " << w;
  }
  return row.str();
}

TEST(RigidTargets, ReadsMillimetresAndMetres) {
  for (const double unit : {1000.0, 1.0}) {
    ASSERT_OK(read, ReadRigidTargets(TargetRow(unit) + "\n" + TargetRow(unit), "v.txt"));
    ASSERT_EQ(read->size(), 2u);
    const auto& head = (*read)[1][static_cast<std::size_t>(BodyTarget::kHead)];
    ASSERT_TRUE(head);
    EXPECT_NEAR(glm::distance(head->position, glm::dvec3(14, 2, 3)), 0, 1e-9);
    EXPECT_EQ(head->rotation, glm::dquat(1, 0, 0, 0));
  }
}

TEST(RigidTargets, TakesQuaternionsOfLengthZeroForUnseenTargetsAndRefusesOddOnes) {
  ASSERT_OK(unseen, ReadRigidTargets(TargetRow(1, 0), "v.txt"));
  EXPECT_FALSE((*unseen)[0][3]);
  EXPECT_EQ(testing::Refusal(ReadRigidTargets(TargetRow(1) + "\n" + TargetRow(1, 2), "v.txt")),
            "v.txt:2: target 0: the quaternion has length 2; allowed: 1");
  EXPECT_FALSE(ReadRigidTargets("1 2 3\n", "v.txt"));
}

}  // namespace
}  // namespace etude
