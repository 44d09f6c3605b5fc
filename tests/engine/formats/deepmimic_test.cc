#include "engine/formats/deepmimic.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "engine/base/angles.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/to_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::vector<double> Standing(double duration = 0.04) {
  std::vector<double> frame = {duration, 0.5, 0.9, -0.25};
  const auto add = [&](std::initializer_list<double> numbers) { frame.insert(frame.end(), numbers); };
  for (int i = 0; i < 4; ++i) add({1, 0, 0, 0});  // root, chest, neck, right hip
  add({0});
  for (int i = 0; i < 2; ++i) add({1, 0, 0, 0});  // right ankle, shoulder
  add({0});
  add({1, 0, 0, 0});  // left hip
  add({0});
  for (int i = 0; i < 2; ++i) add({1, 0, 0, 0});
  add({0});
  return frame;
}

std::string Motion(const std::vector<std::vector<double>>& frames) {
  std::string text = "{\"Loop\": \"wrap\", \"Frames\": [";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    text += fmt::format("{}[{}]", i > 0 ? ",\n" : "\n", fmt::join(frames[i], ", "));
  }
  return text + "]}";
}

glm::dvec3 PlaceOf(const Clip& clip, std::size_t frame, const char* joint) {
  std::vector<GlobalTransform> globals;
  ComputeGlobals(clip.skeleton, clip.frames[frame], globals);
  return globals[static_cast<std::size_t>(clip.skeleton.Find(joint))].position;
}

void ExpectJointAt(const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::distance(a, b), 1e-12); }

std::string DeepMimicComplaint(const std::string& text) {
  const auto clip = ReadDeepMimicMotion(text, "walk.txt");
  EXPECT_FALSE(clip);
  return clip ? "" : ToString(clip.error());
}

TEST(DeepMimic, StandsWhereItsRootIsTold) {
  const std::string text = Motion({Standing(), Standing()});
  EXPECT_TRUE(IsDeepMimicMotion(text));
  EXPECT_FALSE(IsDeepMimicMotion("{\"asset\": {\"version\": \"2.0\"}}"));
  ASSERT_OK(clip, ReadDeepMimicMotion(text, "walk.txt"));
  EXPECT_DOUBLE_EQ(clip->rate_hz, 25);
  ExpectJointAt(PlaceOf(*clip, 0, "root"), {0.5, 0.9, -0.25});
  ExpectJointAt(PlaceOf(*clip, 1, "left_ankle"), {0.5, 0.9 - 0.421546 - 0.409870, -0.25 - 0.084887});
  ExpectJointAt(PlaceOf(*clip, 1, "right_wrist"),
             {0.5 - 0.02405, 0.9 + 0.236151 + 0.2435 - 0.274788 - 0.258947, -0.25 + 0.18311});
}

TEST(DeepMimic, KneesBendBackwardsElbowsForwardsAndQuaternionsAreWxyz) {
  std::vector<double> frame = Standing();
  frame[20] = -kPi / 2;     // right knee
  frame[29] = kPi / 2;      // right elbow
  frame[4] = frame[6] = 3;  // the root turned to the left, with a quaternion not of length 1
  ASSERT_OK(clip, ReadDeepMimicMotion(Motion({frame}), "walk.txt"));
  // Turned by 90° about +Y, the front +X becomes −Z, and the right hip is at +X.
  const glm::dvec3 root(0.5, 0.9, -0.25);
  ExpectJointAt(PlaceOf(*clip, 0, "right_hip") - root, {0.084887, 0, 0});
  ExpectJointAt(PlaceOf(*clip, 0, "right_ankle") - PlaceOf(*clip, 0, "right_knee"), {0, 0, 0.409870});
  ExpectJointAt(PlaceOf(*clip, 0, "right_wrist") - PlaceOf(*clip, 0, "right_elbow"), {0, 0, -0.258947});
}

TEST(DeepMimic, IsUnderstoodAsABody) {
  ASSERT_OK(clip, ReadDeepMimicMotion(Motion({Standing(), Standing()}), "walk.txt"));
  ASSERT_OK(map, FindJointMap(clip->skeleton, "walk.txt"));
  ASSERT_OK(body, ToBodyMotion(*clip, *map, "walk.txt"));
  EXPECT_EQ(body->unit, "metre");
  EXPECT_NEAR(Heading(body->motion.poses[0]), kPi / 2, 1e-9) << "it faces +X";
}

TEST(DeepMimic, RefusesWhatItIsNot) {
  EXPECT_THAT(DeepMimicComplaint("{\"Frames\":\n [1, }"), HasSubstr("walk.txt:2:"));
  EXPECT_THAT(DeepMimicComplaint("{\"Frames\": []}"), HasSubstr("no frames"));
  EXPECT_THAT(DeepMimicComplaint(Motion({{0.04, 1, 2}})), HasSubstr("Frames[0] has 3 numbers; allowed: 44"));
  EXPECT_THAT(DeepMimicComplaint(Motion({Standing(), Standing(0.05), Standing()})),
              HasSubstr("Frames[1][0]: the frame lasts 0.05 s"));
  EXPECT_THAT(DeepMimicComplaint(Motion({Standing(0)})), HasSubstr("the frame lasts 0 s; allowed: 0.0001 to 1 s"));
  std::vector<double> flat = Standing();
  flat[4] = 0;
  EXPECT_THAT(DeepMimicComplaint(Motion({flat})), HasSubstr("a quaternion of length 0"));
  flat[4] = 1e12;
  EXPECT_THAT(DeepMimicComplaint(Motion({flat})), HasSubstr("Frames[0][4]"));
  EXPECT_THAT(DeepMimicComplaint("{\"Frames\": [[\"one\"]]}"), HasSubstr("1 numbers"));
}

}  // namespace
}  // namespace etude
