// How texts of skeletons are interpreted: format, rate, level and floor, or the error message; read as a whole and
// live.
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "engine/base/angles.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/streams/labels.h"
#include "engine/streams/live_stream.h"
#include "sim/choreography/move.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/engine/streams/small_files.h"
#include "tests/support/kept_answers.h"
#include "tests/support/random_clip.h"

namespace etude {
namespace {

using testing::AllReplaced;
using testing::WithClock;

/// Returns a move danced in four places at slightly different heights, with noise.
BodyMotion RestlessMotion(const std::string& move, double spread) {
  testing::Dice dice(11);
  BodyMotion motion = LoadBuiltinMove(move).value().motion;
  const std::size_t frames = motion.poses.size();
  for (int place = 1; place < 4; ++place) {
    for (std::size_t f = 0; f < frames; ++f) {
      BodyPose pose = motion.poses[f];
      for (glm::dvec3& joint : pose.joints) joint += spread * glm::dvec3(place % 2, 0.01 * place, place / 2);
      motion.poses.push_back(pose);
    }
  }
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint += 0.0005 * dice.Vector();
  }
  return motion;
}

/// Describes a text read with these settings: the recording, its streams, and what LiveStream reads line by line.
void Tell(std::vector<std::string>& told, const std::string& text, const StreamReading& reading = {}) {
  const auto recording = ReadStreamRecording(text, "s", reading);
  if (!recording) told.push_back(ToString(recording.error()));
  if (recording) {
    told.push_back(fmt::format("{}, {} frames, the last of line {}{}{}{}, {:.3f} Hz, {:.3g} s, {:.3g} m",
                               StreamFormatName(recording->format), recording->frames.size(),
                               recording->frames.back().line, recording->records_states ? ", states" : "",
                               recording->records_times ? ", times" : "", recording->is_level ? ", level" : "",
                               recording->rate_hz, recording->seconds_per_count, recording->metres_per_unit));
    for (const std::string& remark : recording->remarks) told.push_back("  " + remark);
    for (const StreamOptions& options :
         {StreamOptions{}, StreamOptions{.levels = false, .reflects = true, .rate_hz = 25}}) {
      const auto made = MakeStream(*recording, "s", options);
      if (!made) told.push_back("  " + ToString(made.error()));
      if (!made) continue;
      glm::dvec3 head(0);
      for (const SensedFrame& frame : made->stream.frames) head += frame[Role::kHead].position;
      head /= static_cast<double>(made->stream.frames.size());
      told.push_back(fmt::format("  from {:.3f} s {} frames, {} lost, head {:.4f} {:.4f} {:.4f}, feet {:.3f}; {}",
                                 made->start_s, made->stream.frames.size(), made->lost_frames, head.x, head.y, head.z,
                                 LegsOf(made->stream).FeetForward().value_or(0), Describe(made->level)));
    }
  }
  LiveStream live("s", reading, {});
  std::vector<SensedFrame> frames;
  std::istringstream lines(text);
  Result<void> taken;
  for (std::string line; taken && std::getline(lines, line);) taken = live.Take(line, frames);
  if (taken) taken = live.Finish(frames);
  told.push_back(fmt::format("  live: {} frames{}", frames.size(), taken ? "" : "; " + ToString(taken.error())));
}

std::string WithLine(const std::string& text, int number,
                     const std::function<std::string(const std::string&)>& change) {
  std::istringstream lines(text);
  std::string changed;
  int at = 0;
  for (std::string line; std::getline(lines, line);) changed += ++at == number ? change(line) : line + "\n";
  return changed;
}

TEST(Streams, RowsOfNumbersAreUnderstoodAsTheyWere) {
  const BodyMotion wave = testing::WavingMotion(70), restless = RestlessMotion("aerobic", 0.4);
  const std::string rows = testing::KinectV1Text(wave, "", Radians(12));
  const std::string states = testing::KinectV1Text(wave, "2", 0.1);
  std::vector<std::string> told;
  for (const std::string& text :
       {rows, states, AllReplaced(states, " 2 ", " 1 "), testing::KinectV1Text(wave, "1.5"),
        testing::KinectV1Text(restless, "", Radians(7)), testing::KinectV1Text(restless, "", Radians(29)),
        testing::KinectV1Text(restless, "", Radians(31)), testing::KinectV1Text(RestlessMotion("jump", 0.19)),
        testing::KinectV1Text(RestlessMotion("side_kick", 2))}) {
    Tell(told, text);
  }
  for (const auto& [begin, step] : {std::pair(5, 0.04),
                                    {100, 1.0},
                                    {100, 2.0},
                                    {100, 15.0},
                                    {100, 16.0},
                                    {100, 33.3},
                                    {0, 4.5},
                                    {0, 5.5},
                                    {0, 1000.0},
                                    {0, 33333.0},
                                    {0, 2e6},
                                    {9, 0.0},
                                    {9, -1.0}}) {
    Tell(told, WithClock(rows, begin, step));
  }
  const std::string clocked = WithClock(rows, 5, 0.04), first = rows.substr(0, rows.find('\n') + 1);
  for (const std::string& text :
       {AllReplaced(rows, "0.", "1000."), AllReplaced(rows, " ", "  "), AllReplaced(rows, " ", "\t"),
        AllReplaced(rows, " ", ";"), WithLine(rows, 9, [](const std::string&) { return "# a remark\n\n"; }),
        WithLine(rows, 40, [](const std::string& line) { return line + " 3\n"; }),
        WithLine(rows, 41, [](const std::string& line) { return "x" + line + "\n"; }),
        WithLine(rows, 7, [](const std::string& line) { return "nan" + line.substr(line.find(' ')) + "\n"; }),
        WithLine(rows, 50, [](const std::string& line) { return "900" + line.substr(line.find(' ')) + "\n"; }),
        clocked + "100 " + first, clocked + "10000 " + first,
        WithLine(clocked, 30, [](const std::string&) { return ""; }),
        WithLine(clocked, 31, [](const std::string& line) { return "nan" + line.substr(4) + "\n"; }), first,
        std::string(), std::string("word\n1 2 3\n"), std::string("\n\n")}) {
    Tell(told, text);
  }
  Tell(told, clocked, {.rate_hz = 50});
  Tell(told, rows, {.format = StreamFormat::kKinectV2});
  Tell(told, rows, {.format = StreamFormat::kEtudeCsv});
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/streams/rows.txt"));
}

TEST(Streams, FilesThatSayMoreAreUnderstoodAsTheyWere) {
  BodyMotion motion = RestlessMotion("boxing", 0.5);
  motion.poses.resize(80);
  const BodyMotion wave = testing::WavingMotion(40);
  const std::string csv = WriteJointCsv(motion), trc = WriteTrc(motion, "a");
  const std::string ntu = testing::NtuText(wave), azure = testing::AzureText(wave, "2");
  std::vector<std::string> told;
  for (const std::string& text :
       {csv,
        AllReplaced(csv, "time_s", "time"),
        AllReplaced(csv, "left_foot_x_m", "left_foot_q_m"),
        WithLine(csv, 12, [](const std::string& line) { return AllReplaced(line, ",0.", ",nan,"); }),
        WithLine(csv, 40, [](const std::string& line) { return line.substr(0, line.rfind(',')) + ",\n"; }),
        trc,
        AllReplaced(trc, "left_foot", "leftest"),
        AllReplaced(trc, "\thead\t", "\tskull\t"),
        testing::KinectV2Text(wave, "", 100),
        testing::KinectV2Text(wave, " 0 0 0 1", 1),
        testing::KinectV2Text(wave, " 2", 1000),
        testing::KinectV2Text(wave, " 1", 40),
        ntu,
        testing::NtuText(wave, 1),
        testing::NtuText(wave, 0),
        testing::NtuText(wave, 2, 7),
        AllReplaced(ntu, "\n25\n", "\n24\n"),
        AllReplaced(ntu, "40\n1\n", "40\n101\n"),
        ntu.substr(0, 9000),
        AllReplaced(ntu, "40\n1\n", "40.5\n1\n"),
        azure,
        testing::AzureText(wave),
        testing::AzureText(wave, "1"),
        testing::AzureText(wave, "0"),
        AllReplaced(azure, "timestamp_usec", "stamp"),
        azure.substr(0, 5000),
        AllReplaced(azure, "\"bodies\":[", "\"people\":["),
        AllReplaced(azure, "joint_positions", "joints"),
        AllReplaced(azure, "confidence_level", "joint_confidence"),
        AllReplaced(azure, "\"frames\"", "\"frame\""),
        std::string("{\"frames\":[]}"),
        std::string("{\"frames\":[3]}"),
        std::string("PathFileType\t4\n")}) {
    Tell(told, text);
  }
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/streams/files.txt"));
}

/// A body that stands at `place` in the frames from `first` to `last`.
struct ComingBody {
  int id, first, last;
  glm::dvec3 place;
};
/// Returns a recording of these bodies in NTU's text format.
std::string CrowdText(const std::vector<ComingBody>& bodies, int frames) {
  std::string text = fmt::format("{}\n", frames);
  for (int f = 0; f < frames; ++f) {
    std::string told;
    int count = 0;
    for (const ComingBody& body : bodies) {
      if (f < body.first || f > body.last) continue;
      ++count;
      told += fmt::format("{} 0 1 1 1 1 0 0 0 2\n25\n", body.id);
      for (const glm::dvec3& p : testing::KinectV2Joints(testing::StandingPose(0.01 * f * body.id))) {
        const glm::dvec3 at = p + body.place;
        told += fmt::format("{} {} {} 0 0 0 0 0 0 0 1 {}\n", at.x, at.y, at.z,
                            f % 9 == body.id                      ? 1
                            : (f + body.id) % 7 == 0 && p.y > 0.4 ? 0
                                                                  : 2);
      }
    }
    text += fmt::format("{}\n{}", count, told);
  }
  return text;
}

TEST(Streams, SeveralBodiesAreUnderstoodAsTheyWere) {
  const std::vector<std::vector<ComingBody>> crowds = {
      {{1, 0, 30, {}}, {2, 0, 40, {1, 0, 0}}, {3, 35, 60, {0.1, 0, 0}}},
      {{1, 0, 30, {}}, {2, 61, 90, {0.1, 0, 0}}},
      {{1, 0, 30, {}}, {2, 60, 90, {0.1, 0, 0}}},
      {{1, 0, 30, {}}, {2, 40, 70, {0.22, 0, 0}}, {3, 41, 80, {-0.2, 0, 0}}},
      {{1, 0, 30, {}}, {2, 40, 70, {0.24, 0, 0}}},
      {{1, 0, 20, {}}, {2, 5, 22, {0.1, 0, 0.1}}, {3, 25, 45, {}}, {4, 26, 45, {0.05, 0, 0}}, {5, 50, 80, {}}},
      {{4, 0, 29, {2, 0, 0}}, {7, 0, 29, {}}},
      {{7, 0, 29, {2, 0, 0}}, {4, 0, 29, {}}},
      {{1, 10, 10, {}}}};
  std::vector<std::string> told;
  for (const std::vector<ComingBody>& crowd : crowds) {
    for (const std::optional<int> body : {std::optional<int>(), std::optional(0), std::optional(1), std::optional(2)}) {
      Tell(told, CrowdText(crowd, 95), {.body = body});
      if (!body) Tell(told, CrowdText(crowd, 95), {.rate_hz = 28});
    }
  }
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/streams/several_bodies.txt"));
}

TEST(Streams, LevelsThatAreHardToTellAreAsTheyWere) {
  std::vector<std::string> told;
  testing::Dice dice(12);
  for (int i = 0; i < 60; ++i) {
    const double spread = 0.12 * (i % 5), tilt = Radians(4.0 * (i % 10)), bumps = 0.015 * (i % 4);
    const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(tilt, glm::normalize(dice.Vector())));
    std::vector<RecordedFrame> frames;
    for (int f = 0; f < 15 + i; ++f) {
      RecordedFrame& frame = frames.emplace_back();
      const glm::dvec3 place(spread * (f / 10 % 2), bumps * (f / 10 % 3), 1.3 * spread * (f / 20 % 2));
      for (const Role role : AllRoles()) {
        frame.places[Index(role)] = turn * (testing::StandingPose()[role] + place) + 0.001 * dice.Vector();
        if (dice.Below(12) == 0) frame.states[Index(role)] = TrackingState::kInferred;
        if (dice.Below(15) == 0) frame.places[Index(role)].reset();
      }
    }
    const StreamLevel level = EstimateLevel(frames, i % 3 == 0 ? 30 : 15);
    told.push_back(fmt::format("{}; {:.5f} m, {:.4f}°", Describe(level), level.floor_m, level.tilt_deg));
  }
  told.push_back(Describe(EstimateLevel({}, 30)));
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/streams/levels.txt"));
}

