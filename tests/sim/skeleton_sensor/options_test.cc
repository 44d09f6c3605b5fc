#include "sim/skeleton_sensor/options.h"

#include <gtest/gtest.h>

#include "tests/support/results.h"

namespace etude {
namespace {

TEST(SensorFile, IsWrittenTheSameAfterItWasRead) {
  for (const char* preset : {"v1", "v2"}) {
    const std::string text = WriteSensorFile(*FindSensorPreset(preset), preset);
    ASSERT_OK(read, ReadSensorFile(text, "s.yaml"));
    EXPECT_EQ(WriteSensorFile(*read, preset), text);
  }
  EXPECT_NE(WriteSensorFile(SensorV1(), "v1"), WriteSensorFile(SensorV2(), "v1"));
}

TEST(SensorFile, ChangesWhatItSaysAndKeepsThePresetElsewhere) {
  ASSERT_OK(read,
            ReadSensorFile("based_on: v1\nfast_share: 0.5\ngroups: {knees: {size_m: 0.1}}\ncorrelation: {shank: 0.3}\n",
                           "s.yaml"));
  SkeletonSensorOptions expected = SensorV1();
  expected.fast_share = 0.5;
  expected[JointGroup::kKnees].size = 0.1;
  expected.correlation[Index(BoneKind::kShank)] = 0.3;
  EXPECT_EQ(WriteSensorFile(*read, "v1"), WriteSensorFile(expected, "v1"));
}

TEST(SensorFile, RefusesWhatItDoesNotKnowAtItsPlace) {
  const auto complaint = [](const char* text) {
    const auto read = ReadSensorFile(text, "s.yaml");
    return read ? std::string("(read)") : ToString(read.error());
  };
  EXPECT_TRUE(complaint("fast_shore: 0.5\n").starts_with("s.yaml:1:1: ")) << complaint("fast_shore: 0.5\n");
  EXPECT_NE(complaint("fast_shore: 0.5\n").find("fast_share"), std::string::npos);
  EXPECT_TRUE(complaint("groups:\n  knees: {size: 1}\n").starts_with("s.yaml:2:"));
  EXPECT_TRUE(complaint("groups:\n  knee: {}\n").starts_with("s.yaml:2:"));
  EXPECT_TRUE(complaint("correlation: {shank: 1.5}\n").starts_with("s.yaml:1:"));
  EXPECT_TRUE(complaint("based_on: v3\n").starts_with("s.yaml:1:"));
  EXPECT_NE(complaint("shortest_episode: 50\n").find("longest_episode"), std::string::npos);
  EXPECT_EQ(complaint("fast_share: 0.5\n"), "(read)");  // the control
}

}  // namespace

}  // namespace etude
