#include "bench/tasks/base/pose_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/results.h"

namespace etude {
namespace {

BodyPose Numbered() {
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const double x = static_cast<double>(i) / 7;
    pose.joints[i] = {x, x + 1, -x};
  }
  return pose;
}

TEST(PoseJson, KeepsEveryBitThroughText) {
  const BodyPose pose = Numbered();
  ASSERT_OK(back, ReadPose(*ReadJson(*WriteJson(EncodePose(pose)), "pose"), "pose"));
  EXPECT_EQ(back->joints, pose.joints);
}

TEST(PoseJson, WritesJointByJointInTheOrderThatTheBodyIsDescribedIn) {
  BodyPose pose;
  pose[Role::kLeftHand] = {1, 2, 3};
  const Json numbers = EncodePose(pose), body = DescribeBody();
  ASSERT_EQ(numbers.size(), 60u);
  ASSERT_EQ(body["joints"].size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(numbers[3 * i + 1], body["joints"][i] == "left_hand" ? 2 : 0);
    const bool is_root = body["parents"][i].is_null();
    EXPECT_EQ(is_root, i == 0);
    EXPECT_TRUE(is_root || FindRole(body["parents"][i].get<std::string>()));
  }
}

TEST(PoseJson, RefusesWhatIsNoPoseNamingThePlace) {
  Json numbers = EncodePose(Numbered());
  EXPECT_EQ(ReadPose(Json("p"), "between[3]").error().message, "between[3]: \"p\" is not a list of 60 numbers");
  numbers[8] = false;
  EXPECT_EQ(ReadPose(numbers, "between[3]").error().message, "between[3][8]: false is not a finite number");
  numbers[8] = -1000.5;
  EXPECT_EQ(ReadPose(numbers, "between[3]").error().message, "between[3][8]: -1000.5; allowed: -1000…1000");
  numbers.erase(8);
  EXPECT_EQ(ReadPose(numbers, "between[3]").error().message, "between[3]: 59 numbers, not 60");
}

}  // namespace
}  // namespace etude
