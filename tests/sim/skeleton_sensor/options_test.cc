#include "sim/skeleton_sensor/options.h"

#include <gtest/gtest.h>

#include "tests/support/kept_answers.h"
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
  EXPECT_TRUE(testing::AnswersAreKept("tests/sim/skeleton_sensor/complaints.txt", [](const std::string& text) {
    return testing::Refusal(ReadSensorFile(text, "s.yaml"));
  }));
}

}  // namespace

}  // namespace etude
