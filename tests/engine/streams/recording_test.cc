#include "engine/streams/recording.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/streams/live_stream.h"
#include "engine/streams/stream_maker.h"
#include "tests/engine/streams/small_files.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::AzureText;
using testing::KinectSpace;
using testing::KinectV1Text;
using testing::KinectV2Text;
using testing::NtuText;
using testing::StandingPose;
using testing::WavingMotion;
using testing::WithClock;

std::string ComplaintOf(const std::string& text, const StreamReading& reading = {}) {
  return testing::Refusal(ReadStreamRecording(text, "s", reading));
}

MadeStream Made(const std::string& text, const StreamReading& reading = {}, const StreamOptions& options = {}) {
  const auto read = ReadStreamRecording(text, "s", reading);
  EXPECT_TRUE(read) << ToString(read.error());
  if (!read) return {};
  auto made = MakeStream(*read, "s", options);
  EXPECT_TRUE(made) << ToString(made.error());
  return made ? *made : MadeStream{};
}

/// Returns the largest distance of a joint from the motion, after removing the sensor's place on the floor.
double FurthestFrom(const BodyMotion& motion, const SkeletonStream& stream) {
  double furthest = motion.poses.size() == stream.frames.size() ? 0 : 1e9;
  for (std::size_t t = 0; furthest < 1e9 && t < motion.poses.size(); ++t) {
    const glm::dvec3 shift = motion.poses[0][Role::kHipCentre] - stream.frames[0][Role::kHipCentre].position;
    for (const Role role : AllRoles()) {
      const glm::dvec3 off = stream.frames[t][role].position + glm::dvec3(shift.x, 0, shift.z) - motion.poses[t][role];
      furthest = std::max(furthest, glm::length(off));
    }
  }
  return furthest;
}

TEST(Streams, EveryFormatGivesTheSameMotionBackLevelAndFacingTheSensor) {
  const BodyMotion motion = WavingMotion();
  const std::pair<StreamFormat, std::string> files[] = {
      {StreamFormat::kKinectV2, KinectV2Text(motion, " 0 0 0 1")},
      {StreamFormat::kKinectV1, KinectV1Text(motion)},
      {StreamFormat::kKinectV1, KinectV1Text(motion, "1")},
      {StreamFormat::kKinectV1, WithClock(KinectV1Text(motion, "1"), 44155936, 1e6 / 30)},
      {StreamFormat::kNtu, NtuText(motion)},
      {StreamFormat::kAzureKinect, AzureText(motion)},
      {StreamFormat::kEtudeCsv, WriteJointCsv(motion)},
      {StreamFormat::kTrc, WriteTrc(motion, "m")}};
  for (const auto& [format, text] : files) {
    SCOPED_TRACE(StreamFormatName(format));
    ASSERT_EQ(DetectStreamFormat(text), format);
    EXPECT_LT(FurthestFrom(motion, Made(text).stream), 1e-3);
  }
}

TEST(Streams, EtudesOwnFilesComeBackToTheLastDigitPrinted) {
  const BodyMotion motion = WavingMotion();
  const std::string csv = WriteJointCsv(motion), trc = WriteTrc(motion, "m");
  EXPECT_EQ(WriteJointCsv(MotionOf(Made(csv).stream)), csv);
  EXPECT_EQ(WriteTrc(MotionOf(Made(trc).stream), "m"), trc);
}

TEST(Streams, StatesAreToldWhereTheFileHasThemAndSaidToBeMissingElse) {
  const BodyMotion motion = WavingMotion(3);
  const auto tells = [](const std::string& text) { return ReadStreamRecording(text, "s")->records_states; };
  EXPECT_FALSE(tells(KinectV1Text(motion)));
  EXPECT_FALSE(tells(KinectV1Text(motion, "1")));  // a column of weights, as in MSRC-12
  EXPECT_TRUE(tells(KinectV1Text(motion, "2")));
  EXPECT_TRUE(tells(NtuText(motion)));
  EXPECT_FALSE(tells(AzureText(motion)));
  EXPECT_TRUE(tells(AzureText(motion, "1")));
  EXPECT_EQ(Made(NtuText(motion, 1)).stream.frames[0][Role::kHead].state, TrackingState::kInferred);
  EXPECT_EQ(Made(AzureText(motion, "1")).stream.frames[0][Role::kHead].state, TrackingState::kInferred);
  EXPECT_EQ(Made(AzureText(motion, "2")).stream.frames[0][Role::kHead].state, TrackingState::kTracked);
}

