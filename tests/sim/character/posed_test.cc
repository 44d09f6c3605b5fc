#include "sim/character/posed.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <memory>

#include "engine/base/angles.h"
#include "engine/retargeting/rig.h"
#include "sim/character/characters.h"
#include "sim/choreography/canonical_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

// An arm along +X: shoulder at the origin, elbow at 1, and in the hand's place a joint without a role ("glove"). Of
// three triangles, the first follows the shoulder, the second follows shoulder and elbow, and the third follows the
// glove.
Character Arm() {
  Character arm;
  const auto at = [](double x) { return LocalTransform{.translation = {x, 0, 0}}; };
  arm.skeleton.joints = {{.name = "left_shoulder", .parent = -1, .rest = at(0)},
                         {.name = "left_elbow", .parent = 0, .rest = at(1)},
                         {.name = "glove", .parent = 1, .rest = at(1)}};
  arm.materials = {{"skin", {0.5, 0, 2}}};
  SkinnedMesh mesh;
  for (int joint = 0; joint < 3; ++joint) {
    mesh.bindings.push_back({joint, glm::translate(glm::dmat4(1), glm::dvec3(-joint, 0, 0))});
  }
  const auto add = [&mesh](double x, std::array<int, 4> bindings, std::array<double, 4> weights) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const glm::dvec3& corner : {glm::dvec3(0, 0, 0), glm::dvec3(0.2, 0, 0), glm::dvec3(0, 0.2, 0)}) {
      mesh.vertices.push_back({corner + glm::dvec3(x, 0, 0), {0, 0, 1}, bindings, weights});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  };
  add(0.3, {0}, {1});
  add(0.9, {0, 1}, {0.4, 0.6});
  add(2.1, {2}, {1});
  arm.meshes = {mesh};
  return arm;
}

LocalPose BentArm(const Character& arm) {
  LocalPose pose = RestPose(arm.skeleton);
  pose[1].rotation = glm::angleAxis(Radians(90), glm::dvec3(0, 0, 1));
  return pose;
}

