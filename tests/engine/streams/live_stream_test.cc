#include "engine/streams/live_stream.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "engine/formats/joint_csv.h"
#include "tests/engine/streams/small_files.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::AzureText;
using ::testing::HasSubstr;
using testing::KinectV1Text;
using testing::WavingMotion;
using testing::WithClock;

/// The frames after each line, and the error message that ended the stream.
struct Heard {
  std::vector<SensedFrame> frames;
  std::vector<std::size_t> known;  ///< number of frames after each line
  std::string complaint;
};

Heard Listen(const std::string& text, const StreamOptions& options = {}) {
  LiveStream live("-", {}, options);
  Heard heard;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = text.find('\n', at);
    const auto taken = live.Take(text.substr(at, end - at), heard.frames);
    heard.known.push_back(heard.frames.size());
    if (!taken) heard.complaint = ToString(taken.error());
    if (!taken || end == std::string::npos) break;
    at = end + 1;
  }
  if (!heard.complaint.empty()) return heard;
  if (const auto done = live.Finish(heard.frames); !done) heard.complaint = ToString(done.error());
  return heard;
}

/// The live stream must give the recorded file's frames bit for bit.
void ExpectAsRecorded(const std::string& text) {
  const Heard heard = Listen(text);
  EXPECT_EQ(heard.complaint, "");
  ASSERT_OK(recording, ReadStreamRecording(text, "s"));
  ASSERT_OK(made, MakeStream(*recording, "s"));
  ASSERT_EQ(heard.frames.size(), made->stream.frames.size());
  for (std::size_t t = 0; t < heard.frames.size(); ++t) {
    for (const Role role : AllRoles()) {
      EXPECT_EQ(heard.frames[t][role].position, made->stream.frames[t][role].position);
      EXPECT_EQ(heard.frames[t][role].state, made->stream.frames[t][role].state);
    }
  }
}

TEST(LiveStream, HearsWhatARecordingSays) {
  ExpectAsRecorded(WriteJointCsv(WavingMotion(90)));
  ExpectAsRecorded(WriteJointCsv(WavingMotion(90, 15)));
  // A Kinect's vertical is estimated from the trunk, which is still here, so every part of the file gives the same
  // vertical.
  ExpectAsRecorded(KinectV1Text(WavingMotion(90), "2"));
  ExpectAsRecorded(WithClock(KinectV1Text(WavingMotion(90), "1", 0.1), 44155936, 1e6 / 30));
}

TEST(LiveStream, OfEqualTimesTheFirstCountsAsInARecording) {
  std::vector<std::string> lines;
  std::istringstream text(WriteJointCsv(WavingMotion(90)));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  // Repeat the time of row 20 with the joints of row 40.
  const auto after_time = [](const std::string& line) { return line.find(',', line.find(',') + 1); };
  lines.insert(lines.begin() + 21,
               lines[20].substr(0, after_time(lines[20])) + lines[40].substr(after_time(lines[40])));
  std::string twice;
  for (const std::string& line : lines) twice += line + "\n";
  ExpectAsRecorded(twice);
  ASSERT_OK(recording, ReadStreamRecording(twice, "s"));
  EXPECT_EQ(recording->frames.size(), 90u);
  EXPECT_THAT(recording->remarks,
              ::testing::Contains("1 frames have the same time as another frame; Etude uses the first frame of each "
                                  "time"));
}

