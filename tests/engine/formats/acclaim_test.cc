#include "engine/formats/acclaim.h"

#include <gtest/gtest.h>

#include "tests/support/results.h"

namespace etude {
namespace {

// An arm of two bones along X, given in axes turned by 90° about Z, and a bone without channels.
constexpr const char* kSkeleton = R"(# a remark
:version 1.10
:name VICON
:units
  length 0.45
  angle deg
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 1 0
   orientation 0 0 0
:bonedata
  begin
    id 1
    name upper
    direction 1 0 0
    length 2
    axis 0 0 90 XYZ
    dof rx ry rz
    limits (-160 20)
           (-70 70)
  end
  begin
    name lower
    direction 1 0 0
    length 3
    axis 0 0 0 XYZ
  end
:hierarchy
  begin
    root upper
    upper lower
  end
)";

std::vector<GlobalTransform> AcclaimGlobals(const Clip& clip, std::size_t frame) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames[frame], globals);
  return globals;
}

void ExpectAcclaimNear(const glm::dvec3& found, const glm::dvec3& wanted) {
  EXPECT_LT(glm::distance(found, wanted), 1e-12) << found.x << " " << found.y << " " << found.z;
}

TEST(Acclaim, TurnsBonesInTheirOwnAxes) {
  ASSERT_OK(skeleton, ReadAcclaimSkeleton(kSkeleton, "a.asf"));
  // A turn about the bone's X, which is the world's Y: the arm swings level from X to −Z.
  const char* motion =
      "#!OML\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot 5 0 0 0 0 0\nupper 90 0 0\n2\nroot 0 0 0 0 0 90\nupper 0 0 0\n";
  ASSERT_TRUE(IsAcclaimMotion(motion));
  ASSERT_OK(clip, ReadAcclaimMotion(motion, *skeleton, "a.amc"));
  ASSERT_EQ(clip->frames.size(), 2u);
  EXPECT_EQ(clip->rate_hz, 120);
  const int lower = clip->skeleton.Find("lower"), end = clip->skeleton.Find("lower_end");
  ASSERT_TRUE(lower > 0 && end > 0 && clip->skeleton.joints[end].is_end_site);
  ExpectAcclaimNear(AcclaimGlobals(*clip, 0)[lower].position, {5, 1, -2});
  ExpectAcclaimNear(AcclaimGlobals(*clip, 0)[end].position, {5, 1, -5});
  ExpectAcclaimNear(AcclaimGlobals(*clip, 1)[end].position, {0, 6, 0});  // the root turned everything about Z
}

TEST(Acclaim, AnglesThatAreImpossibleInTheStatedUnitAreTakenInTheOtherOrSaid) {
  const std::string frames = "1\nroot 5 0 0 0 0 0\nupper 90 0 0\n", degrees = kSkeleton;
  std::string radians = degrees;
  radians.replace(radians.find("angle deg"), 9, "angle rad");
  ASSERT_OK(wanted, ReadAcclaimMotion(frames, *ReadAcclaimSkeleton(degrees, "a.asf"), "a.amc"));
  // A skeleton or a motion that states radians, but has degrees.
  for (const auto& [asf, head] : {std::pair(radians, ""), {radians, ":DEGREES\n"}, {degrees, ":RADIANS\n"}}) {
    AcclaimFacts facts;
    ASSERT_OK(skeleton, ReadAcclaimSkeleton(asf, "a.asf"));
    ASSERT_OK(clip, ReadAcclaimMotion(head + frames, *skeleton, "a.amc", &facts));
    const std::vector<std::string>& remarks = facts.remarks;
    EXPECT_EQ(clip->frames, wanted->frames);
    ASSERT_EQ(remarks.size(), 1u);
    EXPECT_NE(remarks[0].find("reads its angles as degrees"), std::string::npos);
  }
  // Radians that are called degrees could be a nearly still body, so the reader only remarks on them.
  const auto said = [&](const std::string& motion) {
    AcclaimFacts facts;
    EXPECT_TRUE(ReadAcclaimMotion(motion, *ReadAcclaimSkeleton(degrees, "a.asf"), "a.amc", &facts));
    return facts.remarks.empty() ? "" : facts.remarks[0];
  };
  EXPECT_EQ(said("1\nroot 5 0 0 0 0 0\nupper 1.6 0 0\n"),
            "no angle is larger than 1.6 degrees; if the file's angles are radians, add the line :RADIANS to the file");
  EXPECT_EQ(said(frames), "");
  EXPECT_EQ(said("1\nroot 5 0 0 0 0 0\nupper 0 0 0\n"), "");
}

