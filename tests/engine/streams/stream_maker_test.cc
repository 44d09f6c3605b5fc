#include "engine/streams/stream_maker.h"

#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "tests/engine/streams/small_files.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::KinectV1Text;
using testing::StandingPose;
using testing::WavingMotion;

StreamRecording Recorded(const BodyMotion& motion) {
  StreamRecording recording{.is_level = true, .rate_hz = motion.rate_hz};
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    RecordedFrame& frame = recording.frames.emplace_back();
    frame.time_s = static_cast<double>(t) / motion.rate_hz;
    for (std::size_t i = 0; i < kRoleCount; ++i) frame.places[i] = motion.poses[t].joints[i];
  }
  return recording;
}

SkeletonStream StreamOf(const StreamRecording& recording, const StreamOptions& options = {}) {
  const auto made = MakeStream(recording, "s", options);
  EXPECT_TRUE(made);
  return made ? made->stream : SkeletonStream{};
}

TEST(StreamMaker, OtherRatesBecomeThirtyFramesASecond) {
  for (const double rate : {15.0, 25.0, 60.0}) {
    const BodyMotion motion = WavingMotion(static_cast<int>(2 * rate) + 1, rate);
    const SkeletonStream stream = StreamOf(Recorded(motion));
    ASSERT_EQ(stream.frames.size(), 61u) << rate;
    for (std::size_t t = 0; t < 61; ++t) {
      const double y = 1.4 + 0.3 * std::sin(3.14159 * static_cast<double>(t) / 30);
      EXPECT_NEAR(stream.frames[t][Role::kLeftHand].position.y, y, 2e-3) << rate;  // linear between samples
    }
  }
}

TEST(StreamMaker, AShortGapIsBridgedAndALongOneLosesTheBody) {
  StreamRecording recording = Recorded(WavingMotion(30));
  auto& frames = recording.frames;
  frames.erase(frames.begin() + 20, frames.begin() + 28);
  frames.erase(frames.begin() + 5, frames.begin() + 8);
  const SkeletonStream stream = StreamOf(recording);
  ASSERT_EQ(stream.frames.size(), 30u);
  for (std::size_t t = 0; t < 30; ++t) EXPECT_EQ(stream.frames[t].body_seen, t < 20 || t >= 28) << t;
  EXPECT_EQ(stream.frames[22][Role::kHead].state, TrackingState::kNotTracked);
  EXPECT_EQ(stream.frames[22][Role::kHead].position, stream.frames[19][Role::kHead].position);
}

TEST(StreamMaker, AMissingJointStaysWhereItWasAndIsNotTracked) {
  StreamRecording recording = Recorded(WavingMotion(10));
  for (std::size_t t = 0; t < 10; ++t) {
    if (t < 2 || t > 4) recording.frames[t].places[Index(Role::kLeftHand)].reset();
  }
  const SkeletonStream stream = StreamOf(recording);
  EXPECT_EQ(stream.frames[0][Role::kLeftHand].position, stream.frames[0][Role::kLeftWrist].position);
  EXPECT_EQ(stream.frames[9][Role::kLeftHand].position, stream.frames[4][Role::kLeftHand].position);
  EXPECT_EQ(stream.frames[9][Role::kLeftHand].state, TrackingState::kNotTracked);
  EXPECT_EQ(stream.frames[9][Role::kLeftWrist].state, TrackingState::kTracked);
  EXPECT_TRUE(stream.frames[9].body_seen);
}

TEST(StreamMaker, ATiltedSensorIsLevelledByTheTrunkAndTheFloorByTheFeet) {
  for (const double tilt_deg : {-12.0, 0.0, 20.0}) {
    ASSERT_OK(recording, ReadStreamRecording(KinectV1Text(WavingMotion(), "", Radians(tilt_deg)), "s"));
    ASSERT_OK(made, MakeStream(*recording, "s"));
    EXPECT_NEAR(made->level.tilt_deg, std::abs(tilt_deg), 1e-6);
    EXPECT_EQ(made->level.up_by, StreamLevel::By::kTrunk);
    EXPECT_NEAR(made->stream.frames[0][Role::kHipCentre].position.y, 0.95, 1e-6);
    EXPECT_NEAR(made->stream.frames[0][Role::kHead].position.y, 1.65, 1e-6);
    EXPECT_GT(*LegsOf(made->stream).FeetForward(), 0.8);
  }
}

/// Returns the recording of a sensor that is turned by quarter turns about its line of sight.
StreamRecording TurnedAbout(StreamRecording recording, int quarters) {
  for (RecordedFrame& frame : recording.frames) {
    for (auto& place : frame.places) {
      for (int i = 0; place && i < quarters; ++i) *place = {-place->y, place->x, place->z};
    }
  }
  return recording;
}

StreamRecording WavingBeforeKinect(double tilt_deg = 0) {
  return ReadStreamRecording(KinectV1Text(WavingMotion(), "", Radians(tilt_deg)), "s").value();
}