// A sender at 60 Hz repeats the frames of a sensor at 30 Hz.
TEST(LiveStream, RepeatedFramesDoNotHideTheClock) {
  const std::string once = WriteJointCsv(WavingMotion(90));
  std::string twice;
  std::istringstream text(once);
  for (std::string line; std::getline(text, line);) twice += line + "\n" + (twice.empty() ? "" : line + "\n");
  const Heard heard = Listen(twice);
  EXPECT_EQ(heard.complaint, "");
  EXPECT_EQ(heard.frames.size(), Listen(once).frames.size());
  // So it is if the clock counts milliseconds, live and in a file.
  std::string counted;
  std::istringstream rows(twice);
  for (std::string line; std::getline(rows, line);) {
    const std::size_t time = line.find(',') + 1, end = line.find(',', time);
    if (!counted.empty()) {
      line = line.substr(0, time) + std::to_string(std::lround(1000 * std::stod(line.substr(time)))) + line.substr(end);
    }
    counted += line + "\n";
  }
  EXPECT_EQ(Listen(counted).frames.size(), heard.frames.size());
  ASSERT_OK(recording, ReadStreamRecording(counted, "s"));
  EXPECT_NEAR(recording->frames.back().time_s - recording->frames.front().time_s, 89 / 30.0, 0.03) << "1 %";
}

// Millimetres under the headings of metres are refused, as in a file.
TEST(LiveStream, AStreamInAnotherUnitIsRefused) {
  BodyMotion motion = WavingMotion(90);
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint *= 1000;
  }
  EXPECT_THAT(Listen(WriteJointCsv(motion)).complaint, HasSubstr("m away from the origin; allowed: at most 100 m"));
  // The first row is too far away; its line is named, although more lines were read before the start.
  motion = WavingMotion(90);
  for (glm::dvec3& joint : motion.poses[0].joints) joint.x += 500;
  LiveStream live("-", {}, {});
  std::vector<SensedFrame> frames;
  std::istringstream text(WriteJointCsv(motion));
  for (std::string line; std::getline(text, line);) ASSERT_TRUE(live.Take(line, frames));
  EXPECT_THAT(live.TakeRemarks(), ::testing::Contains(::testing::StartsWith("line 2: ")));
}

TEST(LiveStream, TakesTheClocksTextsAndCommasOfTables) {
  for (const auto& [start, per_second] : {std::pair(0.0, 1e3), {1.6e9, 1.0}, {1.6e9, 1e3}}) {
    std::string csv, marked, line;
    std::istringstream text(WriteJointCsv(WavingMotion(40)));
    for (int k = -1; std::getline(text, line); ++k) {
      const std::size_t first = line.find(','), second = line.find(',', first + 1);
      const std::string time = fmt::format("{:.3f}", (start + k / 30.0) * per_second);
      line = k < 0 ? line : line.substr(0, first + 1) + time + line.substr(second);
      csv += line + "\n";
      // The same with semicolons, decimal commas, and a text column that is empty in some rows.
      line += k < 0 ? ",label" : k % 3 > 0 ? "," : ",walk";
      for (char& c : line) c = c == ',' ? ';' : c == '.' ? ',' : c;
      marked += line + "\n";
    }
    ExpectAsRecorded(csv);
    ExpectAsRecorded(marked);
    EXPECT_EQ(Listen(marked).frames.size(), 40u);
  }
}

TEST(LiveStream, ASensorUpsideDownIsTurnedBackAndSaid) {
  std::string text;
  for (int t = 0; t < 40; ++t) {
    for (const glm::dvec3& joint : testing::StandingPose(0.01 * t).joints) {
      const glm::dvec3 p = testing::KinectSpace(joint);
      text += fmt::format("{} {} {} ", -p.x, -p.y, p.z);
    }
    text += '\n';
  }
  const Heard turned = Listen(text);
  ASSERT_EQ(turned.frames.size(), 40u);
  EXPECT_NEAR(turned.frames[0][Role::kHead].position.y, 1.65, 1e-5);
  LiveStream live("-", {}, {});
  std::vector<SensedFrame> frames;
  EXPECT_TRUE(live.TakeRemarks().empty());
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
    ASSERT_TRUE(live.Take(std::string_view(text).substr(at, text.find('\n', at) - at), frames));
  }
  EXPECT_THAT(
      live.TakeRemarks(),
      ::testing::ElementsAre("without a clock (Etude assumes 30 Hz)",
                             ::testing::StartsWith("the sensor was rotated by 180 degrees, and Etude rotated")));
  EXPECT_TRUE(live.TakeRemarks().empty());
}

