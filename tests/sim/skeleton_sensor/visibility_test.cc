#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/base/angles.h"
#include "sim/choreography/move.h"
#include "sim/random/stream.h"
#include "sim/render/renderer.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"
#include "tests/sim/skeleton_sensor/whole_motion.h"
#include "tests/support/results.h"

// Compares visibility by rays with the renderer: two pictures of a few pixels around each joint, one of everything, one
// of the joint's own limbs. A joint is hidden if the first shows something clearly nearer.

namespace etude {
namespace {

using enum Role;

/// The parts that end in each joint, listed independently of sim/body.
const std::map<Role, std::set<Part>>& OwnParts() {
  static const std::map<Role, std::set<Part>> own = {
      {kHipCentre, {Part::kTrunk}},
      {kSpine, {Part::kTrunk}},
      {kShoulderCentre, {Part::kTrunk, Part::kHead}},
      {kHead, {Part::kHead}},
      {kLeftShoulder, {Part::kTrunk, Part::kLeftUpperArm}},
      {kLeftElbow, {Part::kLeftUpperArm, Part::kLeftForearm}},
      {kLeftWrist, {Part::kLeftForearm, Part::kLeftHand}},
      {kLeftHand, {Part::kLeftHand}},
      {kRightShoulder, {Part::kTrunk, Part::kRightUpperArm}},
      {kRightElbow, {Part::kRightUpperArm, Part::kRightForearm}},
      {kRightWrist, {Part::kRightForearm, Part::kRightHand}},
      {kRightHand, {Part::kRightHand}},
      {kLeftHip, {Part::kTrunk, Part::kLeftThigh}},
      {kLeftKnee, {Part::kLeftThigh, Part::kLeftShank}},
      {kLeftAnkle, {Part::kLeftShank, Part::kLeftFoot}},
      {kLeftFoot, {Part::kLeftFoot}},
      {kRightHip, {Part::kTrunk, Part::kRightThigh}},
      {kRightKnee, {Part::kRightThigh, Part::kRightShank}},
      {kRightAnkle, {Part::kRightShank, Part::kRightFoot}},
      {kRightFoot, {Part::kRightFoot}},
  };
  return own;
}

Surface SurfaceOf(const Cuboid& box) {
  Surface surface;
  const glm::dvec3 x(std::cos(box.heading), 0, -std::sin(box.heading)), y(0, 1, 0),
      z(std::sin(box.heading), 0, std::cos(box.heading));
  for (const auto& [a, b, c] : {std::array{x, y, z}, std::array{y, z, x}, std::array{z, x, y}}) {
    for (const double side : {-1.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(surface.positions.size());
      const auto size = [&](const glm::dvec3& axis) {
        return axis == x ? box.half_size.x : axis == y ? box.half_size.y : box.half_size.z;
      };
      for (const auto& [s, t] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{1, 1}, std::pair{-1, 1}}) {
        surface.positions.push_back(box.centre + side * size(c) * c + static_cast<double>(s) * size(a) * a +
                                    static_cast<double>(t) * size(b) * b);
        surface.normals.push_back(side * c);
      }
      surface.triangles.push_back({first, first + 1, first + 2});
      surface.triangles.push_back({first, first + 2, first + 3});
      surface.parts.insert(surface.parts.end(), 2, Part::kTrunk);
    }
  }
  return surface;
}

/// Returns a pose of a built-in move at a random heading, each joint shifted a little.
BodyPose RandomPose(RandomStream& dice) {
  static const std::vector<Move> moves = [] {
    std::vector<Move> loaded;
    for (const char* name : {"clap", "boxing", "side_kick", "sway"}) loaded.push_back(*LoadBuiltinMove(name));
    return loaded;
  }();
  const auto& poses = moves[dice.IndexBelow(moves.size())].motion.poses;
  const FloorMove turn{.yaw = dice.Uniform(-kPi, kPi), .x = 0, .z = 0};
  BodyPose pose = turn.Apply(poses[dice.IndexBelow(poses.size())]);
  for (glm::dvec3& joint : pose.joints) joint += 0.03 * dice.Normal3() + glm::dvec3(0, 0.2, 0);
  return pose;
}

/// A camera of a few pixels at the sensor's place, with the joint in the centre of its middle pixel.
constexpr int kPixels = 9;
Camera LookAtJoint(const glm::dvec3& eye, const glm::dvec3& joint) {
  return LookAt({.width = kPixels, .height = kPixels, .fx = 365, .fy = 365, .cx = 4.5, .cy = 4.5, .skew = 0}, eye,
                joint);
}

struct Agreement {
  int joints = 0, agree = 0, hidden = 0;
};

/// Compares `told` (per role) with the pictures.
void CompareWithPictures(Renderer& renderer, const BodyPose& pose, const Occluders& occluders, const glm::dvec3& eye,
                         const HiddenJoints& told, Agreement& agreement) {
  const std::vector<Capsule> body = BodyCapsules(pose);
  std::vector<Figure> all = {{.shape = body}};
  for (const BodyPose& other : occluders.bystander) all.push_back({.shape = BodyCapsules(other)});
  for (const Cuboid& box : occluders.furniture)
    all.push_back({.shape = {}, .colours = {}, .surfaces = {SurfaceOf(box)}});
  for (const Role role : AllRoles()) {
    const Camera camera = LookAtJoint(eye, pose[role]);
    std::vector<Capsule> own;
    std::ranges::copy_if(body, std::back_inserter(own),
                         [&](const Capsule& capsule) { return OwnParts().at(role).contains(capsule.part); });
    constexpr int kMiddle = kPixels / 2;
    const float nearest = renderer.Render({}, all, camera, Targets::kAll).depth.At(kMiddle, kMiddle);
    const float skin = renderer.Render({}, {{.shape = own}}, camera, Targets::kAll).depth.At(kMiddle, kMiddle);
    const bool hidden = nearest < skin - 0.02F;
    ++agreement.joints;
    agreement.hidden += hidden;
    agreement.agree += hidden == told[Index(role)];
  }
}

Cuboid Table(RandomStream& dice) {
  return {.centre = {dice.Uniform(-0.4, 0.4), dice.Uniform(0.4, 0.9), dice.Uniform(0.8, 1.4)},
          .half_size = {0.5, 0.1, 0.25},
          .heading = dice.Uniform(-1, 1)};
}

TEST(Visibility, IsWhatTheRendererDrawsForAllButOneJointInAThousand) {
  ASSERT_OK(renderer, SharedRenderer());
  RandomStream dice({.suite_seed = 1, .scenario = "visibility", .trial = 0}, "poses");
  Agreement agreement, blind;
  for (int i = 0; i < 120; ++i) {
    const BodyMotion motion{.rate_hz = 30, .poses = {RandomPose(dice)}};
    Occluders occluders;
    if (i % 3 == 1) occluders.furniture = {Table(dice)};
    if (i % 3 == 2) {
      BodyPose other = RandomPose(dice);
      for (glm::dvec3& joint : other.joints) joint += glm::dvec3(dice.Uniform(-0.3, 0.3), 0, 1.0);
      occluders.bystander = {other};
    }
    const glm::dvec3 eye(dice.Uniform(-0.5, 0.5), dice.Uniform(0.5, 1.8), dice.Uniform(2.2, 3.5));
    const auto told = HiddenOver(motion, occluders, eye);
    CompareWithPictures(**renderer, motion.poses[0], occluders, eye, told[0], agreement);
    if (i % 3 == 0) continue;
    // The control: rays that ignore furniture and bystanders.
    CompareWithPictures(**renderer, motion.poses[0], occluders, eye, HiddenOver(motion, {}, eye)[0], blind);
  }
  EXPECT_GE(agreement.joints, 2000);
  EXPECT_GE(agreement.agree, 0.999 * agreement.joints)
      << agreement.joints - agreement.agree << " of " << agreement.joints;
  EXPECT_GT(agreement.hidden, agreement.joints / 10);  // so there is something to detect
  EXPECT_LT(agreement.hidden, agreement.joints * 2 / 3);
  EXPECT_LT(blind.agree, 0.9 * blind.joints);
}

TEST(Visibility, OfATableBeforeTheLegsHidesTheLegsAlone) {
  const BodyMotion motion{.rate_hz = 30, .poses = {LoadBuiltinMove("sway")->motion.poses.front()}};
  const Occluders table{.furniture = {{.centre = {0, 0.4, 0.8}, .half_size = {1, 0.4, 0.1}, .heading = 0}},
                        .bystander = {}};
  const HiddenJoints hidden = HiddenOver(motion, table, {0, 1, 2.75})[0];
  for (const Role role : {kLeftKnee, kRightKnee, kLeftAnkle, kRightFoot}) EXPECT_TRUE(hidden[Index(role)]);
  for (const Role role : {kHead, kLeftShoulder, kRightElbow, kSpine}) EXPECT_FALSE(hidden[Index(role)]);
  // The same table behind the performer hides nothing.
  const Occluders behind{.furniture = {{.centre = {0, 0.4, -0.8}, .half_size = {1, 0.4, 0.1}, .heading = 0}},
                         .bystander = {}};
  EXPECT_FALSE(HiddenOver(motion, behind, {0, 1, 2.75})[0][Index(kLeftKnee)]);
}

}  // namespace
}  // namespace etude
