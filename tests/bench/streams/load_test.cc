#include "bench/streams/load.h"

#include <gtest/gtest.h>

#include "bench/files/files.h"
#include "bench/files/temporary_folder.h"
#include "bench/streams/teach.h"
#include "engine/formats/joint_csv.h"

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
  ASSERT_EQ(parts->size(), 2u);  // of c there is no recording
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
            "l:3: from 2.000 to 9.000 s of a; allowed: its 3.000 s");
  const auto other = ReadLabels("clip,from_s,to_s,move,truth\nz,1,2,m,right\n", "l");
  EXPECT_EQ(ToString(MatchLabels(*other, "l", TwoStreams()).error()),
            "l: none of the labels is of a recording here, such as a");
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
  EXPECT_EQ(parts[0].begin, 40);  // two seconds before
  EXPECT_EQ(parts[0].end, 116);   // half-way to the next
  EXPECT_EQ(parts[1].begin, 115);
  EXPECT_EQ(parts[1].end, 161);  // one second after
  EXPECT_EQ(parts[2].begin, 240);
}

TEST(LoadStreams, AFolderPassesOverWhatIsNoneAndTellsWhatIsBroken) {
  const auto folder = TemporaryFolder::Make("streams");
  ASSERT_TRUE(folder);
  BodyMotion motion;
  motion.poses.push_back(BodyPose{});
  for (const Role role : AllRoles()) motion.poses[0][role] = glm::dvec3(0, 0.1 * static_cast<double>(Index(role)), 0);
  const std::filesystem::path root = folder->path();
  ASSERT_TRUE(WriteFileAtomically(root / "deep/good.csv", WriteJointCsv(motion)));
  ASSERT_TRUE(WriteFileAtomically(root / "readme.txt", "words\n"));
  ASSERT_TRUE(WriteFileAtomically(root / "broken.csv", "head_x_m,head_y_m,head_z_m\n1,2,3\n"));
  const auto loaded = LoadStreams({root.string()}, {}, {});
  ASSERT_TRUE(loaded) << ToString(loaded.error());
  ASSERT_EQ(loaded->streams.size(), 1u);
  EXPECT_EQ(loaded->streams[0].name, "good");
  EXPECT_EQ(loaded->passed_over, 1);
  EXPECT_EQ(loaded->refused.size(), 1u);
  EXPECT_FALSE(LoadStreams({(root / "broken.csv").string()}, {}, {}));
}

}  // namespace
}  // namespace etude
