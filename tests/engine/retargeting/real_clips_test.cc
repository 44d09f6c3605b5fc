#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "engine/formats/bvh.h"
#include "engine/motion/statistics.h"
#include "tests/support/read_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using enum Role;
using ::testing::HasSubstr;
using ::testing::Not;

struct RealClip {
  const char* file;  // from Debian's assimp-testmodels
  std::size_t frames;
  double rate_hz;
  double metres_per_unit;
  bool begins_with_t_pose;
};

class RealClips : public ::testing::TestWithParam<RealClip> {
 protected:
  void SetUp() override {
    std::ifstream in(std::string("/usr/share/assimp/models/BVH/") + GetParam().file, std::ios::binary);
    ASSERT_TRUE(in) << "not installed: package assimp-testmodels";
    bytes_.assign(std::istreambuf_iterator<char>(in), {});
  }

  std::string bytes_;
};

TEST_P(RealClips, ComeBackFromWritingToThePrintedPrecision) {
  ASSERT_OK(clip, ReadBvh(bytes_, GetParam().file));
  EXPECT_EQ(clip->frames.size(), GetParam().frames);
  EXPECT_EQ(clip->rate_hz, GetParam().rate_hz);
  ASSERT_OK(again, ReadBvh(WriteBvh(*clip), GetParam().file));

  ASSERT_EQ(again->skeleton.joints.size(), clip->skeleton.joints.size());
  for (std::size_t i = 0; i < clip->skeleton.joints.size(); ++i) {
    EXPECT_EQ(again->skeleton.joints[i].name, clip->skeleton.joints[i].name);
    EXPECT_EQ(again->skeleton.joints[i].parent, clip->skeleton.joints[i].parent);
    EXPECT_EQ(again->skeleton.joints[i].is_end_site, clip->skeleton.joints[i].is_end_site);
  }
  EXPECT_EQ(again->rate_hz, clip->rate_hz);
  ASSERT_EQ(again->frames.size(), clip->frames.size());
  double worst_translation = 0;
  double worst_rotation = 0;  // distance of unit quaternions, half the angle in radians
  for (std::size_t f = 0; f < clip->frames.size(); ++f) {
    for (std::size_t i = 0; i < clip->frames[f].size(); ++i) {
      const LocalTransform& a = clip->frames[f][i];
      const LocalTransform& b = again->frames[f][i];
      worst_translation = std::max(worst_translation, glm::distance(a.translation, b.translation));
      worst_rotation = std::max(worst_rotation,
                                std::min(glm::length(a.rotation - b.rotation), glm::length(a.rotation + b.rotation)));
    }
  }
  // Each of three numbers is rounded by at most half a unit of the sixth decimal. Angles are in degrees; the distance
  // of unit quaternions is half the angle in radians.
  EXPECT_LT(worst_translation, 0.9e-6);
  EXPECT_LT(worst_rotation, 3 * 0.5e-6 * (std::numbers::pi / 180) / 2);
}

TEST_P(RealClips, BecomePeopleOfCommonHeightWithTheirFeetOnTheFloor) {
  ASSERT_OK(body, testing::ReadBody(bytes_, GetParam().file));
  EXPECT_DOUBLE_EQ(body->metres_per_unit, GetParam().metres_per_unit);
  EXPECT_EQ(body->dropped_frames, GetParam().begins_with_t_pose ? 1u : 0u);

  std::size_t on_floor = 0;
  for (const BodyPose& pose : body->motion.poses) {
    EXPECT_GT(Stature(pose), 1.5);
    EXPECT_LT(Stature(pose), 2.0);
    const double lowest = std::min({pose[kLeftFoot].y, pose[kRightFoot].y, pose[kLeftAnkle].y, pose[kRightAnkle].y});
    EXPECT_GT(lowest, -0.08);
    if (lowest < 0.06) ++on_floor;
  }
  // In 01_03 the person climbs half of the time.
  EXPECT_GT(on_floor, body->motion.poses.size() / 3);
}

TEST_P(RealClips, KeepLeftLeft) {
  ASSERT_OK(body, testing::ReadBody(bytes_, GetParam().file));
  double toes_forward = 0;
  for (const BodyPose& pose : body->motion.poses) {
    const BodyPose own = ToOrigin(pose).Apply(pose);  // facing +Z
    EXPECT_GT(own[kLeftHip].x, 0.01);
    EXPECT_LT(own[kRightHip].x, -0.01);
    toes_forward += (own[kLeftFoot] - own[kLeftAnkle]).z + (own[kRightFoot] - own[kRightAnkle]).z;
  }
  // Facing comes from hips and shoulders only; toes confirm that it is not mirrored.
  EXPECT_GT(toes_forward / static_cast<double>(body->motion.poses.size()), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Debian, RealClips,
                         ::testing::Values(RealClip{"01_01.bvh", 2752, 120, 0.0254 / 0.45, true},
                                           RealClip{"01_03.bvh", 4511, 120, 0.0254 / 0.45, true},
                                           RealClip{"Boxing_Toes.bvh", 3069, 100, 0.01, false}),
                         [](const auto& clip) {
                           const std::string file = clip.param.file;
                           return file.substr(0, file.find('.'));
                         });

}  // namespace
}  // namespace etude
