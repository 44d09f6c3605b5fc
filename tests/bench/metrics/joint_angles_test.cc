#include "bench/metrics/joint_angles.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "engine/base/angles.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns a skeleton of pelvis, spine, legs and arms at rest, with the arms `arm_deg` below the horizontal, turned by
/// `heading` about Y.
RawMotion RestingBody(double arm_deg, double heading = 0) {
  RawMotion motion;
  const double c = std::cos(Radians(arm_deg)), s = std::sin(Radians(arm_deg));
  const auto add = [&](const char* name, int parent, glm::dvec3 place, std::optional<Role> role) {
    const auto index = static_cast<int>(motion.joints.size());
    motion.joints.emplace_back(name);
    motion.parents.push_back(parent);
    const glm::dquat turn = glm::angleAxis(heading, glm::dvec3(0, 1, 0));
    motion.rest_positions.push_back(turn * place);
    motion.rest_rotations.push_back(turn);
    if (role) motion.roles[Index(*role)] = index;
    return index;
  };
  using enum Role;
  const int pelvis = add("pelvis", -1, {0, 1, 0}, std::nullopt);
  const int chest = add("chest", pelvis, {0, 1.3, 0}, std::nullopt);
  add("head", chest, {0, 1.6, 0}, kHead);
  for (const double side : {1.0, -1.0}) {
    const bool is_left = side > 0;
    const int hip = add("hip", pelvis, {side * 0.1, 0.95, 0}, is_left ? kLeftHip : kRightHip);
    const int knee = add("knee", hip, {side * 0.12, 0.5, 0}, is_left ? kLeftKnee : kRightKnee);
    add("ankle", knee, {side * 0.12, 0.1, -0.02}, is_left ? kLeftAnkle : kRightAnkle);
    const glm::dvec3 shoulder(side * 0.2, 1.4, 0), along(side * c, -s, 0);
    const int arm = add("arm", chest, shoulder, is_left ? kLeftShoulder : kRightShoulder);
    const int elbow = add("elbow", arm, shoulder + 0.3 * along, is_left ? kLeftElbow : kRightElbow);
    add("wrist", elbow, shoulder + 0.55 * along, is_left ? kLeftWrist : kRightWrist);
  }
  return motion;
}

/// Adds a frame. Each joint is turned from its rest pose, relative to its parent, about the body's own axes; a joint
/// without a rotation stays at rest.
void AddFrame(RawMotion& motion, const std::map<int, glm::dquat>& turns) {
  std::vector<glm::dquat> rotations;
  for (std::size_t j = 0; j < motion.joints.size(); ++j) {
    const auto turn = turns.find(static_cast<int>(j));
    const glm::dquat own = turn == turns.end() ? glm::dquat(1, 0, 0, 0) : turn->second;
    rotations.push_back(motion.parents[j] < 0 ? motion.rest_rotations[j] * own : rotations[motion.parents[j]] * own);
    motion.positions.push_back(motion.rest_positions[j]);
  }
  motion.rotations.insert(motion.rotations.end(), rotations.begin(), rotations.end());
}

double AngleIn(const AngleTracks& angles, const std::string& name, std::size_t frame = 0) {
  const auto found = std::ranges::find(angles.names, name);
  EXPECT_NE(found, angles.names.end()) << name;
  return angles.degrees[frame * angles.names.size() + static_cast<std::size_t>(found - angles.names.begin())];
}

glm::dquat AboutX(double degrees) { return glm::angleAxis(Radians(degrees), glm::dvec3(1, 0, 0)); }
glm::dquat AboutY(double degrees) { return glm::angleAxis(Radians(degrees), glm::dvec3(0, 1, 0)); }
glm::dquat AboutZ(double degrees) { return glm::angleAxis(Radians(degrees), glm::dvec3(0, 0, 1)); }