TEST(StreamMaker, ASensorInPortraitOrUpsideDownIsTurnedBackAndThatIsSaid) {
  for (const double tilt_deg : {0.0, 12.0}) {
    const StreamRecording upright = WavingBeforeKinect(tilt_deg);
    const auto expected = MakeStream(upright, "s").value();
    EXPECT_EQ(Describe(expected.level).find("turned"), std::string::npos) << "the control";
    for (int quarters = 1; quarters < 4; ++quarters) {
      const auto made = MakeStream(TurnedAbout(upright, quarters), "s").value();
      EXPECT_EQ(made.level.turn_deg, 360 - 90 * quarters);
      EXPECT_EQ(Describe(made.level).find(fmt::format("the sensor was rotated by {} degrees", 360 - 90 * quarters)),
                0u);
      EXPECT_NEAR(made.level.tilt_deg, tilt_deg, 1e-6);
      for (const Role role : AllRoles()) {
        EXPECT_LT(glm::distance(made.stream.frames[20][role].position, expected.stream.frames[20][role].position), 1e-9)
            << quarters << " " << RoleName(role);
      }
      // With levels = false the file's own up is kept.
      const auto kept = MakeStream(TurnedAbout(upright, quarters), "s", {.levels = false}).value();
      EXPECT_EQ(kept.level.turn_deg, 0);
    }
  }
}

TEST(StreamMaker, WhoLiesOrFallsBeforeALevelSensorIsNotTurnedButSaidToBeFarFromUp) {
  // A person on the back, the head to the sensor's left or right.
  for (const double side : {-1.0, 1.0}) {
    StreamRecording lying = WavingBeforeKinect();
    for (RecordedFrame& frame : lying.frames) {
      for (auto& place : frame.places) *place = {side * place->y, place->z + 3, side * place->x - 3};
    }
    const StreamLevel level = EstimateLevel(lying.frames, 30);
    EXPECT_EQ(level.turn_deg, 0);
    EXPECT_EQ(level.R_WF, glm::dmat3(1));
    EXPECT_NEAR(level.trunk_deg, 90, 1e-6);
    EXPECT_EQ(Describe(level).find(
                  "the up direction is as in the file (although trunks are 90 degrees from this direction: "),
              0u);
  }
  // A person who stood before, and now lies on a side.
  StreamRecording falling = WavingBeforeKinect();
  const StreamRecording down = TurnedAbout(falling, 1);
  for (std::size_t t = 10; t < falling.frames.size(); ++t) falling.frames[t].places = down.frames[t].places;
  EXPECT_EQ(EstimateLevel(falling.frames, 30).turn_deg, 0);
}

TEST(StreamMaker, FeetThatStoodInSeveralPlacesTellTheFloorBetterThanALeaningTrunk) {
  BodyMotion motion;
  for (int place = 0; place < 4; ++place) {
    for (int t = 0; t < 30; ++t) {
      BodyPose pose = StandingPose();
      for (auto& joint : pose.joints) {
        joint.z += 0.1 * joint.y;  // leans
        joint += glm::dvec3(0.6 * (place % 2), 0, 0.6 * (place / 2));
      }
      motion.poses.push_back(pose);
    }
  }
  ASSERT_OK(recording, ReadStreamRecording(KinectV1Text(motion, "", Radians(8)), "s"));
  const StreamLevel level = EstimateLevel(recording->frames, 30);
  EXPECT_EQ(level.up_by, StreamLevel::By::kFeet);
  EXPECT_NEAR(level.tilt_deg, 8, 1e-6);
}

TEST(StreamMaker, SquatsAndBowsAreNoTiltOfTheSensor) {
  for (const double tilt_deg : {0.0, 10.0}) {
    for (const double duty : {0.0, 0.4, 0.7, 1.0}) {
      BodyMotion motion;
      for (int t = 0; t < 180; ++t) {
        // In each period of 3 s, the body leans by up to 35° and comes down, during the share `duty`.
        const double phase = (t % 90) / 90.0;
        const double depth = phase < duty ? 0.5 - 0.5 * std::cos(2 * kPi * phase / duty) : 0;
        BodyPose pose = StandingPose();
        for (glm::dvec3& joint : pose.joints) {
          const double above = std::max(0.0, joint.y - 0.6), lean = Radians(35) * depth;
          if (joint.y <= 0.6) continue;
          joint = {joint.x, 0.6 - 0.3 * depth + std::cos(lean) * above, std::sin(lean) * above};
        }
        motion.poses.push_back(pose);
      }
      ASSERT_OK(recording, ReadStreamRecording(KinectV1Text(motion, "", Radians(tilt_deg)), "s"));
      const StreamLevel level = EstimateLevel(recording->frames, 30);
      EXPECT_NEAR(level.tilt_deg, tilt_deg, duty < 1 ? 1e-6 : 3) << duty;
      EXPECT_NEAR(level.floor_m, -1, duty < 1 ? 1e-6 : 0.15) << duty;
    }
  }
}

TEST(StreamMaker, AMirroredRecordingIsNoticedByItsFeetAndMendedByReflection) {
  StreamRecording recording = Recorded(WavingMotion());
  for (RecordedFrame& frame : recording.frames) {
    for (auto& place : frame.places) place->x = -place->x;
  }
  EXPECT_LT(*LegsOf(StreamOf(recording)).FeetForward(), -0.8);
  const SkeletonStream mended = StreamOf(recording, {.reflects = true});
  EXPECT_GT(*LegsOf(mended).FeetForward(), 0.8);
  EXPECT_NEAR(mended.frames[15][Role::kLeftHand].position.y, 1.7, 1e-3);
}

TEST(StreamMaker, AClockThatStopsForLongIsRefused) {
  StreamRecording recording = Recorded(WavingMotion(3));
  recording.frames[2].time_s = 1e6;
  recording.frames[2].line = 3;
  EXPECT_EQ(testing::Refusal(MakeStream(recording, "s")).find("s:3: the time 1e+06 s follows"), 0u);
}

}  // namespace
}  // namespace etude
