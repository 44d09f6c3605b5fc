#include "engine/streams/body_jumps.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "engine/streams/live_stream.h"
#include "tests/engine/streams/small_files.h"
#include "tests/support/kept_answers.h"
#include "tests/support/random_clip.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::AllReplaced;
using testing::AzureText;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::KinectV1Text;
using testing::NtuText;
using ::testing::StartsWith;
using testing::WavingMotion;
using testing::WithClock;

/// Returns a waving person who is `aside(t)` metres to the side in frame t.
BodyMotion Aside(const std::function<double(int t)>& aside, int frames = 60) {
  BodyMotion motion = WavingMotion(frames);
  for (int t = 0; t < frames; ++t) {
    for (glm::dvec3& joint : motion.poses[static_cast<std::size_t>(t)].joints) joint.x += aside(t);
  }
  return motion;
}

std::vector<std::string> RemarksOn(const std::string& text) {
  const auto read = ReadStreamRecording(text, "s");
  EXPECT_TRUE(read) << ToString(read.error());
  return read ? read->remarks : std::vector<std::string>();
}

TEST(BodyJumps, AnotherPersonUnderTheSameNameIsSaid) {
  // Two people 1.2 m apart: exchanged once, and in every second row.
  const std::string once = KinectV1Text(Aside([](int t) { return t < 30 ? 0 : 1.2; }));
  EXPECT_THAT(RemarksOn(once), ElementsAre("the body jumps by 1.20 m at 1.00 s; has the sensor changed to another "
                                           "person?"));
  const std::string often = KinectV1Text(Aside([](int t) { return t % 2 == 0 ? 0 : 1.2; }));
  EXPECT_THAT(RemarksOn(often),
              ElementsAre("the body jumps 59 times, first by 1.20 m at 0.03 s; has the sensor changed to another "
                          "person?"));
  // Over frames without a body, at 15 Hz, and by exchanged ids of NTU.
  std::string lost = often, nobody;
  for (int i = 0; i < 60; ++i) nobody += "0 ";
  lost.insert(lost.find('\n') + 1, nobody + "\n");
  EXPECT_THAT(RemarksOn(lost), Contains(StartsWith("the body jumps 59 times, first by 1.20 m at 0.07 s")));
  EXPECT_THAT(RemarksOn(WithClock(once, 0, 66)), ElementsAre(StartsWith("the body jumps by 1.20 m at 1.98 s")));
  EXPECT_THAT(RemarksOn(NtuText(Aside([](int t) { return t < 30 ? 0 : 1.2; }))),
              ElementsAre(StartsWith("the body jumps by 1.20 m at 1.00 s")));
}

TEST(BodyJumps, ASprinterAndAPersonWhoComesBackDoNot) {
  EXPECT_THAT(RemarksOn(KinectV1Text(Aside([](int t) { return 11.5 * t / 30; }))), IsEmpty());
  EXPECT_THAT(RemarksOn(WithClock(KinectV1Text(Aside([](int t) { return 11.5 * t / 10; }, 40)), 0, 100)), IsEmpty());
  // A person who is lost for half a second, and comes back 2 m aside.
  BodyJumps jumps;
  RecordedFrame frame;
  for (std::size_t i = 0; i < kRoleCount; ++i) frame.places[i] = testing::StandingPose().joints[i];
  EXPECT_FALSE(jumps.Take(frame));
  frame.time_s = 0.5;
  for (auto& place : frame.places) place->x += 2;
  EXPECT_FALSE(jumps.Take(frame));
  EXPECT_EQ(jumps.Describe(), "");
  // One limb that jumps is not the body; neither are four joints.
  for (std::size_t i = 0; i < 9; ++i) frame.places[i]->x += 3;
  frame.time_s = 0.6;
  EXPECT_FALSE(jumps.Take(frame));
  for (std::size_t i = 4; i < kRoleCount; ++i) frame.places[i].reset();
  for (std::size_t i = 0; i < 4; ++i) frame.places[i]->x += 3;
  frame.time_s = 0.7;
  EXPECT_FALSE(jumps.Take(frame));
}

