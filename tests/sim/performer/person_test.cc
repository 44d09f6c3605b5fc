#include "sim/performer/person.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/start_angles.h"
#include "sim/choreography/canonical_body.h"
#include "sim/performer/rendition.h"
#include "tests/sim/performer/all_moves.h"

namespace etude {
namespace {

Person Draw(int trial, People people) { return DrawPerson({5, "person-test", trial}, people); }

TEST(Person, AnAdultOfTheCanonicalStatureIsTheCanonicalBody) {
  const BodyDimensions body = DimensionsOf(1.7, 0), canonical;
  EXPECT_NEAR(body.thigh, canonical.thigh, 1e-12);
  EXPECT_NEAR(body.upper_arm, canonical.upper_arm, 1e-12);
  EXPECT_NEAR(body.HipHeight(), canonical.HipHeight(), 1e-12);
}

TEST(Person, AToddlerIsNoSmallAdult) {
  const BodyDimensions toddler = DimensionsOf(1, 1), adult = DimensionsOf(1, 0);
  // Hips are below half of a child's stature (Snyder 1977, four years: trochanter 0.46); an adult's share is 0.53.
  EXPECT_NEAR(toddler.HipHeight(), 0.465, 0.01);
  EXPECT_NEAR(adult.HipHeight(), 0.53, 0.01);
  const auto trunk = [](const BodyDimensions& body) { return body.spine + body.chest; };
  EXPECT_GT(trunk(toddler), 1.08 * trunk(adult));
  // The crown is at 1 m, which is about 0.08 m above the head joint.
  for (const BodyDimensions& body : {toddler, adult}) {
    EXPECT_NEAR(body.HipHeight() + trunk(body) + body.head_rise, 0.92, 0.025);
  }
}

TEST(Person, PresetsHaveTheirStatures) {
  std::set<People> met;
  for (int trial = 0; trial < 60; ++trial) {
    EXPECT_LE(Draw(trial, People::kToddler).stature_m, 1.10);
    EXPECT_GE(Draw(trial, People::kToddler).stature_m, 1.00);
    EXPECT_LE(Draw(trial, People::kSchoolChild).stature_m, 1.60);
    EXPECT_GE(Draw(trial, People::kAdult).stature_m, 1.50);
    EXPECT_LE(Draw(trial, People::kAdult).stature_m, 1.90);
    met.insert(Draw(trial, People::kMixed).kind);
  }
  EXPECT_EQ(met, (std::set{People::kToddler, People::kSchoolChild, People::kAdult, People::kExpert}));
}

TEST(Person, APresetChangesSizesNotLuck) {
  for (int trial = 0; trial < 20; ++trial) {
    const Person toddler = Draw(trial, People::kToddler), adult = Draw(trial, People::kAdult);
    EXPECT_EQ(toddler.style, adult.style);
    EXPECT_EQ(toddler.place.x, adult.place.x);
    EXPECT_GT(toddler.lag_s, adult.lag_s);
    EXPECT_LT(toddler.amplitude, adult.amplitude);
    EXPECT_GT(toddler.tiring, adult.tiring);
    EXPECT_GT(toddler.looseness, adult.looseness);
  }
}

TEST(Person, ByDefaultDancesAsTaught) {
  const Person taught;
  for (const Move& move : AllMoves()) {
    const Style style(taught, move);
    const Rendition rendition(style, {}, {});
    for (double share : {0.0, 0.3, 0.7}) {
      const Controls authored = move.curves.At(share * move.beats);
      for (std::size_t i = 0; i < kControlCount; ++i) {
        ASSERT_NEAR(rendition.Danced(share).values[i], authored.values[i], 1e-12) << move.name << " " << i;
      }
    }
  }
}

TEST(Person, KeepsTheirLimbsAndTheirStandingFeet) {
  for (int trial = 0; trial < 8; ++trial) {
    const Person person = Draw(trial, People::kMixed);
    const BodyPose standing = PoseOf(Controls{}, person.body);
    for (const Move& move : AllMoves()) {
      const Style style(person, move);
      for (double beat = 0; beat < move.beats; beat += 0.25) {
        const BodyPose pose = PoseOf(style.At(beat), person.body);
        for (const Bone& bone : AllBones()) {
          const bool is_girdle = bone.child == Role::kLeftShoulder || bone.child == Role::kRightShoulder;
          if (is_girdle) continue;  // shoulders rise with the arm
          ASSERT_NEAR(BoneLength(pose, bone), BoneLength(standing, bone), 1e-9) << RoleName(bone.child);
        }
        for (Role toe : {Role::kLeftFoot, Role::kRightFoot}) ASSERT_GE(pose[toe].y, person.body.toe_height - 1e-6);
      }
    }
  }
}

LimbLengths LengthsOf(const BodyDimensions& body) {
  const BodyPose rest = PoseOf(Controls{}, body);
  const auto length = [&](Role from, Role to) { return glm::distance(rest[from], rest[to]); };
  return {.foot = length(Role::kLeftAnkle, Role::kLeftFoot),
          .shank = body.shank,
          .thigh = body.thigh,
          .hip_width = 2 * body.hip_half_width,
          .trunk = body.spine + body.chest,
          .neck = length(Role::kShoulderCentre, Role::kHead),
          .shoulder_width = 2 * body.shoulder_half_width,
          .upper_arm = body.upper_arm,
          .forearm = body.forearm,
          .hand = body.hand};
}

/// The excess of a joint's angles over an adult's limits.
struct BeyondLimits {
  int angles = 0, beyond = 0;  // `beyond`: by more than a degree
  double worst = 0;            // radians
};

/// Returns true for the twist of a straight arm, which nobody sees.
bool IsTwistOfAStraightArm(const KinematicTree& tree, const TreeState& state, int angle) {
  for (const auto& [shoulder, elbow] :
       {std::pair(kTreeLeftShoulder, kTreeLeftElbow), std::pair(kTreeRightShoulder, kTreeRightElbow)}) {
    const int twist = tree.joints[static_cast<std::size_t>(shoulder)].first_dof + 2;
    const int bend = tree.joints[static_cast<std::size_t>(elbow)].first_dof;
    if (angle == twist && state.angles[static_cast<std::size_t>(bend)] < Radians(10)) return true;
  }
  return false;
}

/// Returns by how much each angle exceeds its limits in all moves of 12 people. `wrung` is subtracted from the left
/// arm's twist, radians.
std::map<int, BeyondLimits> Beyond(double wrung) {
  std::map<int, BeyondLimits> found;
  for (int trial = 0; trial < 12; ++trial) {
    const Person person = Draw(trial, People::kMixed);
    const KinematicTree tree = MakeBodyTree(LengthsOf(person.body));
    const std::vector<AngleRange> any(tree.limits.size(), {-kPi, kPi});
    for (const Move& move : AllMoves()) {
      const Style style(person, move);
      for (double beat = 0; beat < move.beats; beat += 0.2) {
        Controls controls = style.At(beat);
        controls.Of(Side::kLeft, SideControl::kArmTwist) -= wrung;
        const auto state = FindStartState(tree, PoseOf(controls, person.body), any);
        if (!state) continue;
        for (std::size_t i = 0; i < any.size(); ++i) {
          if (IsTwistOfAStraightArm(tree, *state, static_cast<int>(i))) continue;
          const double beyond =
              std::max(tree.limits[i].lower - state->angles[i], state->angles[i] - tree.limits[i].upper);
          BeyondLimits& of = found[static_cast<int>(i)];
          ++of.angles;
          of.beyond += beyond > Radians(1);
          of.worst = std::max(of.worst, beyond);
        }
      }
    }
  }
  return found;
}

TEST(Person, BreaksNoJoint) {
  constexpr double kSeldom = 0.005;
  for (const auto& [angle, found] : Beyond(0)) {
    EXPECT_GT(found.angles, 2000);
    EXPECT_LT(found.beyond, kSeldom * found.angles) << angle;
    EXPECT_LT(found.worst, Radians(20)) << angle;
  }
  const auto wrung = Beyond(Radians(60));
  EXPECT_TRUE(
      std::ranges::any_of(wrung, [&](const auto& of) { return of.second.beyond > kSeldom * of.second.angles; }));
}

TEST(Style, StaysWithThePersonAndDiffersBetweenPeople) {
  const Move& clap = *std::ranges::find(AllMoves(), "clap", &Move::name);
  const Person a = Draw(0, People::kAdult), b = Draw(1, People::kAdult);
  EXPECT_EQ(Style(a, clap).At(1).values, Style(a, clap).At(1).values);
  EXPECT_NE(Style(a, clap).At(1).values, Style(b, clap).At(1).values);
}

TEST(Style, ClosesItsLoop) {
  const Person person = Draw(4, People::kToddler);
  for (const Move& move : AllMoves()) {
    const Style style(person, move);
    const Controls first = style.At(0), last = style.At(move.beats);
    for (std::size_t i = 0; i < kControlCount; ++i) EXPECT_NEAR(first.values[i], last.values[i], 1e-9) << move.name;
  }
}

}  // namespace
}  // namespace etude
