#include <gtest/gtest.h>

#include "engine/motion/statistics.h"
#include "engine/retargeting/to_body.h"
#include "tests/support/person.h"
#include "tests/support/read_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::AtRest;

Skeleton PersonTimes(double factor) {
  Skeleton person = testing::PersonSkeleton();
  for (Joint& joint : person.joints) joint.rest.translation *= factor;
  return person;
}

TEST(UndoScales, TakesOutWhatTheRestPoseHasNotAndLeavesThePlaces) {
  const auto map = FindJointMap(PersonTimes(0.01), "person.glb");
  for (const double scale : {0.01, 0.5, 2.0, 100.0}) {
    std::vector<Clip> clips(2, AtRest(PersonTimes(0.01), 3));
    for (Clip& clip : clips) {
      for (std::size_t f = 0; f < 3; ++f) {
        clip.frames[f][0].scale = glm::dvec3(scale);
        clip.frames[f][0].translation.x = static_cast<double>(f);
      }
    }
    ASSERT_OK(undone, UndoScales(clips, *map)) << scale;
    EXPECT_NEAR(*undone, scale, 1e-9 * scale);
    const auto body = testing::ToBody(clips[1], "person.glb");
    EXPECT_EQ(body->unit, "metre");
    EXPECT_NEAR(Stature(body->motion.poses[2]), 1.60 / 0.92, 1e-9);
    EXPECT_NEAR(body->motion.poses[2][Role::kHipCentre].x - body->motion.poses[0][Role::kHipCentre].x, 2, 1e-12);
  }
}

TEST(UndoScales, LeavesClipsAsTheyAreThatArePeopleOrThatNoScaleMadeSo) {
  const auto stays = [](std::vector<Clip> clips) {
    return !UndoScales(clips, *FindJointMap(clips.front().skeleton, "person.glb"));
  };
  Clip standing = AtRest(PersonTimes(0.01), 20), alike = standing, stretched = AtRest(PersonTimes(0.01), 5),
       toy = AtRest(PersonTimes(0.003), 5);
  for (LocalPose& frame : alike.frames) frame[0].scale = glm::dvec3(1.1);
  for (LocalPose& frame : stretched.frames) frame[0].scale = glm::dvec3(1.5);
  for (LocalPose& frame : toy.frames) frame[0].scale = glm::dvec3(3);
  EXPECT_TRUE(stays({standing}));
  EXPECT_TRUE(stays({alike}));
  EXPECT_TRUE(stays({stretched, standing})) << "one clip of a file";
  EXPECT_TRUE(stays({toy})) << "the rest pose is no person";
  Clip longer = standing;  // lengthened by the joints' positions
  for (LocalPose& frame : longer.frames) {
    for (LocalTransform& local : frame) local.translation *= 2;
  }
  EXPECT_TRUE(stays({longer}));
}

}  // namespace
}  // namespace etude