void ExpectNear(const glm::dvec3& a, const glm::dvec3& b) {
  EXPECT_NEAR(glm::distance(a, b), 0, 1e-12) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(PosedFigure, FollowsItsSkeleton) {
  const Character arm = Arm();
  const Figure figure = PosedFigure(arm, BentArm(arm));
  EXPECT_TRUE(figure.shape.empty());
  ASSERT_EQ(figure.surfaces.size(), 1u);
  const Surface& sleeve = figure.surfaces[0];
  EXPECT_EQ(sleeve.triangles, arm.meshes[0].triangles);
  ExpectNear(sleeve.positions[1], {0.5, 0, 0});
  ExpectNear(sleeve.positions[3], glm::mix(glm::dvec3(0.9, 0, 0), glm::dvec3(1, -0.1, 0), 0.6));
  ExpectNear(sleeve.positions[7], {1, 1.3, 0});  // 1.3 above an elbow that points up
  ExpectNear(sleeve.positions[8], {0.8, 1.1, 0});
}

TEST(PosedFigure, IsMovedIntoTheWorldWithItsNormals) {
  const Character arm = Arm();
  // Inches, Z up, non-uniform scale: normals need the inverse transpose.
  glm::dmat4 to_world = glm::translate(glm::dmat4(1), {0.5, 0.9, -1});
  to_world = glm::rotate(to_world, Radians(-90), {1, 0.3, 0});
  to_world = glm::scale(to_world, glm::dvec3(0.0254, 0.05, 0.1));
  const Surface here = PosedFigure(arm, BentArm(arm)).surfaces[0];
  const Surface there = PosedFigure(arm, BentArm(arm), to_world).surfaces[0];
  for (std::size_t i = 0; i < here.positions.size(); ++i) {
    ExpectNear(there.positions[i], glm::dvec3(to_world * glm::dvec4(here.positions[i], 1)));
    EXPECT_NEAR(glm::length(there.normals[i]), 1, 1e-12);
  }
  for (const auto& [a, b, c] : there.triangles) {
    const glm::dvec3& p = there.positions[a];
    ExpectNear(glm::normalize(glm::cross(there.positions[b] - p, there.positions[c] - p)), there.normals[a]);
  }
}

TEST(PosedFigure, LabelsEachTriangleByTheRoleThatMovesItMost) {
  Character arm = Arm();
  const auto parts = [&arm] { return PosedFigure(arm, RestPose(arm.skeleton)).surfaces[0].parts; };
  EXPECT_EQ(parts(), (std::vector{Part::kLeftUpperArm, Part::kLeftForearm, Part::kLeftForearm}));
  arm.skeleton.joints[2].name = "left_wrist";
  EXPECT_EQ(parts(), (std::vector{Part::kLeftUpperArm, Part::kLeftForearm, Part::kLeftHand}));
  for (Joint& joint : arm.skeleton.joints) joint.name = "Bone";
  EXPECT_EQ(parts(), std::vector(3, Part::kTrunk));
}

TEST(PosedFigure, TurnsLinearColoursIntoThoseOfPictures) {
  const Character arm = Arm();
  // Half the light is code 188; values out of range are clamped.
  EXPECT_EQ(PosedFigure(arm, RestPose(arm.skeleton)).surfaces[0].colour, (Rgb8{188, 0, 255}));
}

TEST(PosedFigure, OfABodysPoseHasItsJointsThere) {
  Character dots;
  dots.skeleton = BodySkeleton(StandingPose());
  dots.materials = {{}};
  SkinnedMesh mesh;
  for (const Role role : AllRoles()) {
    const int joint = dots.skeleton.Find(std::string(RoleName(role)));
    ASSERT_GE(joint, 0);
    mesh.bindings.push_back({joint, glm::translate(glm::dmat4(1), -StandingPose()[role])});
    mesh.vertices.push_back({StandingPose()[role], {0, 1, 0}, {static_cast<int>(Index(role))}, {1}});
  }
  dots.meshes = {mesh};
  const BodyPose ready = PoseOf(ReadyStance());
  const Figure figure = PosedFigure(dots, ready);
  for (const Role role : AllRoles()) {
    EXPECT_NEAR(glm::distance(figure.surfaces[0].positions[Index(role)], ready[role]), 0, 1e-9) << RoleName(role);
  }
  EXPECT_GT(glm::distance(ready[Role::kLeftHand], StandingPose()[Role::kLeftHand]), 0.05);
}

TEST(PosedFigure, FillsABodyOfOtherProportions) {
  // Short legs, a long trunk, broad hips. The three vertices are half-way along the left thigh, at the end of the
  // pelvis (left hip), and at the end of the upper trunk (shoulder centre).
  BodyPose other = StandingPose();
  for (glm::dvec3& joint : other.joints) joint *= glm::dvec3(1.5, joint.y < 0.95 ? 0.6 : 1.2, 1);
  const auto half_thigh = [](const BodyPose& pose) { return 0.5 * (pose[Role::kLeftHip] + pose[Role::kLeftKnee]); };
  Character marks;
  marks.skeleton = BodySkeleton(StandingPose());
  marks.materials = {{}};
  SkinnedMesh mesh;
  const auto mark = [&mesh](Role role, const glm::dvec3& at) {
    const auto binding = static_cast<int>(mesh.bindings.size());
    mesh.bindings.push_back({static_cast<int>(Index(role)), glm::translate(glm::dmat4(1), -StandingPose()[role])});
    mesh.vertices.push_back({at, {0, 1, 0}, {binding}, {1}});
  };
  mark(Role::kLeftHip, half_thigh(StandingPose()));
  mark(Role::kHipCentre, StandingPose()[Role::kLeftHip]);
  mark(Role::kSpine, StandingPose()[Role::kShoulderCentre]);
  marks.meshes = {mesh};
  const std::vector<glm::dvec3> seen = PosedFigure(marks, other).surfaces[0].positions;
  ExpectNear(seen[0], half_thigh(other));
  ExpectNear(seen[1], other[Role::kLeftHip]);
  ExpectNear(seen[2], other[Role::kShoulderCentre]);
}

TEST(PartsOfJoints, ByTheMapAreThoseByNameOfASkeletonThatHasBoth) {
  const Skeleton skeleton = MannequinCharacter().skeleton;
  ASSERT_OK(map, FindJointMap(skeleton, "mannequin"));
  EXPECT_EQ(PartsOfJoints(skeleton, *map), PartsOfJoints(skeleton));
}

TEST(PartsOfJoints, BetweenNeckAndHeadAreHeadAndInsideALimbAreThatLimb) {
  Skeleton skeleton;
  for (const char* name : {"hips", "chest", "neck", "skull", "crown", "jaw", "arm", "twist", "elbow", "finger"}) {
    skeleton.joints.push_back({.name = name, .parent = static_cast<int>(skeleton.joints.size()) - 1, .rest = {}});
  }
  skeleton.joints[5].parent = 3;  // the jaw, on the skull
  skeleton.joints[6].parent = 1;  // the arm, on the chest
  JointMap map;
  for (RolePoint& point : map.points) point.joint = 0;
  const auto at = [&map](Role role, int joint) { map.points[Index(role)].joint = joint; };
  at(Role::kSpine, 1);
  at(Role::kShoulderCentre, 2);
  at(Role::kHead, 4);
  at(Role::kLeftShoulder, 6);
  at(Role::kLeftElbow, 8);
  at(Role::kLeftWrist, 9);
  at(Role::kLeftHand, 9);
  const std::vector<Part> wanted{Part::kTrunk,       Part::kTrunk,   Part::kTrunk,        Part::kHead,
                                 Part::kHead,        Part::kHead,    Part::kLeftUpperArm, Part::kLeftUpperArm,
                                 Part::kLeftForearm, Part::kLeftHand};
  EXPECT_EQ(PartsOfJoints(skeleton, map), wanted);
}

TEST(RecordedFigure, IsTheCharacterInTheBodysPosesMovedAlongTheFloor) {
  const auto mannequin = std::make_shared<const Character>(MannequinCharacter());
  BodyMotion motion{.rate_hz = 30, .poses = {StandingPose(), PoseOf(ReadyStance()), StandingPose()}};
  Clip clip = RigClip(motion, StandingPose(), "ready");
  clip.skeleton = mannequin->skeleton;
  ASSERT_OK(map, FindJointMap(clip.skeleton, "ready"));
  // The file's rate is twice the body's, and its first two frames were dropped.
  clip.frames.insert(clip.frames.begin(), 2, clip.frames.front());
  clip.rate_hz = 60;
  BodyConversion body{.metres_per_unit = 0.5, .dropped_frames = 2, .motion = motion};
  const RecordedFigure figure(mannequin, clip, *map, body);

  const FloorMove move{.yaw = 0.7, .x = 0.2, .z = -1};
  // Frame 0.5 of the motion is frame 2 + 1 of the file: the ready stance at half size.
  const Figure seen = figure.At(0.5, move), wanted = PosedFigure(*mannequin, clip.frames[3]);
  ASSERT_EQ(seen.surfaces.size(), wanted.surfaces.size());
  for (std::size_t s = 0; s < seen.surfaces.size(); ++s) {
    for (std::size_t v = 0; v < seen.surfaces[s].positions.size(); ++v) {
      const glm::dvec3 there = move.Apply(0.5 * wanted.surfaces[s].positions[v]);
      ASSERT_LT(glm::distance(seen.surfaces[s].positions[v], there), 1e-9);
    }
  }
  for (std::size_t s = 0; s < seen.surfaces.size(); ++s) {
    EXPECT_TRUE(seen.surfaces[s].parts == wanted.surfaces[s].parts) << s;
  }
}

}  // namespace

}  // namespace etude