/// Takes all lines; returns the remarks, and the error message if there is one. The remarks that every stream of a
/// Kinect without clock or tilt has are left out.
std::vector<std::string> LiveRemarks(const std::string& text, std::size_t& frames) {
  LiveStream live("-", {}, {});
  std::vector<SensedFrame> stream;
  std::vector<std::string> remarks;
  std::istringstream lines(text);
  Result<void> taken;
  for (std::string line; taken && std::getline(lines, line);) {
    taken = live.Take(line, stream);
    for (std::string& remark : live.TakeRemarks()) remarks.push_back(std::move(remark));
  }
  std::erase(remarks, "without a clock (Etude assumes 30 Hz)");
  std::erase(remarks, "the up direction is found by the trunk (0.0 degrees); the floor is 1.00 m below the sensor");
  if (!taken) remarks.push_back(ToString(taken.error()));
  frames = stream.size();
  return remarks;
}

TEST(LiveStream, AnotherPersonIsSaidOnce) {
  std::size_t frames = 0;
  EXPECT_THAT(LiveRemarks(KinectV1Text(Aside([](int t) { return t < 40 || t % 2 == 0 ? 0 : 1.2; })), frames),
              ElementsAre("the body jumps by 1.20 m at 1.37 s; has the sensor changed to another person?; Etude does "
                          "not report later jumps"));
  EXPECT_EQ(frames, 60u);
}

TEST(LiveStream, ARowWhoseTimeIsALittleEarlierIsLeftOut) {
  const std::string rows = WithClock(KinectV1Text(WavingMotion(60)), 0, 33);
  // Row 41 has the time of row 39.
  const std::string back = AllReplaced(rows, "\n1320 ", "\n1254 ");
  std::size_t frames = 0;
  EXPECT_THAT(LiveRemarks(back, frames),
              ElementsAre("the time 1.254 s in line 41 follows 1.287 s; Etude leaves out rows with a time before the "
                          "latest time"));
  EXPECT_EQ(frames, 59u);  // 59 steps of 33 ms, at 30 Hz
  // A clock that begins again ends the stream.
  EXPECT_THAT(LiveRemarks(rows + rows, frames),
              ElementsAre("-:61: the clock goes back by 1.95 s, from 1.947 s to 0 s; allowed: to go back by at most 1 "
                          "s"));
}

TEST(Streams, ClocksOfTicksAreRecognised) {
  const std::string rows = KinectV1Text(WavingMotion());
  const auto frames = [](const std::string& text) {
    return MakeStream(ReadStreamRecording(text, "s").value(), "s").value().stream.frames.size();
  };
  // Ticks of 100 ns, from 0, as .NET counts them since year 1, and as Windows counts them since 1601; nanoseconds, from
  // 0 and since 1970.
  for (const auto& [first, step] :
       {std::pair(0.0, 333333.0), {6.38e17, 333333.0}, {1.34e17, 333333.0}, {0.0, 33333333.0}, {1.76e18, 33333333.0}}) {
    std::string text;
    std::istringstream lines(rows);
    int k = 0;
    for (std::string line; std::getline(lines, line); ++k) text += fmt::format("{:.0f} {}\n", first + k * step, line);
    EXPECT_EQ(frames(text), 60u) << first;
    EXPECT_THAT(RemarksOn(text), ElementsAre(HasSubstr("which gives a rate of 30 Hz; as "))) << first;
  }
  EXPECT_THAT(RemarksOn(WithClock(rows, 0, 1)), ElementsAre("Etude reads the first column as frame numbers at 30 Hz"));
  // Rates of Kinects have no doubt, other rates have one: 5 Hz in microseconds, 3 Hz and 200 Hz in milliseconds.
  EXPECT_THAT(RemarksOn(WithClock(rows, 0, 200000)), IsEmpty());
  EXPECT_THAT(RemarksOn(WithClock(rows, 0, 333)),
              ElementsAre(StartsWith("the times give a rate of 3 Hz, but a Kinect has")));
  EXPECT_THAT(RemarksOn(WithClock(rows, 0.5, 5.0)),
              ElementsAre(StartsWith("the times give a rate of 200 Hz, but a Kinect")));
  std::size_t live = 0;
  EXPECT_THAT(LiveRemarks(WithClock(rows, 0, 333), live), ElementsAre(StartsWith("the times give a rate of 3 Hz")));
}