TEST(Streams, AClockMayCountMicrosecondsMillisecondsSecondsOrFrames) {
  const std::string rows = KinectV1Text(WavingMotion());
  for (const double step : {1e6 / 30, 1e3 / 30, 1.0 / 30, 1.0})
    EXPECT_EQ(Made(WithClock(rows, 100 * step, step)).stream.frames.size(), 60u) << step;
  // Files of UTKinect count frames at 30 Hz and have a row for every second or every sixth frame. A step of 6 does
  // not count milliseconds, because no sensor has 166 Hz.
  EXPECT_EQ(Made(WithClock(rows, 252, 2)).stream.frames.size(), 119u);
  const MadeStream sixth = Made(WithClock(rows, 252, 6));
  EXPECT_EQ(sixth.stream.frames.size(), 355u);
  EXPECT_EQ(sixth.lost_frames, 0u);  // rows are 0.2 s apart, despite rounding
  EXPECT_NEAR(sixth.start_s, 252 / 30.0, 1e-9);
  const auto read = ReadStreamRecording(WithClock(rows, 252, 6), "s");
  EXPECT_EQ(read->remarks,
            std::vector<std::string>{"Etude reads the first column as frame numbers at 30 Hz, with one row for every 6 "
                                     "frames"});
  // Whole milliseconds at 60 Hz, and fractions of milliseconds at any rate, are read as milliseconds.
  EXPECT_EQ(Made(WithClock(rows, 1000, 17)).stream.frames.size(), 31u);
  EXPECT_EQ(Made(WithClock(rows, 1000.5, 8)).stream.frames.size(), 15u);
}

TEST(Streams, AClockCountsMinutesIfItsHeadingNamesThem) {
  const std::string rows = WithClock(KinectV1Text(WavingMotion()), 5, .1 / 60);  // 10 Hz
  EXPECT_EQ(Made("time_min joints\n" + rows).stream.frames.size(), 178u);
  EXPECT_NEAR(Made("time_min joints\n" + rows).start_s, 300, 1e-9);
  EXPECT_NE(Made("time joints\n" + rows).stream.frames.size(), 178u) << "the control";
}

TEST(Streams, LinesMayEndAsOnOldMacs) {
  for (std::string rows :
       {KinectV1Text(WavingMotion()), WriteJointCsv(WavingMotion()), WriteTrc(WavingMotion(), "t")}) {
    const MadeStream made = Made(rows);
    std::ranges::replace(rows, '\n', '\r');
    const MadeStream of_mac = Made(rows);
    ASSERT_EQ(of_mac.stream.frames.size(), made.stream.frames.size());
    for (std::size_t t = 0; t < made.stream.frames.size(); ++t)
      EXPECT_EQ(PoseOf(of_mac.stream.frames[t]).joints, PoseOf(made.stream.frames[t]).joints) << t;
  }
}

TEST(Streams, ClocksInAnotherUnitAreRefused) {
  const std::string text = AzureText(WavingMotion());
  const auto scaled = [&](double factor) {
    std::string out;
    const std::string key = "\"timestamp_usec\":";
    std::size_t at = 0;
    for (std::size_t found; (found = text.find(key, at)) != std::string::npos;) {
      const std::size_t start = found + key.size(), end = text.find_first_not_of(" 0123456789.", start);
      out += text.substr(at, start - at) + fmt::format("{:.0f}", factor * std::stod(text.substr(start, end - start)));
      at = end;
    }
    return out + text.substr(at);
  };
  EXPECT_EQ(Made(scaled(1)).stream.frames.size(), 60u);
  EXPECT_TRUE(ComplaintOf(scaled(1e-3)).find("Hz; allowed: 1 to 10000 Hz") != std::string::npos);
  EXPECT_TRUE(ComplaintOf(scaled(1e3)).find("the times give a rate of 0.03 Hz; allowed: 1 to 10000 Hz") !=
              std::string::npos);
  EXPECT_EQ(ComplaintOf(scaled(1e3), {.rate_hz = 30}), "accepted");
}

