#include "engine/transitions/joins/inertialise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/fuzzy/features.h"
#include "tests/engine/transitions/joins/join_pictures.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

/// Returns what remains of an offset of `x` metres with velocity `v`.
double Left(const DecayLaw& law, double x, double v, double seconds) { return law({{x, 0, 0}, {v, 0, 0}}, seconds).x; }

DecayLaw SpringLaw() {
  return [](const Offset& offset, double seconds) { return SpringDecay(offset, seconds); };
}
DecayLaw QuinticLaw(const QuinticOptions& options = {}) {
  return [options](const Offset& offset, double seconds) { return QuinticDecay(offset, seconds, options); };
}

double SpeedAtStart(const DecayLaw& law, double x, double v) {
  constexpr double kStep = 1e-6;
  return (Left(law, x, v, kStep) - Left(law, x, v, 0)) / kStep;
}

TEST(Inertialise, ShowsTheOldPoseAtTheTransitionPointAndHalfTheOffsetAfterItsHalfLife) {
  const BodyPose hanging = StandingClip(1, 0).poses[0], raised = StandingClip(1, 60).poses[0];
  const Inertialiser offsets({.shown = {hanging, hanging}, .target = {raised, raised}, .continuation = {}},
                             SpringLaw());
  ExpectSamePose(offsets.Apply(raised, 0), hanging, 1e-12);
  const auto arm_degrees = [&](double seconds) {
    return ComputeFeatures(offsets.Apply(raised, seconds), PosedBody::kStandingHipHeight)[Feature::kRH];
  };
  // Critically damped from rest, the share (1 + yt)e^−yt of the offset remains; after a half-life yt = 2 ln 2.
  EXPECT_NEAR(arm_degrees(0.1), 60 * (1 - (1 + 2 * std::log(2)) / 4), 1e-6);
  EXPECT_NEAR(arm_degrees(2), 60, 1e-3);
}

TEST(Inertialise, StartsInTheShownPoseWithTheShownSpeed) {
  for (const DecayLaw& law : {SpringLaw(), QuinticLaw()}) {
    EXPECT_EQ(Left(law, 0.3, -0.5, 0), 0.3);
    EXPECT_NEAR(SpeedAtStart(law, 0.3, -0.5), -0.5, 1e-3);
  }
  EXPECT_NEAR(SpeedAtStart(SpringLaw(), 0.3, 0.5), 0.5, 1e-3) << "the spring lets it grow on";
  EXPECT_NEAR(SpeedAtStart(QuinticLaw(), 0.3, 0.5), 0, 1e-3) << "the quintic does not";
}

/// Returns the speed (degrees per second) with which an elbow's offset continues. At the transition point, the elbow
/// is raised sideways by `now` degrees; 1/30 s earlier, by `before` degrees. In the new motion it hangs still.
double SpeedOfElbow(double before, double now) {
  const auto raised = [](double degrees) {
    PosedBody body;
    body.left_arm.upper = body.left_arm.lower = PosedBody::Raised(degrees, {1, 0, 0});
    return body.Pose();
  };
  const BodyPose hanging = raised(0);
  const Inertialiser offsets({.shown = {raised(before), raised(now)}, .target = {hanging, hanging}, .continuation = {}},
                             SpringLaw());
  constexpr double kStep = 1e-6;
  const auto angle = [&](double seconds) {
    const BodyPose pose = offsets.Apply(hanging, seconds);
    const glm::dvec3 arm = pose[Role::kLeftElbow] - pose[Role::kLeftShoulder];
    return Degrees(std::atan2(arm.x, -arm.y));
  };
  return (angle(kStep) - angle(0)) / kStep;
}

TEST(Inertialise, GoesOnAtTheSpeedOfEveryLimbButOneThatChangesOverAtHalfATurn) {
  EXPECT_NEAR(SpeedOfElbow(30, 40), 10 * kJudgedRateHz, 0.1);
  EXPECT_NEAR(SpeedOfElbow(15, 100), 85 * kJudgedRateHz, 1) << "fast, and far off: no change of sign";
  EXPECT_NEAR(SpeedOfElbow(-10, 40), 50 * kJudgedRateHz, 0.1) << "to the other side, but near: no artefact either";
  EXPECT_NEAR(SpeedOfElbow(-178, 178), 0, 0.1) << "by 4 degrees or by -356: no speed to rely on";
}