TEST(Acclaim, ARootThatTurnsOnAndOnMayBeInRadians) {
  const std::string degrees = "1\nroot 0 0 0 0 1080 0\nupper 90 0 0\n", radians =
      ":RADIANS\n1\nroot 0 0 0 0 18.8495559215388 0\nupper 1.5707963267949 0 0\n";
  ASSERT_OK(skeleton, ReadAcclaimSkeleton(kSkeleton, "a.asf"));
  AcclaimFacts facts;
  ASSERT_OK(wanted, ReadAcclaimMotion(degrees, *skeleton, "a.amc"));
  ASSERT_OK(clip, ReadAcclaimMotion(radians, *skeleton, "a.amc", &facts));
  const std::vector<std::string>& remarks = facts.remarks;
  const int end = clip->skeleton.Find("lower_end");
  ExpectAcclaimNear(AcclaimGlobals(*clip, 0)[end].position, AcclaimGlobals(*wanted, 0)[end].position);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0],
            "the root turns by 18.85 radians; if the file's angles are degrees, add the line :DEGREES to the file");
}

TEST(Acclaim, ABoneWithoutValuesIsRefusedOrSaid) {
  ASSERT_OK(skeleton, ReadAcclaimSkeleton(kSkeleton, "a.asf"));
  const std::string head = ":DEGREES\n1\nroot 0 0 0 0 0 0\n", second = "2\nroot 0 0 0 0 0 0\n", arm = "upper 90 0 0\n";
  const auto refusal = [&](const std::string& text) {
    return testing::Refusal(ReadAcclaimMotion(text, *skeleton, "a.amc"));
  };
  EXPECT_EQ(refusal(head + arm + second),
            "a.amc: bone 'upper' is missing in the last frame or frames; allowed: each bone once in each frame");
  const char* const once =
      "bone 'upper' appears twice in this frame, or is missing in an earlier frame; allowed: each bone once in each "
      "frame";
  EXPECT_EQ(refusal(head + second + arm), std::string("a.amc:6:1: ") + once);
  EXPECT_EQ(refusal(head + arm + arm), std::string("a.amc:5:1: ") + once);
  AcclaimFacts facts;
  EXPECT_TRUE(ReadAcclaimMotion(head + second, *skeleton, "a.amc", &facts));
  EXPECT_EQ(facts.remarks, std::vector<std::string>{"bones without values, which keep their rest pose: upper"});
}

TEST(Acclaim, AMotionMayStateItsRateAndNameOtherFilesInAnyCaseAndOrder) {
  ASSERT_OK(skeleton, ReadAcclaimSkeleton(kSkeleton, "a.asf"));
  const std::string frames = "1\nroot 5 0 0 0 0 0\nupper 90 0 0\n";
  ASSERT_OK(wanted, ReadAcclaimMotion(":DEGREES\n" + frames, *skeleton, "a.amc"));
  for (const std::string& head :
       {std::string(":SAMPLES-PER-SECOND 60\n:FULLY-SPECIFIED\n:DEGREES\n"),
        std::string("# written by hand\n:fully-specified\n:degrees\n:samples-per-second 60\n"),
        std::string(":asf-file a.asf\n:samples-per-second 60\n:Degrees\n")}) {
    SCOPED_TRACE(head);
    AcclaimFacts facts;
    ASSERT_TRUE(IsAcclaimMotion(head + frames));
    ASSERT_OK(clip, ReadAcclaimMotion(head + frames, *skeleton, "a.amc", &facts));
    EXPECT_EQ(clip->rate_hz, 60);
    EXPECT_TRUE(facts.has_rate);
    EXPECT_EQ(clip->frames, wanted->frames);
    const bool names_file = head.starts_with(":asf");
    EXPECT_EQ(facts.remarks, names_file ? std::vector<std::string>{"not used: :asf-file"} : std::vector<std::string>());
  }
  // Controls: a motion without a rate, skeletons, and a rate that is none.
  AcclaimFacts facts;
  EXPECT_TRUE(ReadAcclaimMotion(":DEGREES\n" + frames, *skeleton, "a.amc", &facts));
  EXPECT_FALSE(facts.has_rate);
  EXPECT_FALSE(IsAcclaimMotion(kSkeleton));
  EXPECT_FALSE(IsAcclaimMotion(":version 1.10\n:name x\n"));
  EXPECT_EQ(testing::Refusal(ReadAcclaimMotion(":SAMPLES-PER-SECOND 0\n" + frames, *skeleton, "a.amc")),
            "a.amc:1:21: the rate is 0 Hz; allowed: 0.1 to 10000 Hz");
}

TEST(Acclaim, RefusesWhatHasNoBones) {
  EXPECT_EQ(testing::Refusal(ReadAcclaimSkeleton("", "a.asf")),
            "a.asf: found no bones; allowed: an Acclaim skeleton with :root and :bonedata");
}

}  // namespace
}  // namespace etude