TEST(Streams, APlaceOfThreeTimesMinusOneIsNoPlace) {
  std::string rows;
  std::istringstream text(KinectV1Text(WavingMotion()));
  int row = 0;
  for (std::string line; std::getline(text, line); ++row) {
    std::istringstream words(line);
    std::string word;
    for (int i = 0; words >> word; ++i) rows += (row >= 20 && row < 40 && i / 3 == 7 ? "-1" : word) + " ";
    rows += '\n';
  }
  const auto read = ReadStreamRecording(rows, "s");
  ASSERT_TRUE(read) << ToString(read.error());
  for (std::size_t t = 0; t < read->frames.size(); ++t) {
    EXPECT_EQ(read->frames[t].places[7].has_value(), t < 20 || t >= 40) << t;
  }
}

TEST(Streams, AJointThatIsSometimesAtTheOriginIsNotReportedThere) {
  BodyMotion motion = WavingMotion();
  for (std::size_t t = 20; t < 40; ++t) motion.poses[t][Role::kLeftHand] = glm::dvec3(0);
  for (std::size_t t = 50; t < 55; ++t) motion.poses[t].joints.fill(glm::dvec3(0));
  for (const std::string& text : {WriteJointCsv(motion), WriteTrc(motion, "m")}) {
    ASSERT_OK(read, ReadStreamRecording(text, "s"));
    ASSERT_EQ(read->frames.size(), 60u);
    for (std::size_t t = 0; t < 60; ++t) {
      const bool is_lost = t >= 50 && t < 55;
      EXPECT_EQ(read->frames[t].places[Index(Role::kHead)].has_value(), !is_lost) << t;
      EXPECT_EQ(read->frames[t].places[Index(Role::kLeftHand)].has_value(), !is_lost && (t < 20 || t >= 40)) << t;
    }
  }
  // The root of a pose that is relative to it is always at the origin.
  for (BodyPose& pose : motion.poses = WavingMotion().poses) {
    const glm::dvec3 root = pose[Role::kHipCentre];
    for (glm::dvec3& joint : pose.joints) joint -= root;
  }
  ASSERT_OK(relative, ReadStreamRecording(WriteJointCsv(motion), "s"));
  for (const RecordedFrame& frame : relative->frames) EXPECT_TRUE(frame.places[Index(Role::kHipCentre)]);
}

TEST(Streams, TheClockOfARecordingIsKept) {
  const BodyMotion motion = WavingMotion();
  for (const std::string& text : {WriteJointCsv(motion, 5), WriteTrc(JointMarkers(motion, 5), "m")}) {
    const MadeStream made = Made(text);
    EXPECT_NEAR(made.start_s, 5, 1e-6);
    EXPECT_EQ(made.stream.frames.size(), 60u);
  }
}

TEST(Streams, RowsInBurstsAreEvenlySpaced) {
  // Packets of six rows, 1 ms apart, 30 Hz on average.
  const BodyMotion motion = WavingMotion(90);
  const std::string rows = KinectV1Text(motion);
  std::string timed;
  for (std::size_t at = 0, row = 0; at < rows.size(); ++row) {
    const std::size_t end = rows.find('\n', at);
    timed += fmt::format("{} {}\n", row / 6 * 200 + row % 6, rows.substr(at, end - at));
    at = end + 1;
  }
  EXPECT_EQ(Made(timed).stream.frames.size(), 90u);
  EXPECT_LT(FurthestFrom(motion, Made(timed).stream), 1e-3);
}