TEST(AnglesOfRotations, AKneeBendsAsFarAsItIsBent) {
  for (const double heading : {0.0, 0.7, -2.0}) {
    RawMotion motion = RestingBody(0, heading);
    // In the neutral pose the shank hangs straight down. Turn it about the body's X axis.
    AddFrame(motion, {{motion.roles[Index(Role::kLeftKnee)], AboutX(40)}});
    const AngleTracks angles = AnglesOfRotations(motion);
    const double at_rest = Degrees(std::atan2(0.02, 0.4));  // the shank leans back at rest
    EXPECT_NEAR(AngleIn(angles, "left_knee_flexion"), 40 + at_rest, 0.1) << "the thigh leans aside";
    EXPECT_NEAR(AngleIn(angles, "right_knee_flexion"), at_rest, 0.01);
    EXPECT_NEAR(AngleIn(angles, "trunk_rotation"), 0, 1e-9);
  }
}

TEST(AnglesOfRotations, LegsAreLiftedAheadAndOutwards) {
  RawMotion motion = RestingBody(0);
  // At rest the thigh hangs outwards by atan(0.02 / 0.45) = 2.54°; angles count from the vertical of the neutral pose.
  AddFrame(motion, {{motion.roles[Index(Role::kLeftHip)], AboutX(-30) * AboutZ(20) * AboutY(-10)},
                    {motion.roles[Index(Role::kRightHip)], AboutX(-30) * AboutZ(-20) * AboutY(10)}});
  const AngleTracks angles = AnglesOfRotations(motion);
  for (const char* side : {"left_hip", "right_hip"}) {
    EXPECT_NEAR(AngleIn(angles, side + std::string("_flexion")), 30, 1);
    EXPECT_NEAR(AngleIn(angles, side + std::string("_abduction")), 20 + 2.54, 0.1);
    EXPECT_NEAR(AngleIn(angles, side + std::string("_rotation")), 10, 1);
  }
}

TEST(AnglesOfRotations, ATPoseAndAnAPoseAtRestGiveTheSameAngles) {
  // The same arm in the world: first hanging, then 25° forward.
  std::vector<double> flexions;
  for (const double below : {0.0, 45.0, 90.0}) {
    RawMotion motion = RestingBody(below);
    const glm::dquat hangs = AboutZ(-(90 - below));  // of the left arm
    AddFrame(motion, {{motion.roles[Index(Role::kLeftShoulder)], AboutX(-25) * hangs}});
    const AngleTracks angles = AnglesOfRotations(motion);
    EXPECT_NEAR(AngleIn(angles, "left_shoulder_flexion"), 25, 1e-9) << below;
    EXPECT_NEAR(AngleIn(angles, "left_shoulder_abduction"), 0, 1e-9) << below;
    EXPECT_NEAR(AngleIn(angles, "left_shoulder_rotation"), 0, 1e-9) << below;
    EXPECT_NEAR(AngleIn(angles, "left_elbow_flexion"), 0, 1e-9) << below;
  }
}

TEST(AnglesOfRotations, NeedRotationsAndHips) {
  RawMotion motion = RestingBody(0);
  motion.positions = motion.rest_positions;
  EXPECT_TRUE(AnglesOfRotations(motion).names.empty());
  AddFrame(motion, {});
  motion.roles[Index(Role::kLeftHip)] = -1;
  EXPECT_TRUE(AnglesOfRotations(motion).names.empty());
}

TEST(AgreementSums, TogetherAreThoseOfAllFrames) {
  AngleTracks truth{{"a"}, {}}, found{{"a"}, {}};
  for (int f = 0; f < 40; ++f) {
    truth.degrees.push_back(30 * std::sin(0.3 * f));
    found.degrees.push_back(28 * std::sin(0.3 * f + 0.1) + 2);
  }
  const AgreementSums all = SumAgreement(found, truth, 0);
  const auto part = [](const AngleTracks& angles, int begin, int end) {
    return AngleTracks{{"a"}, {angles.degrees.begin() + begin, angles.degrees.begin() + end}};
  };
  const AgreementSums both = Together(SumAgreement(part(found, 0, 13), part(truth, 0, 13), 0),
                                      SumAgreement(part(found, 13, 40), part(truth, 13, 40), 0));
  for (const auto figure : {RmsOf, BiasOf, IccOf}) EXPECT_NEAR(*figure(all), *figure(both), 1e-12);
  EXPECT_EQ(Together({}, all).count, 40);
  EXPECT_FALSE(RmsOf({}));
  ASSERT_OK(decoded, DecodeSums(EncodeSums(all)));
  EXPECT_EQ(decoded->product, all.product);
}

}  // namespace
}  // namespace etude
