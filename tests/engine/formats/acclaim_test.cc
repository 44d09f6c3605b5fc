#include "engine/formats/acclaim.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using ::testing::HasSubstr;

// An arm of two bones along X, told in axes turned by 90° about Z; and a bone without channels.
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

std::string AcclaimComplaint(const std::string& skeleton) {
  const auto read = ReadAcclaimSkeleton(skeleton, "a.asf");
  return read ? "(read)" : ToString(read.error());
}

std::string Without(const std::string& part, const std::string& instead) {
  std::string text = kSkeleton;
  return text.replace(text.find(part), part.size(), instead);
}

std::vector<GlobalTransform> AcclaimGlobals(const Clip& clip, std::size_t frame) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames[frame], globals);
  return globals;
}

void ExpectAcclaimNear(const glm::dvec3& found, const glm::dvec3& wanted) {
  EXPECT_LT(glm::distance(found, wanted), 1e-12) << found.x << " " << found.y << " " << found.z;
}

TEST(Acclaim, TurnsBonesInTheirOwnAxes) {
  const auto skeleton = ReadAcclaimSkeleton(kSkeleton, "a.asf");
  ASSERT_TRUE(skeleton) << ToString(skeleton.error());
  // Turns about the bone's own X, which is the world's Y: the arm swings level, from X to −Z.
  const char* motion =
      "#!OML\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot 5 0 0 0 0 0\nupper 90 0 0\n2\nroot 0 0 0 0 0 90\nupper 0 0 0\n";
  ASSERT_TRUE(IsAcclaimMotion(motion));
  const auto clip = ReadAcclaimMotion(motion, *skeleton, "a.amc");
  ASSERT_TRUE(clip) << ToString(clip.error());
  ASSERT_EQ(clip->frames.size(), 2u);
  EXPECT_EQ(clip->rate_hz, 120);
  const int lower = clip->skeleton.Find("lower"), end = clip->skeleton.Find("lower_end");
  ASSERT_TRUE(lower > 0 && end > 0 && clip->skeleton.joints[end].is_end_site);
  ExpectAcclaimNear(AcclaimGlobals(*clip, 0)[lower].position, {5, 1, -2});
  ExpectAcclaimNear(AcclaimGlobals(*clip, 0)[end].position, {5, 1, -5});
  ExpectAcclaimNear(AcclaimGlobals(*clip, 1)[end].position, {0, 6, 0});  // the root turned all of it about Z
}

TEST(Acclaim, RefusesWhatIsNoneByItsPlace) {
  EXPECT_EQ(AcclaimComplaint(""), "a.asf: no bones; allowed: an Acclaim skeleton with :root and :bonedata");
  EXPECT_THAT(AcclaimComplaint(Without("dof rx ry rz", "dof rx l")),
              HasSubstr("a.asf:19:12: channel 'l'; allowed: rx"));
  EXPECT_THAT(AcclaimComplaint(Without("axis 0 0 90 XYZ", "axis 0 0 90 XQZ")), HasSubstr("a.asf:18:17: axes 'XQZ'"));
  EXPECT_THAT(AcclaimComplaint(Without("    name lower", "    name upper")),
              HasSubstr("the bone 'upper' appears twice here"));
  EXPECT_THAT(AcclaimComplaint(Without("    upper lower\n", "")), HasSubstr("the bone 'lower' has no parent"));
  EXPECT_THAT(AcclaimComplaint(Without("root upper", "root upper upper")), HasSubstr("already has a parent"));
  EXPECT_THAT(AcclaimComplaint(Without("root upper", "root arm")), HasSubstr("there is no bone 'arm'"));
  EXPECT_THAT(AcclaimComplaint(Without("length 2", "length nan")), HasSubstr("a.asf:17:12: "));
  EXPECT_THAT(AcclaimComplaint(Without("direction 1 0 0", "direction 1 0")), HasSubstr("a number is missing"));
  const auto skeleton = ReadAcclaimSkeleton(kSkeleton, "a.asf");
  ASSERT_TRUE(skeleton);
  for (const auto& [motion, complaint] : std::vector<std::pair<std::string, std::string>>{
           {":DEGREES\n", "a.amc: no frames"},
           {":DEGREES\n1\nroot 1 2 3 4 5\n", "a.amc:3:1: 5 numbers of bone 'root'; allowed: 6"},
           {":DEGREES\n1\nleg 3\n", "a.amc:3:1: the skeleton has no bone 'leg'"},
           {":DEGREES\nupper 1 2 3\n", "a.amc:2:1: a bone precedes the first frame's number"},
           {":DEGREES\n1\nupper 1 2 3\n3\n", "a.amc:4:1: frame 3 after frame 1; allowed: the next one"},
           {":DEGREES\n1\nupper 1 2 1e99\n", "a.amc:3:11: "}}) {
    const auto clip = ReadAcclaimMotion(motion, *skeleton, "a.amc");
    ASSERT_FALSE(clip) << motion;
    EXPECT_THAT(ToString(clip.error()), HasSubstr(complaint));
  }
}

}  // namespace
}  // namespace etude
