#include "engine/streams/stream_doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/streams/live_stream.h"
#include "tests/engine/streams/small_files.h"
#include "tests/support/results.h"

namespace etude::stream_doubts {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// Returns the motion in a file with Z up: the inverse of the turn (x, y, z) → (x, z, −y).
BodyMotion WithZUp(BodyMotion motion) {
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint = {joint.x, -joint.z, joint.y};
  }
  return motion;
}

BodyMotion WithYDown(BodyMotion motion) {
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint = {joint.x, -joint.y, -joint.z};
  }
  return motion;
}

StreamDoubts DoubtsOfFile(const std::string& text, const StreamOptions& options = {}) {
  const auto recording = ReadStreamRecording(text, "s").value();
  return DoubtsOf(MakeStream(recording, "s", options).value().stream, StatedUp(recording, options));
}

/// The frames of a live stream, and each remark with the number of lines that were read before.
struct Heard {
  std::vector<SensedFrame> frames;
  std::vector<std::pair<int, std::string>> remarks;
};

Heard Listen(const std::string& text, const StreamOptions& options = {}) {
  LiveStream live("-", {}, options);
  Heard heard;
  std::istringstream lines(text);
  int number = 0;
  const auto take_remarks = [&] {
    for (std::string& remark : live.TakeRemarks()) heard.remarks.emplace_back(number, std::move(remark));
  };
  for (std::string line; std::getline(lines, line); take_remarks()) {
    ++number;
    EXPECT_TRUE(live.Take(line, heard.frames));
  }
  EXPECT_TRUE(live.Finish(heard.frames));
  take_remarks();
  return heard;
}

constexpr const char* kAlongZ = "the body stands along Z, but Y is the convention of joint CSV; --up sets another axis";

TEST(StreamDoubts, ABodyAlongAnotherAxisThanTheFormatsIsDoubted) {
  const BodyMotion wave = testing::WavingMotion(90);
  EXPECT_THAT(DoubtsOfFile(WriteJointCsv(wave)), ElementsAre("", "", "", ""));
  EXPECT_THAT(DoubtsOfFile(WriteJointCsv(WithZUp(wave))), ElementsAre(kAlongZ, "", "", ""));
  EXPECT_THAT(DoubtsOfFile(WriteJointCsv(WithYDown(wave)))[0], StartsWith("the body stands along −Y, but Y is"));
  EXPECT_THAT(DoubtsOfFile(WriteTrc(JointMarkers(WithZUp(wave), 0), "s"))[0],
              "the body stands along Z, but Y is the convention of Etude's own joints; --up sets another axis");
  // The axis that the user states is not judged.
  EXPECT_THAT(DoubtsOfFile(WriteJointCsv(WithZUp(wave)), {.up = UpAxis::kY}), ElementsAre("", "", "", ""));
}

TEST(StreamDoubts, ABodyThatIsNotAsTallAsAPersonIsDoubted) {
  BodyMotion inches = testing::WavingMotion(90);
  for (BodyPose& pose : inches.poses) {
    for (glm::dvec3& joint : pose.joints) joint /= 0.0254;
  }
  const std::string doubt = DoubtsOfFile(WriteJointCsv(inches))[3];
  EXPECT_THAT(doubt, AllOf(StartsWith("the body is 6"), HasSubstr(" m tall, which is not a person's height")));
  EXPECT_THAT(Listen(WriteJointCsv(inches)).remarks, ::testing::Contains(std::pair(31, doubt)));
}