TEST(LiveStream, EachLineOfCsvGivesItsFrameAtOnce) {
  const Heard heard = Listen(WriteJointCsv(WavingMotion(10)));
  EXPECT_EQ(heard.known, (std::vector<std::size_t>{0, 0, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
}

TEST(LiveStream, AShortStreamIsGivenOutAtItsEnd) { EXPECT_EQ(Listen(KinectV1Text(WavingMotion(5))).frames.size(), 5u); }

TEST(LiveStream, ADamagedRowIsLeftOutAndSaidOnce) {
  const std::string rows = WithClock(KinectV1Text(WavingMotion(60)), 0, 1 / 30.0),
                    csv = WriteJointCsv(WavingMotion(60));
  for (const std::string& text : {rows, csv}) {
    // The rows 41 and 46 are cut.
    std::string cut, line;
    std::istringstream lines(text);
    for (int row = 1; std::getline(lines, line); ++row) {
      cut += (row == 41 || row == 46 ? line.substr(0, line.size() / 2) : line) + "\n";
    }
    LiveStream live("-", {}, {});
    std::vector<SensedFrame> frames;
    std::vector<std::string> remarks;
    std::istringstream again(cut + rows.substr(0, 20));  // the end of the pipe cuts a row, too
    while (std::getline(again, line)) {
      ASSERT_TRUE(live.Take(line, frames));
      for (std::string& remark : live.TakeRemarks()) remarks.push_back(std::move(remark));
    }
    EXPECT_THAT(remarks, ::testing::Contains(::testing::AllOf(
                             ::testing::StartsWith("line 41: "),
                             ::testing::EndsWith("; Etude leaves out this row and later damaged rows"))));
    EXPECT_EQ(std::ranges::count_if(remarks, [](const auto& remark) { return remark.starts_with("line "); }), 1);
    EXPECT_EQ(frames.size(), 60u);
  }
}

TEST(LiveStream, ACounterThatBeginsAgainAndAClockThatIsSetGoOn) {
  const std::string rows = KinectV1Text(WavingMotion(90));
  const auto frames_of = [&](const auto& time_of) {
    std::string timed;
    for (std::size_t at = 0, row = 0; at < rows.size(); ++row) {
      const std::size_t end = rows.find('\n', at);
      timed += fmt::format("{} {}\n", time_of(static_cast<long>(row)), rows.substr(at, end - at));
      at = end + 1;
    }
    const Heard heard = Listen(timed);
    EXPECT_EQ(heard.complaint, "");
    return heard.frames.size();
  };
  constexpr long kWrap = 4294967296;
  // The last of 90 rows comes after 2.966 s; the clock that is set loses 29 frames more, of a second without a body.
  EXPECT_EQ(frames_of([](long row) { return (kWrap - 2000 + row * 100 / 3) % kWrap; }), 89u);
  EXPECT_EQ(frames_of([](long row) { return row * 100 / 3 + (row < 60 ? 0 : 3600000); }), 89u + 29u);
}

TEST(LiveStream, ComplaintsCountTheLinesOfTheStream) {
  const std::string rows = KinectV1Text(WavingMotion(31));
  std::string damaged = rows + "\n";
  for (int i = 0; i < 31; ++i) damaged += "1 2 3\n";
  EXPECT_EQ(Listen(damaged).complaint.find("-:63: found 3 numbers in this row"), 0u);
  EXPECT_EQ(Listen("").complaint.find("-:1: the stream has no rows of joint positions"), 0u);
  EXPECT_EQ(Listen(AzureText(WavingMotion(2))).complaint.find("-:1: the stream has no rows of joint positions"), 0u);
}

}  // namespace
}  // namespace etude
