#include "io/streams/load.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/joint_csv.h"
#include "engine/motion/edit.h"
#include "engine/teaching/teach_moves.h"
#include "io/clips/clip_library.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "sim/choreography/move.h"
#include "tests/engine/streams/small_files.h"
#include "tests/support/results.h"

namespace etude {
namespace {

TEST(PersonInName, KnowsTheSetsNames) {
  EXPECT_EQ(PersonInName("S001C002P003R002A013"), "P003");
  EXPECT_EQ(PersonInName("P1_1_10A_p06"), "p06");
  EXPECT_EQ(PersonInName("joints_s01_e02"), "s01");
  EXPECT_EQ(PersonInName("G3-Kinect-CTK-P1T1-Unknown-C-0"), "");
}

std::vector<NamedStream> TwoStreams() {
  std::vector<NamedStream> streams(2);
  streams[0].name = "a";
  streams[0].person = "from-name";
  streams[1].name = "b";
  streams[1].start_s = 100;
  for (NamedStream& stream : streams) stream.stream.frames.resize(90);
  return streams;
}

TEST(MatchLabels, CutsByTimeAndShiftsClocks) {
  const auto labels =
      ReadLabels("clip,from_s,to_s,move,truth,person\na,1,2,m,right,\na,,,m,half,x\nc,1,2,m,right,\n", "l");
  auto parts = MatchLabels(*labels, "l", TwoStreams());
  ASSERT_TRUE(parts) << ToString(parts.error());
  ASSERT_EQ(parts->size(), 2u);  // c has no recording
  EXPECT_EQ((*parts)[0].fault, "half");
  EXPECT_EQ((*parts)[0].end, 90);
  EXPECT_EQ((*parts)[0].person, "x");
  EXPECT_EQ((*parts)[1].begin, 30);
  EXPECT_EQ((*parts)[1].end, 60);
  EXPECT_EQ((*parts)[1].person, "from-name");
  std::vector<Label> tags = {{.clip = "b", .from_s = 101.0, .to_s = {}, .move = "m", .fault = "", .person = ""}};
  tags[0].by_own_clock = true;
  parts = MatchLabels(tags, "l", TwoStreams());
  ASSERT_TRUE(parts);
  EXPECT_TRUE((*parts)[0].is_action_point);
  EXPECT_EQ((*parts)[0].begin, 30);
}

TEST(MatchLabels, RefusesTimesOutsideAndLabelsOfNothing) {
  const auto late = ReadLabels("clip,from_s,to_s,move,truth\na,1,2,m,right\na,2,9,m,right\n", "l");
  EXPECT_EQ(ToString(MatchLabels(*late, "l", TwoStreams()).error()),
            "l:3: found a label from 2.000 to 9.000 s of a; allowed: labels within the recording, which lasts 3.000 s");
  // No frame lies in these: the last frame is at 2.967 s.
  for (const auto& [times, told] : {std::pair("3,3.4", "from 3.000 to 3.400 s"),
                                    {"3.2,3.4", "from 3.200 to 3.400 s"},
                                    {"-0.4,0", "from -0.400 to 0.000 s"},
                                    {"3,", "at 3.000 s"}}) {
    const auto beyond = ReadLabels(fmt::format("clip,from_s,to_s,move,truth\na,{},m,right\n", times), "l");
    EXPECT_EQ(
        testing::Refusal(MatchLabels(*beyond, "l", TwoStreams())),
        fmt::format("l:2: found a label {} of a; allowed: labels within the recording, which lasts 3.000 s", told));
  }
  for (const char* times : {"2.99,3.4", "-0.4,0.01", "0,3", "2.99,"}) {
    const auto within = ReadLabels(fmt::format("clip,from_s,to_s,move,truth\na,{},m,right\n", times), "l");
    EXPECT_TRUE(MatchLabels(*within, "l", TwoStreams())) << times;
  }
  const auto other = ReadLabels("clip,from_s,to_s,move,truth\nz,1,2,m,right\n", "l");
  EXPECT_EQ(ToString(MatchLabels(*other, "l", TwoStreams()).error()),
            "l: no label belongs to any of the given recordings, such as a");
}

TEST(MatchLabels, RefusesTwoLabelsOfOnePerformance) {
  const auto match = [](const std::string& rows) {
    return MatchLabels(*ReadLabels("clip,from_s,to_s,move,truth\n" + rows, "l"), "l", TwoStreams());
  };
  EXPECT_EQ(ToString(match("a,1,2,m,right\nb,1,2,m,right\na,1.2,2.1,m,half\n").error()),
            "l:4: line 2 already labels this performance of m (a, at 1.200 s); allowed: one label for each "
            "performance");
  EXPECT_TRUE(match("a,1,2,m,right\na,1.6,2.6,m,half\n")) << "less than half of each performance is common";
  EXPECT_TRUE(match("a,1,2,m,right\na,1,2,n,right\n")) << "another move may be performed at the same time";
}

TEST(MatchLabels, OneLabelBelongsToOneRecording) {
  std::vector<NamedStream> streams = TwoStreams();
  for (NamedStream& stream : streams) stream.name = "take1";
  streams[0].source = "takes/anna/take1.csv";
  streams[1].source = "takes/bo/take1.trc";
  const auto match = [&](const std::string& clip) {
    return MatchLabels(*ReadLabels("clip,from_s,to_s,move,truth\n" + clip + ",1,2,m,right\n", "l"), "l", streams);
  };
  EXPECT_EQ(testing::Refusal(match("take1")),
            "l:2: the clip take1 can be takes/anna/take1.csv or takes/bo/take1.trc; allowed: a clip that names one "
            "recording, also by the end of its path");
  for (const char* clip : {"anna/take1", "anna\\take1.csv", "take1.csv", "takes/anna/take1"}) {
    ASSERT_OK(parts, match(clip));
    ASSERT_EQ(parts->size(), 1u) << clip;
    EXPECT_EQ(parts->front().stream, 0u) << clip;
  }
  for (const char* clip : {"a/take1", "ake1.csv", "take1.bvh", "anna"}) EXPECT_FALSE(match(clip)) << clip;
}

TEST(LabelStreams, NamesOfOnePersonMayDifferInCaseAndBlanks) {
  const std::string text = "clip,from_s,to_s,move,truth,person\na,1,2,m,right,Anna B\na,2,3,n,right,anna b\n";
  ASSERT_OK(all, LabelStreams(TwoStreams(), {{"l", text + "b,1,2,m,right,AnnaB\n"}}));
  ASSERT_EQ(all->people.size(), 1u);
  EXPECT_EQ(all->people[0].name, "Anna B");
  for (const LabelledPart& part : all->parts) EXPECT_EQ(part.person, "Anna B");
  ASSERT_OK(two, LabelStreams(TwoStreams(), {{"l", text + "b,1,2,m,right,anne b\n"}}));
  const std::string marks = "clip,from_s,to_s,move,truth,person\na,1,2,m,right,Zo\u00eb \u0160\nb,1,2,m,right,";
  ASSERT_OK(forms, LabelStreams(TwoStreams(), {{"l", marks + "Zoe\u0308 S\u030c\n"}}));
  EXPECT_EQ(forms->people.size(), 1u) << "Unicode's forms NFC and NFD";
  ASSERT_OK(others, LabelStreams(TwoStreams(), {{"l", marks + "Zoe\u0301 S\u030c\n"}}));
  EXPECT_EQ(others->people.size(), 2u);
  EXPECT_EQ(two->people.size(), 2u);
  EXPECT_EQ(DescribeLabels(*ReadLabels(text, "l"), "l", {TwoStreams()[0]}),
            std::vector<std::string>{"l:3: Etude reads Anna B and anna b as one person"});
}

TEST(DescribeLabels, AsksBackForWordsThatMayMeanRight) {
  const auto line = [](const std::string& truth) {
    const std::string rows = "a,0,1,m,right\nb,,,m," + truth + "\n";
    return DescribeLabels(*ReadLabels("clip,from_s,to_s,move,truth\n" + rows, "l"), "l", TwoStreams()).back();
  };
  for (const char* truth : {"correct", "TRUE", "1", "ok", "Yes", "Right", "rihgt"}) {
    EXPECT_EQ(line(truth),
              fmt::format("l: truth: right 1, {} 1 (Etude reads this as a fault; did you mean right?)", truth));
  }
  for (const char* truth : {"half", "incorrect", "0", "no", "late"}) {
    EXPECT_EQ(line(truth), fmt::format("l: truth: right 1, {} 1", truth));
  }
}

TEST(DescribeLabels, TellsWhatLabelsAndRecordingsDoNotShare) {
  std::vector<NamedStream> streams = TwoStreams();
  streams[0].name = "ah_clap1";
  streams[1].name = "ah_hammer1";
  const auto lines = [&](const std::string& rows) {
    return DescribeLabels(*ReadLabels("clip,from_s,to_s,move,truth\n" + rows, "l"), "l", streams);
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(lines("ah_clap1,,,clap,right\nah_hammer1,,,hammer,right\n"), Lines{});
  EXPECT_EQ(lines("zz,,,wave,right\nah_clap1,,,clap,right\nah_hamer1,,,hammer,right\n"),
            (Lines{"l:4: no recording ah_hamer1 is given; did you mean ah_hammer1?; Etude leaves out 2 labels without "
                   "a recording",
                   "l: no label for ah_hammer1; each move recognised there counts as a false alarm"}));
  EXPECT_EQ(lines("ah_clap1,,,clap,rihgt\nah_hammer1,,,hammer,right\nah_hammer1,1,2,hammer,half\nzz,,,wave,odd\n"),
            (Lines{"l:5: no recording zz is given",
                   "l: truth: right 1, half 1, rihgt 1 (Etude reads this as a fault; did you mean right?)"}));
}

TEST(DescribeLabels, DoubtsLabelsThatMayBeTimesOfTheRecordingsClock) {
  std::vector<NamedStream> streams = TwoStreams();  // each lasts 3 s
  streams[0].start_s = 1;
  const auto lines = [&](const std::string& rows) {
    return DescribeLabels(*ReadLabels("clip,from_s,to_s,move,truth\nb,0,1,m,right\n" + rows, "l"), "l", streams);
  };
  EXPECT_EQ(
      lines("a,1.5,2,m,right\na,2.2,3,m,right\n"),
      std::vector<std::string>{"l: doubtful: the clock of a begins at 1.000 s, and no label begins before this time. "
                               "Etude counts from_s and to_s from the first frame; if your labels use the recording's "
                               "clock, subtract 1.000 s"});
  EXPECT_TRUE(lines("a,0.5,1,m,right\na,2.2,3,m,right\n").empty()) << "the first label begins before the clock does";
}

TEST(DescribeLabels, DoubtsTwoMovesAtOneTimeAndNamesThatDifferInCase) {
  const auto lines = [&](const std::string& rows) {
    return DescribeLabels(*ReadLabels("clip,from_s,to_s,move,truth\nb,0,1,m,right\n" + rows, "l"), "l", TwoStreams());
  };
  using Lines = std::vector<std::string>;
  EXPECT_EQ(lines("a,1,2,m,right\na,1.2,2,n,right\n"),
            Lines{"l:4: doubtful: line 3 labels the same time of a as the move m, but this line labels it as n; Etude "
                  "uses both as right performances"});
  EXPECT_EQ(lines("a,1,2,M,right\n"),
            Lines{"l:3: doubtful: the names of the moves m and M differ only in capital letters; Etude reads them as "
                  "two moves"});
  EXPECT_EQ(lines("a,0,2,m,right\na,1.2,1.8,n,right\n"), Lines{}) << "a short move may be a part of a long one";
  EXPECT_EQ(lines("a,1,2,m,right\na,2,3,n,right\n"), Lines{});
}

TEST(LoadStreams, TimesOfAClipCountFromItsFilesFirstFrame) {
  ASSERT_OK(folder, TemporaryFolder::Make("hidden"));
  BodyMotion motion{.rate_hz = 30, .poses = {}};
  for (int t = 0; t < 120; ++t) motion.poses.push_back(testing::StandingPose(0.3 * std::sin(0.1 * t)));
  MarkerMotion markers = JointMarkers(motion, 5);
  for (std::size_t t = 0; t < 45; ++t) markers.frames[t][Index(Role::kLeftKnee)].reset();
  const std::string path = (std::filesystem::path(folder->path()) / "late.c3d").string();
  ASSERT_TRUE(WriteFileAtomically(path, WriteC3d(markers)));
  ASSERT_OK(loaded, LoadStream(path, {}, {}));
  const NamedStream& stream = loaded->front();
  EXPECT_NEAR(stream.start_s, 5, 1e-6);
  ASSERT_EQ(stream.stream.frames.size(), 120u);
  EXPECT_EQ(stream.motion->poses.size(), 120u);
  for (std::size_t t = 0; t < 120; ++t) EXPECT_EQ(stream.stream.frames[t].body_seen, t >= 45) << t;
  EXPECT_EQ(WholeStreams(*loaded).front().begin, 45);
}

TEST(PerformancesOf, AnActionPointIsTheTimeAroundIt) {
  std::vector<NamedStream> streams = TwoStreams();
  streams[0].stream.frames.resize(400);
  std::vector<LabelledPart> points(3);
  const int at[] = {100, 130, 300};
  for (std::size_t i = 0; i < 3; ++i)
    points[i] = {
        .stream = 0, .move = "m", .fault = "", .person = "", .begin = at[i], .end = at[i] + 1, .is_action_point = true};
  const auto parts = PerformancesOf(points, streams);
  EXPECT_EQ(parts[0].begin, 40);  // two seconds before the point
  EXPECT_EQ(parts[0].end, 116);   // half-way to the next point
  EXPECT_EQ(parts[1].begin, 115);
  EXPECT_EQ(parts[1].end, 161);  // one second after the point
  EXPECT_EQ(parts[2].begin, 240);
}

TEST(LoadStreams, AFolderPassesOverWhatIsNoneAndTellsWhatIsBroken) {
  ASSERT_OK(folder, TemporaryFolder::Make("streams"));
  BodyMotion motion;
  motion.poses.push_back(BodyPose{});
  for (const Role role : AllRoles()) motion.poses[0][role] = glm::dvec3(0, 0.1 * static_cast<double>(Index(role)), 0);
  const std::filesystem::path root = folder->path();
  ASSERT_TRUE(WriteFileAtomically(root / "deep/good.csv", WriteJointCsv(motion)));
  ASSERT_TRUE(WriteFileAtomically(root / "readme.txt", "words\n"));
  ASSERT_TRUE(WriteFileAtomically(root / "broken.csv", "head_x_m,head_y_m,head_z_m\n1,2,3\n"));
  ASSERT_OK(loaded, LoadStreams({root.string()}, {}, {}));
  ASSERT_EQ(loaded->streams.size(), 1u);
  EXPECT_EQ(loaded->streams[0].name, "good");
  EXPECT_EQ(loaded->passed_over, 1);
  EXPECT_EQ(loaded->refused.size(), 1u);
  EXPECT_FALSE(LoadStreams({(root / "broken.csv").string()}, {}, {}));
}

/// Returns a BVH as OpenNI's sensors give it, without fingers and toes, facing +Z; knees are `back` cm behind the line
/// from hip to ankle.
std::string OpenNiBvh(double back) {
  const std::string channels = "CHANNELS 3 Zrotation Xrotation Yrotation\n";
  const auto joint = [&](const std::string& name, double x, double y, double z, const std::string& children) {
    const std::string below = children.empty() ? "End Site\n{\nOFFSET 0 0 0\n}\n" : children;
    return fmt::format("JOINT {}\n{{\nOFFSET {} {} {}\n{}{}}}\n", name, x, y, z, channels, below);
  };
  const auto arm = [&](const std::string& side, double left, double up) {
    return joint(side + "_SHOULDER#", left * 15, up, 0,
                 joint(side + "_ELBOW", left * 28, 0, 0, joint(side + "_HAND", left * 25, 0, 0, "")));
  };
  const auto leg = [&](const std::string& side, double left, double down) {
    return joint(side + "_HIP#", left * 9, down, 0,
                 joint(side + "_KNEE", 0, -40, -back, joint(side + "_FOOT", 0, -40, back, "")));
  };
  const std::string root = arm("LEFT", 1, 28) + arm("RIGHT", -1, 28) + leg("LEFT", 1, -18) + leg("RIGHT", -1, -18) +
                           joint("NECK#", 0, 28, 0, joint("HEAD", 0, 23, 0, ""));
  const int joints = 14;
  std::string text =
      "HIERARCHY\nROOT TORSO#\n{\nOFFSET 0 98 0\nCHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation "
      "Yrotation\n" +
      root + "}\nMOTION\nFrames: 30\nFrame Time: 0.033333\n";
  for (int t = 0; t < 30; ++t) {
    text += "0 98 0 0 0 0";
    for (int value = 0; value < 3 * joints; ++value) text += fmt::format(" {}", value == 0 ? t : 0);  // first rotations
    text += '\n';
  }
  return text;
}

TEST(LoadStreams, SidesThatAreExchangedInAPartOfARecordingAreSaid) {
  ASSERT_OK(folder, TemporaryFolder::Make("sides"));
  ASSERT_OK(move, LoadBuiltinMove("boxing"));
  const auto description = [&](const BodyMotion& motion) {
    const std::string file = (std::filesystem::path(folder->path()) / "take.csv").string();
    EXPECT_TRUE(WriteFileAtomically(file, WriteJointCsv(motion)));
    const auto loaded = LoadStreams({file}, {}, {});
    return loaded ? loaded->streams.front().description : ToString(loaded.error());
  };
  EXPECT_EQ(description(move->motion).find("exchange"), std::string::npos) << description(move->motion);
  BodyMotion wrong = move->motion;
  for (std::size_t f = 20; f < 40; ++f) std::swap(wrong.poses[f][Role::kLeftKnee], wrong.poses[f][Role::kRightKnee]);
  EXPECT_NE(description(wrong).find("left and right exchange positions from one frame to the next, 2 times (first at "
                                    "0.67 s): left_knee – right_knee"),
            std::string::npos)
      << description(wrong);
}

TEST(LoadStreams, KneesThatASensorOverstretchesAreToldAndThoseThatBendBackwardsRefused) {
  ASSERT_OK(folder, TemporaryFolder::Make("openni"));
  const std::string path = (std::filesystem::path(folder->path()) / "wave.bvh").string();
  const auto load = [&](double back) {
    EXPECT_TRUE(WriteFileAtomically(path, OpenNiBvh(back)));
    return LoadStream(path, {}, {});
  };
  ASSERT_OK(straight, load(0));
  EXPECT_EQ(straight->front().description.find("overstretch"), std::string::npos);
  // 36 degrees is too much for a sensor's error.
  EXPECT_NE(testing::Refusal(load(13)).find("the knees bend backwards"), std::string::npos);
  ASSERT_OK(overstretched, load(4));
  EXPECT_EQ(overstretched->front().stream.frames.size(), 30u);
  EXPECT_NE(overstretched->front().description.find("the knees are overextended by 11° on average"), std::string::npos)
      << overstretched->front().description;
}

TEST(LoadStreams, ARecordingRootedAtTheHeadShowsTheSameBody) {
  ASSERT_OK(folder, TemporaryFolder::Make("head"));
  const auto load = [&](const std::string& text) {
    const std::string path = (std::filesystem::path(folder->path()) / "wave.bvh").string();
    EXPECT_TRUE(WriteFileAtomically(path, text));
    return LoadStream(path, {}, {});
  };
  ASSERT_OK(clip, ReadBvh(OpenNiBvh(0), "wave.bvh"));
  const Clip rooted_at_head = WithRootAt(*clip, clip->skeleton.Find("HEAD"));
  ASSERT_EQ(rooted_at_head.skeleton.joints[0].name, "HEAD");
  ASSERT_OK(by_torso, load(OpenNiBvh(0)));
  ASSERT_OK(by_head, load(WriteBvh(rooted_at_head)));
  const auto &expected = by_torso->front().stream.frames, &frames = by_head->front().stream.frames;
  ASSERT_EQ(frames.size(), expected.size());
  for (std::size_t t = 0; t < frames.size(); ++t) {
    for (const Role role : AllRoles()) {
      EXPECT_LT(glm::distance(frames[t][role].position, expected[t][role].position), 1e-5)
          << t << ' ' << RoleName(role);
    }
  }
}

}  // namespace
}  // namespace etude