TEST(Streams, DecimalCommasBetweenSemicolonsAreRead) {
  const std::string rows = KinectV1Text(WavingMotion(), "2");
  for (const bool has_clock : {false, true}) {
    for (const char separator : {';', '\t'}) {
      std::string points = has_clock ? WithClock(rows, 0, 0.033) : rows;
      points = AllReplaced(points, " \n", "\n");
      std::string commas = points;
      for (char& c : commas) c = c == ' ' ? separator : c == '.' ? ',' : c;
      ASSERT_OK(wanted, ReadStreamRecording(points, "s"));
      ASSERT_OK(read, ReadStreamRecording(commas, "s"));
      EXPECT_THAT(read->remarks, ElementsAre("Etude read commas as decimal points"));
      ASSERT_EQ(read->frames.size(), wanted->frames.size());
      for (std::size_t t = 0; t < read->frames.size(); ++t) {
        EXPECT_EQ(read->frames[t].places, wanted->frames[t].places) << t;
        EXPECT_EQ(read->frames[t].time_s, wanted->frames[t].time_s) << t;
      }
      std::size_t frames = 0;
      EXPECT_THAT(LiveRemarks(commas, frames), ElementsAre("Etude read commas as decimal points"));
      EXPECT_EQ(frames, MakeStream(*wanted, "s").value().stream.frames.size());
    }
  }
}

/// Returns the Azure Kinect's text of two people without ids; in every second frame, the second is listed first.
std::string TwoWithoutIds(const BodyMotion& one, const BodyMotion& other) {
  const auto bodies_of = [](const BodyMotion& motion) {
    const std::string text = AllReplaced(AzureText(motion), "\"body_id\":1,", "");
    const std::string begin = "\"bodies\":[";
    std::vector<std::string> bodies;
    for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos;) {
      at += begin.size();
      bodies.push_back(text.substr(at, text.find('}', at) + 1 - at));
    }
    return bodies;
  };
  const auto a = bodies_of(one), b = bodies_of(other);
  std::string frames;
  for (std::size_t t = 0; t < a.size(); ++t) {
    frames += fmt::format("{}{{\"timestamp_usec\":{},\"bodies\":[{},{}]}}", t == 0 ? "" : ",", 33333 * t,
                          t % 2 == 0 ? a[t] : b[t], t % 2 == 0 ? b[t] : a[t]);
  }
  return "{\"frames\":[" + frames + "]}";
}

TEST(Streams, BodiesWithoutIdsAreToldApartByNearness) {
  const BodyMotion one = Aside([](int t) { return 0.01 * t; }), other = Aside([](int) { return 1.2; });
  const std::string text = TwoWithoutIds(one, other);
  for (const int body : {0, 1}) {
    ASSERT_OK(read, ReadStreamRecording(text, "s", {.body = body}));
    EXPECT_THAT(read->remarks, Contains("several bodies of one frame have no id (first in frame 0); Etude reads each "
                                        "of these bodies as the nearest body of the frames before"));
    EXPECT_THAT(read->remarks, Contains(fmt::format("the file has 2 bodies; Etude reads body {}", body)));
    const BodyMotion& wanted = body == 0 ? one : other;
    for (std::size_t t = 0; t < 60; ++t) {
      EXPECT_NEAR(read->frames[t].places[0]->x, wanted.poses[t].joints[0].x, 1e-5) << t;
    }
  }
  // Both are in all frames, so the one that moves most is read, and said to be that one.
  EXPECT_THAT(RemarksOn(text),
              Contains("the file has 2 bodies; Etude reads body 0, because it moves most (2 bodies are in equally many "
                       "frames)"));
}

TEST(Streams, NeitherJitterNorAJumpMakesAStillBodyTheOneThatMovesMost) {
  // A person waves in the last third of the recording. A chair 1.2 m aside jitters by 2 cm, and jumps once by 1 m.
  constexpr int kFrames = 120;
  BodyMotion person = WavingMotion(kFrames), chair = Aside([](int t) { return t < 60 ? 1.2 : 2.2; }, kFrames);
  testing::Dice dice(3);
  for (std::size_t t = 0; t < kFrames; ++t) {
    if (t < 80) person.poses[t] = testing::StandingPose();
    const glm::dvec3 at = chair.poses[t].joints[0];
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      chair.poses[t].joints[i] =
          at + testing::StandingPose().joints[i] - testing::StandingPose().joints[0] + 0.02 * dice.Vector();
    }
  }
  for (const bool is_first : {true, false}) {
    const std::string text = is_first ? TwoWithoutIds(person, chair) : TwoWithoutIds(chair, person);
    ASSERT_OK(read, ReadStreamRecording(text, "s"));
    EXPECT_THAT(read->remarks, Contains(HasSubstr("because it moves most")));
    for (std::size_t t = 0; t < kFrames; ++t) {
      EXPECT_NEAR(read->frames[t].places[Index(Role::kHead)]->x, 0, 0.1) << is_first << t;
    }
  }
}