TEST(Streams, RowsOfCoarseTimesKeepTheirPlaceBesideAHole) {
  const BodyMotion motion = WavingMotion(600, 120);
  std::string trc, line;
  std::istringstream text(WriteTrc(motion, "m"));
  for (int row = 0; std::getline(text, line); ++row) {
    const int frame = row - 6;  // after six lines of header
    if (frame >= 200 && frame < 260) continue;
    if (frame >= 0) {
      const std::size_t first = line.find('\t'), second = line.find('\t', first + 1);
      line = line.substr(0, first + 1) + fmt::format("{:.2f}", frame / 120.0) + line.substr(second);
    }
    const std::size_t count = line.find("\t600\t");
    if (frame < 0 && count != std::string::npos) line.replace(count, 5, "\t540\t");
    trc += line + "\n";
  }
  const auto read = ReadStreamRecording(trc, "s");
  ASSERT_TRUE(read) << ToString(read.error());
  ASSERT_EQ(read->frames.size(), 540u);
  for (int t = 0; t < 540; ++t) {
    EXPECT_NEAR(read->frames[static_cast<std::size_t>(t)].time_s, (t < 200 ? t : t + 60) / 120.0, 1e-9) << t;
  }
}

TEST(Streams, TablesMayCountMillisecondsOrSince1970) {
  const BodyMotion motion = WavingMotion();
  const SkeletonStream wanted = Made(WriteJointCsv(motion)).stream;
  for (const auto& [start, per_second] : {std::pair(0.0, 1e3), {1.6e9, 1.0}, {1.6e9, 1e3}}) {
    std::string csv, line;
    std::istringstream text(WriteJointCsv(motion));
    for (int k = -1; std::getline(text, line); ++k) {
      const std::size_t first = line.find(','), second = line.find(',', first + 1);
      const std::string time = fmt::format("{:.3f}", (start + k / motion.rate_hz) * per_second);
      csv += (k < 0 ? line : line.substr(0, first + 1) + time + line.substr(second)) + "\n";
    }
    const SkeletonStream read = Made(csv).stream;
    ASSERT_EQ(read.frames.size(), wanted.frames.size()) << start << " " << per_second;
    EXPECT_LT(FurthestFrom(motion, read), 0.01);
    EXPECT_EQ(ReadStreamRecording(csv, "s")->remarks.size(), 1u);
  }
  // TRC with decimal commas.
  std::string trc = WriteTrc(motion, "a");
  std::replace(trc.begin() + static_cast<std::ptrdiff_t>(trc.find("\n1\t")), trc.end(), '.', ',');
  EXPECT_LT(FurthestFrom(motion, Made(trc).stream), 1e-5);
  EXPECT_EQ(ReadStreamRecording(trc, "s")->remarks, std::vector<std::string>{"Etude read commas as decimal points"});
}

TEST(Streams, OfSeveralBodiesTheOneSeenLongestIsTakenUnlessAnotherIsAskedFor) {
  const std::string one = NtuText(WavingMotion(1));
  const std::string body = one.substr(one.find("7205"));
  std::string other = body;
  other.replace(0, 17, "72057594037931102");
  const std::string text = "3\n1\n" + other + "2\n" + other + body + "1\n" + body + "";
  EXPECT_EQ(ReadStreamRecording(text, "s")->remarks.size(), 1u);
  EXPECT_TRUE(ReadStreamRecording(text, "s", {.body = 1})->frames[0].places[0] == std::nullopt);
  EXPECT_EQ(ComplaintOf(text, {.body = 2}), "s: there is no body 2; the file has 2 bodies, counted from 0");
}

/// Returns one body of a frame in NTU's text, under another name and `aside` metres to the side.
std::string NtuBody(const std::string& id, double aside) {
  BodyMotion motion = WavingMotion(1);
  for (glm::dvec3& joint : motion.poses[0].joints) joint.x += aside;
  const std::string text = NtuText(motion);
  return id + text.substr(text.find(" 0 1 1"));
}

