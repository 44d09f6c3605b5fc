#include "tools/sensor_fit/fit.h"

#include <gmock/gmock.h>

#include <cmath>

#include "sim/skeleton_sensor/options.h"
#include "tests/support/results.h"
#include "tests/tools/sensor_fit/small_recording.h"
#include "tools/sensor_fit/statistics.h"

// Recovers a sensor's options from recordings simulated with a sensor that the fit does not know.

namespace etude {
namespace {

SkeletonSensorOptions Unknown() {
  SkeletonSensorOptions sensor = SensorV2();
  sensor[JointGroup::kTorso].size = 0.015;
  sensor[JointGroup::kElbows].size = 0.06;
  sensor[JointGroup::kKnees].size = 0.05;
  sensor[JointGroup::kKnees].depth_ratio = 2.2;
  sensor.correlation.fill(0.2);
  sensor.correlation[Index(BoneKind::kForearm)] = -0.3;
  return sensor;
}

/// Returns one recording of a dance by that sensor.
std::optional<RealRecording> RecordedBySensor(const SkeletonSensorOptions& sensor, const TwinMotion& twin) {
  // The person faces the sensor, in the Kinect's axes with Z away from the sensor.
  MadeUp made{.rotation = glm::angleAxis(3.14159265358979, glm::dvec3(0, 1, 0)), .translation = {0, -1, 2.9}};
  auto perfect = MakeRealRecording(PerfectRecording(twin, 7, made), twin);
  if (!perfect) return std::nullopt;
  const JointRecording sensed = Simulate(*perfect, sensor, {.suite_seed = 5, .scenario = "unknown-sensor", .trial = 0});
  return MakeRealRecording(sensed, twin);
}

constexpr WorldKey kOtherDice{.suite_seed = 9, .scenario = "held-out", .trial = 0};

TEST(FitSensor, GivesASensorWhoseRecordingsHaveTheRealOnesStatistics) {
  ASSERT_OK(real, RecordedBySensor(Unknown(), DancingTwin(9)));
  const SensorFitOptions options{.start = SensorV2(), .worlds = 10, .steps = 6, .progress = {}};
  const SkeletonSensorOptions fitted = FitSensor(*real, options).sensor;
  const SensorStatistics measured = StatisticsOf(*real);
  const auto agreement = [&](const SkeletonSensorOptions& sensor) {
    return AgreementOf(measured, SimulatedStatistics(*real, sensor, 12, kOtherDice).mean);
  };
  const Agreement after = agreement(fitted), before = agreement(options.start);
  EXPECT_EQ(after.compared, before.compared);
  EXPECT_GE(after.within, after.compared * 8 / 10);
  EXPECT_LE(before.within, after.within - 5);  // the control: without the fit fewer values are within the bands
}

TEST(Simulate, TheTimesOfAnUnevenClockAreAsLateAsTheSkeletons) {
  const TwinMotion twin = DancingTwin(9);
  const MadeUp made{.rotation = glm::angleAxis(3.14159265358979, glm::dvec3(0, 1, 0)), .translation = {0, -1, 2.9}};
  JointRecording recording = PerfectRecording(twin, 7, made);
  for (std::size_t t = 0; t < recording.frames.size(); ++t) {
    recording.late_s.push_back(0.005 * std::sin(2.2 * static_cast<double>(t)));
  }
  ASSERT_OK(real, MakeRealRecording(recording, twin));
  const SkeletonSensorOptions sensor = SensorV2();
  const auto lag = static_cast<std::size_t>(sensor.Lag());
  ASSERT_GT(lag, 0u);
  const JointRecording simulated = Simulate(*real, sensor, kOtherDice);
  ASSERT_EQ(simulated.late_s.size(), simulated.frames.size());
  for (std::size_t t = lag; t < simulated.frames.size(); ++t) {
    EXPECT_EQ(simulated.late_s[t], recording.late_s[t - lag]) << t;
  }
}

TEST(DescribeMismatch, OfAnotherUnitAMirrorImageOrAnotherMotionIsToldAndOfATrueReferenceNot) {
  ASSERT_OK(real, RecordedBySensor(SensorV2(), DancingTwin(9)));
  EXPECT_EQ(DescribeMismatch(*real), "");
  RealRecording changed = *real;
  for (RolePositions& frame : changed.recording.frames) {
    for (auto& place : frame) {
      if (place) place->x = -place->x;
    }
  }
  ASSERT_OK(mirrored, MakeRealRecording(changed.recording, real->twin));
  EXPECT_NE(DescribeMismatch(*mirrored).find("one of the two files is a mirror image"), std::string::npos);
  ASSERT_OK(another, MakeRealRecording(real->recording, DancingTwin(9, 1, {"sway", "stretch", "robot"})));
  EXPECT_NE(DescribeMismatch(*another).find("hardly less than at other shifts in time"), std::string::npos)
      << DescribeMismatch(*another);
  ASSERT_OK(slower, MakeRealRecording(real->recording, DancingTwin(9, 0.8)));
  EXPECT_NE(DescribeMismatch(*slower).find("the frame rate of one file may be wrong"), std::string::npos)
      << DescribeMismatch(*slower);
  EXPECT_NE(DescribeMismatch(*slower).find("the reference's clock is 2"), std::string::npos)
      << DescribeMismatch(*slower);
  for (auto& frame : changed.twin.frames) {
    for (auto& carrier : frame) {
      if (carrier) carrier->position *= 1000.0;
    }
  }
  ASSERT_OK(large, MakeRealRecording(real->recording, changed.twin));
  EXPECT_NE(DescribeMismatch(*large).find("times as large as in the recording; the unit of one file may be wrong"),
            std::string::npos);
}

TEST(FitSensor, IsTheSameEveryTime) {
  ASSERT_OK(real, RecordedBySensor(Unknown(), DancingTwin(9)));
  const SensorFitOptions options{.start = SensorV2(), .worlds = 3, .steps = 2, .progress = {}};
  EXPECT_EQ(WriteSensorFile(FitSensor(*real, options).sensor, "v2"),
            WriteSensorFile(FitSensor(*real, options).sensor, "v2"));
}

TEST(FitSensor, KeepsWhatTheRecordingDoesNotShow) {
  auto real = RecordedBySensor(Unknown(), DancingTwin(9));
  ASSERT_TRUE(real);
  for (RolePositions& places : real->recording.frames) {
    places[Index(Role::kLeftKnee)].reset();
    places[Index(Role::kRightKnee)].reset();
  }
  auto kneeless = MakeRealRecording(real->recording, real->twin);
  ASSERT_TRUE(kneeless);
  const SkeletonSensorOptions fitted =
      FitSensor(*kneeless, {.start = SensorV2(), .worlds = 3, .steps = 2, .progress = {}}).sensor;
  EXPECT_EQ(fitted[JointGroup::kKnees].size, SensorV2()[JointGroup::kKnees].size);
  EXPECT_EQ(fitted.correlation[Index(BoneKind::kShank)], SensorV2().correlation[Index(BoneKind::kShank)]);
  EXPECT_NE(fitted[JointGroup::kTorso].size, SensorV2()[JointGroup::kTorso].size);
}

TEST(FitSensor, NamesTheSettingsThatItsLimitsHold) {
  SkeletonSensorOptions wild = SensorV2();
  wild[JointGroup::kHands].size = 0.9;  // the fit allows at most 0.5 m
  ASSERT_OK(real, RecordedBySensor(wild, DancingTwin(9)));
  const FittedSensor fitted = FitSensor(*real, {.start = SensorV2(), .worlds = 3, .steps = 4, .progress = {}});
  EXPECT_THAT(fitted.at_bounds, testing::Contains("groups.hands.size_m 0.5"));
  EXPECT_EQ(fitted.sensor[JointGroup::kHands].size, 0.5);
  ASSERT_OK(usual, RecordedBySensor(Unknown(), DancingTwin(9)));
  EXPECT_THAT(FitSensor(*usual, {.start = SensorV2(), .worlds = 3, .steps = 4, .progress = {}}).at_bounds,
              testing::Not(testing::Contains(testing::HasSubstr("size_m"))));
}

TEST(Simulate, AtStrengthZeroSaysTheTwinItself) {
  ASSERT_OK(real, RecordedBySensor(Unknown(), DancingTwin(9, 0.2, {"clap"})));
  SkeletonSensorOptions perfect = SensorV2();
  perfect.strength = 0;
  const SensorStatistics statistics = SimulatedStatistics(*real, perfect, 1, kOtherDice).mean;
  for (const auto& error : statistics.error_mm) EXPECT_LT(*error, 2);
}

}  // namespace
}  // namespace etude