TEST(Streams, TwoBodiesThatExchangeTheirIdsAreReadOnAsTheSamePeople) {
  const BodyMotion one = Aside([](int t) { return 0.002 * t; }), other = Aside([](int) { return 0.45; });
  const auto with_id = [](const BodyMotion& motion, int id) {
    std::vector<std::string> bodies;
    const std::string text = AzureText(motion), begin = "{\"body_id\":1,";
    for (std::size_t at = 0; (at = text.find(begin, at)) != std::string::npos; at += begin.size()) {
      bodies.push_back(fmt::format("{{\"body_id\":{},", id) +
                       text.substr(at + begin.size(), text.find("}]", at) + 1 - at - begin.size()));
    }
    return bodies;
  };
  const auto a1 = with_id(one, 1), a2 = with_id(one, 2), b1 = with_id(other, 1), b2 = with_id(other, 2);
  ASSERT_EQ(a1.size(), 60u);
  std::string frames;
  for (std::size_t t = 0; t < 60; ++t) {
    const bool is_exchanged = t >= 20 && t < 45;
    frames += fmt::format("{}{{\"timestamp_usec\":{},\"bodies\":[{},{}]}}", t == 0 ? "" : ",", 33333 * t,
                          is_exchanged ? a2[t] : a1[t], is_exchanged ? b1[t] : b2[t]);
  }
  ASSERT_OK(read, ReadStreamRecording("{\"frames\":[" + frames + "]}", "s", {.body = 0}));
  EXPECT_THAT(read->remarks, Contains(StartsWith("two bodies exchange ids in frame 20")));
  for (std::size_t t = 0; t < 60; ++t) EXPECT_NEAR(read->frames[t].places[0]->x, one.poses[t].joints[0].x, 1e-5) << t;
}

TEST(Streams, OneIdOfTwoBodiesInAFrameIsTwoPeople) {
  const std::string text = NtuText(WavingMotion(4)), other = NtuText(Aside([](int) { return 1.2; }, 4));
  const auto bodies_of = [](const std::string& ntu) {
    std::vector<std::string> bodies;
    for (std::size_t at = 0; (at = ntu.find("7205", at)) != std::string::npos;) {
      const std::size_t end = ntu.find("\n1\n7205", at);
      bodies.push_back(ntu.substr(at, end == std::string::npos ? end : end + 1 - at));
      at = end == std::string::npos ? ntu.size() : end + 3;
    }
    return bodies;
  };
  const auto a = bodies_of(text), b = bodies_of(other);
  ASSERT_EQ(a.size(), 4u);
  const std::string both = "4\n1\n" + a[0] + "2\n" + b[1] + a[1] + "2\n" + a[2] + b[2] + "1\n" + a[3];
  ASSERT_OK(read, ReadStreamRecording(both, "s"));
  EXPECT_THAT(read->remarks, ElementsAre("several bodies of one frame have the id 72057594037931101 (first in frame "
                                         "1); Etude reads each of these bodies as the nearest body of the frames "
                                         "before",
                                         "the file has 2 bodies; Etude reads body 0, because it is in the most "
                                         "frames"));
  for (const RecordedFrame& frame : read->frames) EXPECT_NEAR(frame.places[0]->x, 0, 1e-9);
}

TEST(Streams, ConfidencesMayBeNames) {
  const auto read = [](const std::string& confidence) {
    return ReadStreamRecording(AzureText(WavingMotion(10), confidence), "s");
  };
  for (const auto& [name, number] : {std::pair("LOW", "1"), {"MEDIUM", "2"}, {"HIGH", "3"}}) {
    ASSERT_OK(named, read(fmt::format("\"K4ABT_JOINT_CONFIDENCE_{}\"", name)));
    ASSERT_OK(numbered, read(number));
    EXPECT_TRUE(named->records_states);
    for (std::size_t t = 0; t < 10; ++t) {
      EXPECT_EQ(named->frames[t].places, numbered->frames[t].places);
      EXPECT_EQ(named->frames[t].states, numbered->frames[t].states);
    }
  }
  EXPECT_EQ(ToString(read("\"none\"").error()), "s: no frame shows a body");
  EXPECT_EQ(ToString(read("\"sure\"").error()),
            "s: a body in frame 0 has the confidence level 'sure'; allowed: 0 to 3, or K4ABT_JOINT_CONFIDENCE_NONE, "
            "_LOW, _MEDIUM or _HIGH");
}

}  // namespace
}  // namespace etude