TEST(Streams, ABodyThatGoesOnUnderAnotherNameIsOnePerson) {
  const auto text = [](double second_aside, int missing) {
    std::string frames;
    for (int t = 0; t < 21; ++t) {
      const bool is_lost = t >= 11 && t < 11 + missing;
      const std::string person = t < 11 ? NtuBody("11", 0) : NtuBody("22", second_aside);
      frames += is_lost ? "1\n" + NtuBody("33", 3) : "2\n" + person + NtuBody("33", 3);
    }
    return "21\n" + frames;
  };
  const auto shown = [](const StreamRecording& recording) {
    return std::ranges::count_if(recording.frames, [](const RecordedFrame& f) { return f.places[0].has_value(); });
  };
  ASSERT_OK(joined, ReadStreamRecording(text(0.1, 2), "s", {.body = 0}));
  EXPECT_EQ(shown(*joined), 19);
  EXPECT_EQ(joined->remarks.front(), "body 11 continues as body 22 from frame 13 on; Etude reads both as one person");
  EXPECT_EQ(joined->remarks.back(), "the file has 2 bodies; Etude reads body 0; 2 of 21 frames show only other bodies");
  // A person a metre aside is not joined to the first, nor is one who appears while the first is still seen.
  const auto other = ReadStreamRecording(text(1, 2), "s", {.body = 0});
  EXPECT_EQ(shown(*other), 11);
  EXPECT_EQ(other->remarks, std::vector<std::string>{"the file has 3 bodies; Etude reads body 0; 10 of 21 frames show "
                                                     "only other bodies"});
  const std::string both = "2\n2\n" + NtuBody("11", 0) + NtuBody("22", 0.1) + "1\n" + NtuBody("22", 0.1);
  EXPECT_EQ(ReadStreamRecording(both, "s")->remarks,
            std::vector<std::string>{"the file has 2 bodies; Etude reads body 1, because it is in the most frames"});
}

TEST(Streams, AJoinedPersonMayBeLostForThreeSecondsIfNobodyElseIsSeen) {
  // Someone is lost from frame 40 on, and comes back under another id, `aside` metres away.
  const auto text = [](int missing, double aside, bool has_other) {
    std::string frames;
    for (int t = 0; t < 160; ++t) {
      const bool is_lost = t >= 40 && t < 40 + missing;
      frames += fmt::format("{}\n", (is_lost ? 0 : 1) + (has_other ? 1 : 0));
      if (!is_lost) frames += t < 40 ? NtuBody("11", 0) : NtuBody("22", aside);
      if (has_other) frames += NtuBody("33", 3);
    }
    return "160\n" + frames;
  };
  const auto last_remark = [&](const std::string& file) {
    return ReadStreamRecording(file, "s", {.body = 0})->remarks.back();
  };
  const std::string joined = "body 11 continues as body 22 from frame 80 on; Etude reads both as one person";
  EXPECT_EQ(last_remark(text(40, 0.1, false)), joined);
  // The remark counts the frames that show somebody else.
  EXPECT_EQ(last_remark(text(40, 0.1, true)),
            "the file has 3 bodies; Etude reads body 0; 120 of 160 frames show only other bodies");
  EXPECT_EQ(last_remark(text(95, 0.1, false)),
            "the file has 2 bodies; Etude reads body 0; 25 of 160 frames show only other bodies");
  EXPECT_EQ(last_remark(text(40, 1, false)),
            "the file has 2 bodies; Etude reads body 0; 80 of 160 frames show only other bodies");
}

/// The joints of a Kinect v1, in the order of its SDK.
constexpr const char* kV1Names[] = {"HipCenter",  "Spine",     "ShoulderCenter", "Head",          "ShoulderLeft",
                                    "ElbowLeft",  "WristLeft", "HandLeft",       "ShoulderRight", "ElbowRight",
                                    "WristRight", "HandRight", "HipLeft",        "KneeLeft",      "AnkleLeft",
                                    "FootLeft",   "HipRight",  "KneeRight",      "AnkleRight",    "FootRight"};