TEST(StreamDoubts, TheStatedAxisBecomesYInFilesAndLive) {
  const BodyMotion wave = testing::WavingMotion(90);
  const std::string z_up = WriteJointCsv(WithZUp(wave));
  ASSERT_OK(recording, ReadStreamRecording(z_up, "s"));
  const auto made = MakeStream(*recording, "s", {.up = UpAxis::kZ}).value();
  const Heard heard = Listen(z_up, {.up = UpAxis::kZ});
  EXPECT_TRUE(heard.remarks.empty());
  ASSERT_EQ(made.stream.frames.size(), 90u);
  ASSERT_EQ(heard.frames.size(), 90u);
  for (std::size_t t = 0; t < 90; ++t) {
    for (const Role role : AllRoles()) {
      EXPECT_EQ(made.stream.frames[t][role].position, wave.poses[t][role]);
      EXPECT_EQ(heard.frames[t][role].position, wave.poses[t][role]);
    }
  }
  // The formats of sensors do not state the axis.
  LiveStream live("-", {}, {.up = UpAxis::kZ});
  std::vector<SensedFrame> frames;
  std::istringstream lines(testing::KinectV1Text(wave));
  Result<void> taken;
  for (std::string line; taken && std::getline(lines, line);) taken = live.Take(line, frames);
  ASSERT_FALSE(taken);
  EXPECT_THAT(taken.error().message, StartsWith("--up is allowed only for clips and for recordings in CSV or TRC"));
}

TEST(StreamDoubts, ALiveStreamIsDoubtedOnceAfterItsFirstSecond) {
  const BodyMotion wave = testing::WavingMotion(150);
  EXPECT_TRUE(Listen(WriteJointCsv(wave)).remarks.empty());
  // The heading is a line, too.
  EXPECT_THAT(Listen(WriteJointCsv(WithZUp(wave))).remarks, ElementsAre(std::pair(31, std::string(kAlongZ))));
  EXPECT_THAT(Listen(WriteJointCsv(WithZUp(testing::WavingMotion(20)))).remarks,
              ElementsAre(std::pair(21, std::string(kAlongZ))))
      << "at its end";
}

TEST(StreamDoubts, KneelersAreMirroredOnlyIfTheyAre) {
  BodyMotion kneeling = testing::WavingMotion(90);
  for (BodyPose& pose : kneeling.poses) {
    for (const auto& [knee, ankle, toe] : {std::array{Role::kLeftKnee, Role::kLeftAnkle, Role::kLeftFoot},
                                           std::array{Role::kRightKnee, Role::kRightAnkle, Role::kRightFoot}}) {
      pose[ankle] = pose[knee] - glm::dvec3(0, 0, 0.4);
      pose[toe] = pose[ankle] - glm::dvec3(0, 0.02, 0.15);
    }
  }
  EXPECT_EQ(DoubtsOfFile(WriteJointCsv(kneeling))[2], "");
  EXPECT_EQ(DoubtsOfFile(WriteJointCsv(kneeling), {.reflects = true})[2],
            "the knees bend backwards, so the stream may be mirrored (--reflect)");
}

TEST(StreamDoubts, AMirroredSensorsRateAndTiltAreSaidLive) {
  BodyMotion mirrored = testing::WavingMotion(150);
  for (BodyPose& pose : mirrored.poses) {
    for (glm::dvec3& joint : pose.joints) joint.x = -joint.x;
  }
  const std::string text = testing::KinectV1Text(mirrored, "", 0.1);  // 0.1 rad are 5.7°
  EXPECT_THAT(DoubtsOfFile(text)[2], StartsWith("the feet point backwards"));
  const std::string feet = "the feet point backwards, so the stream may be mirrored (--reflect)";
  EXPECT_THAT(
      Listen(text).remarks,
      ElementsAre(
          std::pair(30, std::string("without a clock (Etude assumes 30 Hz)")),
          std::pair(30, std::string("the up direction is found by the trunk (5.7 degrees); the floor is 1.00 m below "
                                    "the sensor")),
          std::pair(30, feet)));
  EXPECT_EQ(Listen(text, {.reflects = true}).remarks.size(), 2u);
  EXPECT_THAT(Listen(WriteJointCsv(mirrored)).remarks, ElementsAre(std::pair(31, feet)));
}

}  // namespace
}  // namespace etude::stream_doubts