TEST(Labels, AreUnderstoodAsTheyWere) {
  const std::string heading = "clip,from_s,to_s,move,truth,person\n";
  std::vector<std::string> told;
  const std::string long_name(200, 'a');
  std::vector<std::string> texts = {
      heading + "seq-1,0.5,3.1,arms-open,right,anna\n# x\n\nseq-2,,,clap,late,\nseq-3 , 4 ,,clap,right\n",
      "\xEF\xBB\xBF" + heading + "a,1,2,b,right,c\r\n", "move,clip,truth,from_s,to_s\nb,a,late,1,2\n", heading, ""};
  for (const std::string& row :
       testing::Parts("a,2,1,b,right,c^a,nan,2,b,right,c^a,0,1,b^a,2,2,b,right,c^a,,2,b,right,c^a,x,2,b,right,c^,1,2,b,"
                      "right,c^a,1,2,,right,c^a,1,2,b,,c^a,1,2e12,b,right,c^"
                      "a,1,1e12,b,right,c^a,1,2,b\"b,right,c^" +
                      long_name + ",1,2,b,right,c^a" + long_name + ",1,2,b,right,c")) {
    texts.push_back(heading + row + "\n");
  }
  for (const std::string& text :
       testing::Parts("clip,move,truth\na,b,right^clip,from_s,to_s,move\na,1,2,b^clip,form_s,to_s,move,truth^XQPCTick;"
                      "Tag\n1234567890;G1 "
                      "lift\n2234567890; G2^"
                      "XQPCTick;Tag\n12^XQPCTick;Tag\n1;2;3^XQPCTick;Tag\nx;G^XQPCTick;Tag\n2e19;G^XQPCTick;Tag\n5;^"
                      "s01_e01\nwalk: 252 390\nsitDown: NaN NaN\n s02_e03\nstandUp: 5 6^s01_e01\nwalk: 390 390^"
                      "s01_e01\nwalk 2 3^s01_e01\nwalk: 2^s01_e01\nwalk: 2 x^s01_e01\n: 2 3^s01_e0x\nwalk: 2 3")) {
    texts.push_back(text + "\n");
  }
  for (const std::string& text : texts) {
    const auto labels = ReadLabels(text, "l", "take");
    if (!labels) told.push_back(ToString(labels.error()));
    for (const Label& label : labels.value_or(std::vector<Label>())) {
      told.push_back(fmt::format("line {}: '{}' {} to {}{}, '{}', '{}' by '{}'{}{}", label.line, label.clip,
                                 label.from_s.value_or(-1), label.to_s.value_or(-1),
                                 label.by_own_clock ? " by its own clock" : "", label.move, label.fault, label.person,
                                 label.IsRight() ? ", right" : "", label.IsActionPoint() ? ", an action point" : ""));
      for (const char* name : {"take", "a", "joints_s01_e01.txt", "s02_e03", "seq-1", "seq-11"}) {
        if (IsLabelOf(label, name)) told.push_back(std::string("  of ") + name);
      }
    }
  }
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/streams/labels.txt"));
}

}  // namespace
}  // namespace etude