/// Returns a Kinect v1's table with headings, whose k-th joint is joint `order[k]` of the SDK. `heading` makes the
/// heading of a joint's axis.
std::string NamedTable(const BodyMotion& motion, const std::vector<int>& order, bool has_clock,
                       const std::function<std::string(std::string, char)>& heading) {
  std::string text = has_clock ? "time" : "";
  for (const int j : order) {
    for (const char axis : {'x', 'y', 'z'}) text += (text.empty() ? "" : ",") + heading(kV1Names[j], axis);
  }
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    text += "\n" + (has_clock ? fmt::format("{}", static_cast<double>(t) / 30) : "");
    for (const int j : order) {
      const glm::dvec3 p = KinectSpace(motion.poses[t].joints[static_cast<std::size_t>(j)]);
      text += fmt::format("{}{},{},{}", text.ends_with('\n') ? "" : ",", p.x, p.y, p.z);
    }
  }
  return text + "\n";
}

TEST(Streams, TheNamesOfAHeadingTellTheJointsOfAKinect) {
  const BodyMotion motion = WavingMotion();
  std::vector<int> sdk(20), legs_first;
  for (int j = 0; j < 20; ++j) sdk[static_cast<std::size_t>(j)] = j;
  for (const int j : {0, 12, 13, 14, 15, 16, 17, 18, 19, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}) legs_first.push_back(j);
  const auto camel = [](const std::string& name, char axis) { return name + "_" + axis; };
  const auto ours = [](const std::string& name, char axis) {
    return fmt::format(
        "position {}.{}",
        RoleName(AllRoles()[static_cast<std::size_t>(std::ranges::find(kV1Names, name) - std::begin(kV1Names))]), axis);
  };
  const std::string said = "the heading names the joints in another order than the SDK's; Etude uses the names";
  for (const bool has_clock : {false, true}) {
    for (const auto& heading : {std::function<std::string(std::string, char)>(camel), {ours}}) {
      const std::string other = NamedTable(motion, legs_first, has_clock, heading);
      EXPECT_LT(FurthestFrom(motion, Made(other).stream), 1e-3) << other.substr(0, 80);
      EXPECT_EQ(ReadStreamRecording(other, "s")->remarks, std::vector<std::string>{said});
      EXPECT_TRUE(ReadStreamRecording(NamedTable(motion, sdk, has_clock, heading), "s")->remarks.empty());
      // A live stream places the joints as the recording does.
      LiveStream live("s", {}, {});
      std::vector<SensedFrame> frames;
      std::istringstream lines(other);
      for (std::string line; std::getline(lines, line);) ASSERT_TRUE(live.Take(line, frames));
      ASSERT_TRUE(live.Finish(frames));
      ASSERT_EQ(frames.size(), motion.poses.size());
      EXPECT_LT(FurthestFrom(motion, {.rate_hz = 30, .frames = frames}), 1e-3);
    }
  }
  // If the headings name no joints, the rows are in the order of the SDK.
  int column = 0;
  const auto numbered = [&](const std::string&, char axis) { return fmt::format("joint{}_{}", column++ / 3, axis); };
  EXPECT_LT(FurthestFrom(motion, Made(NamedTable(motion, sdk, false, numbered)).stream), 1e-3);
  EXPECT_LT(FurthestFrom(motion, Made("a recording of Anna\n" + KinectV1Text(motion)).stream), 1e-3);
}