TEST(QuinticDecay, ComesToRestAtZeroWhenTheBlendEnds) {
  const DecayLaw law = QuinticLaw({.blend_s = 0.4});
  constexpr double kStep = 1e-4;
  EXPECT_EQ(Left(law, 0.3, -0.2, 0.4), 0);
  // A root of third order: velocity and acceleration are zero, too.
  EXPECT_NEAR(Left(law, 0.3, -0.2, 0.4 - kStep), 0, 1e-9);
  EXPECT_GT(Left(law, 0.3, -0.2, 0.35), 0);
}

// Bollo's choice: five halves of the time in which a parabola from x0 with slope v0 comes to rest, 2 x0 / −v0.
TEST(QuinticDecay, TakesFiveHalvesOfAParabolasTimeWhereThatIsShorterThanTheBlend) {
  const DecayLaw law = QuinticLaw({.blend_s = 0.4});
  constexpr double kEnd = 5 * 0.3 / 6;
  EXPECT_EQ(Left(law, 0.3, -6, kEnd), 0);
  EXPECT_GT(Left(law, 0.3, -6, 0.95 * kEnd), 0);
  EXPECT_GT(Left(law, 0.3, -6, 0.5 * kEnd), 1e-3);
}

TEST(QuinticDecay, NeverOvershootsNorGrows) {
  for (double velocity : {0.0, -0.1, -1.0, -5.0, -50.0}) {
    double last = 0.3;
    for (int i = 1; i <= 400; ++i) {
      const double left = Left(QuinticLaw(), 0.3, velocity, 0.001 * i);
      EXPECT_GE(left, -1e-12) << velocity;
      EXPECT_LE(left, last + 1e-12) << velocity;
      last = left;
    }
    EXPECT_EQ(last, 0);
  }
}

TEST(QuinticDecay, IsNothingWithoutOffsetOrWithoutTime) {
  EXPECT_EQ(Left(QuinticLaw(), 0, -1, 0.1), 0);
  EXPECT_EQ(Left(QuinticLaw({.blend_s = 0}), 0.3, 0, 0.03), 0);
}

// A velocity v with half-life h travels v·h/ln 2·(1 − 2^(−t/h)) in the time t.
TEST(DeadBlending, GoesOnWithVelocitiesThatHalveWhileTheNewMotionFadesIn) {
  const auto raised = [](double degrees, double x) {
    PosedBody body;
    body.left_arm.upper = body.left_arm.lower = PosedBody::Raised(degrees, {1, 0, 0});
    BodyPose pose = body.Pose();
    for (glm::dvec3& joint : pose.joints) joint.x += x;
    return pose;
  };
  constexpr double kHalf_s = 0.25, kBlend_s = 0.8, kRate = 30;
  const BodyPose now = raised(20, 0.1), wanted = raised(0, 3);
  const Blend blend = DeadBlending({.shown = {raised(18, 0.07), now}, .target = {wanted, wanted}, .continuation = {}},
                                   {.blend_s = kBlend_s, .half_life_s = kHalf_s});
  for (const int frames : {1, 6, 12, 23, 24, 40}) {
    const double t = frames / kRate, s = std::min(t / kBlend_s, 1.0), share = s * s * (3 - 2 * s);
    const double way = kHalf_s / std::log(2) * (1 - std::pow(0.5, t / kHalf_s));
    const BodyPose shown = blend(wanted, frames);
    EXPECT_NEAR(shown[Role::kHipCentre].x, (1 - share) * (0.1 + 0.03 * kRate * way) + share * 3, 1e-9) << frames;
    // The arm turns in one plane, so angles add: it continues by 2° a frame, and returns to 0.
    const double angle = ComputeFeatures(shown, PosedBody::kStandingHipHeight)[Feature::kLH];
    EXPECT_NEAR(angle, (1 - share) * (20 + 2 * kRate * way), 1e-6) << frames;
  }
}

}  // namespace
}  // namespace etude