TEST(Streams, AHeadingThatNamesOtherJointsIsRefused) {
  const BodyMotion motion = WavingMotion(2);
  std::vector<int> sdk(20);
  for (int j = 0; j < 20; ++j) sdk[static_cast<std::size_t>(j)] = j;
  const auto table = [&](const std::string& from, const std::string& to) {
    const std::string text =
        NamedTable(motion, sdk, true, [](const std::string& name, char axis) { return name + "_position_" + axis; });
    std::string heading = text.substr(0, text.find('\n'));
    for (std::size_t at = 0; (at = heading.find(from, at)) != std::string::npos; at += to.size()) {
      heading.replace(at, from.size(), to);
    }
    return ComplaintOf(heading + text.substr(text.find('\n')));
  };
  EXPECT_EQ(table("KneeLeft", "LeftLeg")
                .find("s:1: the heading of column 41 is 'LeftLeg_position_x', which names no "
                      "joint of this Kinect; allowed: HipCenter, Spine, "),
            0u)
      << table("KneeLeft", "LeftLeg");
  EXPECT_EQ(table("KneeLeft", "HipLeft").find("s:1: the headings of columns 38 and 41 both name HipLeft"), 0u);
  EXPECT_EQ(table("KneeLeft_position_x,KneeLeft_position_y", "KneeLeft_position_y,KneeLeft_position_x")
                .find("s:1: the headings of columns 41 to 43 are 'KneeLeft_position_y', 'KneeLeft_position_x' and "),
            0u)
      << table("KneeLeft_position_x,KneeLeft_position_y", "KneeLeft_position_y,KneeLeft_position_x");
  EXPECT_EQ(table("time,", "").find("s:1: the heading names joints in 60 columns, but rows have 61 numbers"), 0u);
}

TEST(Streams, AFlatBodyIsRefusedBecauseItIsInPixels) {
  // OpenPose's rows: x and y in pixels, Y down, and a score.
  std::string rows;
  for (const BodyPose& pose : WavingMotion(3).poses) {
    for (int j = 0; j < 25; ++j) {
      const glm::dvec3& p = pose.joints[j == 20 ? Index(Role::kShoulderCentre) : static_cast<std::size_t>(j % 20)];
      rows += fmt::format("{} {} {} ", 640 + 500 * p.x, 900 - 500 * p.y, 0.5 + 0.02 * (j % 20));
    }
    rows += '\n';
  }
  EXPECT_EQ(ComplaintOf(rows),
            "s: the body is at most 0.00038 m deep in every frame; allowed: at least 0.01 m; are these pixels of a "
            "picture, whose third number is a score?");
}

TEST(Streams, MarkersOfOtherNamesAreTold) {
  const std::string trc = WriteTrc(WavingMotion(2), "m");
  EXPECT_EQ(ComplaintOf(std::string(trc).replace(trc.find("head"), 4, "C7")),
            "s:4: unknown marker names 'C7'; missing markers: head; `etude clip convert` can read other marker sets");
  MarkerMotion markers;
  for (int i = 0; i < 39; ++i) markers.names.push_back(fmt::format("M{}", i));
  markers.frames.resize(2, std::vector<std::optional<glm::dvec3>>(39, glm::dvec3(1)));
  const std::string complaint = ComplaintOf(WriteTrc(markers, "m"));
  EXPECT_NE(complaint.find("'M7' and 31 more; missing markers: hip_centre, spine"), std::string::npos) << complaint;
}

TEST(Streams, JointsThatAreNeverShownAndTimesThatRunBackAreRefused) {
  EXPECT_EQ(ComplaintOf("head_x_m,head_y_m,head_z_m\n0,1,2\n").find("s: no frame shows hip_centre, spine"), 0u);
  const std::string rows = KinectV1Text(WavingMotion(2));
  EXPECT_EQ(ComplaintOf(WithClock(rows, 1, 0.03) + WithClock(rows, 0.5, 0.03)).find("s:3: the time 0.5 s follows"), 0u);
}

TEST(Streams, NobodyAndTooSmallOrTooLargeBodiesAreRefused) {
  std::string nobody;
  for (int i = 0; i < 60; ++i) nobody += "0 ";
  EXPECT_EQ(ComplaintOf(nobody + "\n"), "s: no frame shows a body");
  BodyMotion giant = WavingMotion(2);
  for (auto& joint : giant.poses[0].joints) joint *= 4.0;
  for (auto& joint : giant.poses[1].joints) joint *= 4.0;
  EXPECT_NE(ComplaintOf(KinectV1Text(giant)).find("the distance from hip centre to shoulder centre is 1.88"),
            std::string::npos)
      << ComplaintOf(KinectV1Text(giant));
}

}  // namespace
}  // namespace etude
