#include "sim/skeleton_sensor/joint_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/skeleton_sensor/skeleton_sensor.h"
#include "tests/sim/performer/all_moves.h"
#include "tests/sim/skeleton_sensor/whole_motion.h"

// Compares the model with its closed forms: each option's documented effect is measured.

namespace etude {
namespace {

using enum Role;

constexpr int kWorlds = 60;

WorldKey ModelWorld(int trial) { return {.suite_seed = 1, .scenario = "joint-errors", .trial = trial}; }

BodyMotion Dancing() { return AfterEachOther({"boxing", "clap"}); }

/// Returns isotropic, uncorrelated options where errors depend on the pose only; tests switch other effects on.
SkeletonSensorOptions Plain() {
  SkeletonSensorOptions options = SensorV2();
  for (GroupErrors& group : options.groups) group = {.size = 0.03, .depth_ratio = 1, .still = 0, .white = 0};
  options.correlation.fill(0);
  options.arm_stretch = options.hand_stretch = 1;
  options.mode_share = 0.001;
  options.mode_ratio = 1;
  options.fast_share = 0;
  options.reference_distance_m = 2.75;
  return options;
}

Camera SensorOf(double distance = 2.75) { return SkeletonSensorAt({.distance = distance}, SensorV2().view); }

/// Mean squares of a joint's errors along the line of sight and across it, scaled to the reference distance.
struct MeanSquares {
  double along = 0, across = 0;
};
MeanSquares Measure(const BodyMotion& motion, const Camera& sensor, const SkeletonSensorOptions& options, Role role) {
  MeanSquares sum;
  double count = 0;
  for (int trial = 0; trial < kWorlds; ++trial) {
    const JointErrors errors = ErrorsOver(motion, sensor, options, ModelWorld(trial));
    for (std::size_t t = 0; t < errors.size(); ++t) {
      const glm::dvec3 sight = glm::normalize(motion.poses[t][role] - sensor.p_WC);
      const double z = sensor.p_WC.z - motion.poses[t][role].z, z0 = options.reference_distance_m;
      const double growth = DepthDeviation(options.depth_law, z) / DepthDeviation(options.depth_law, z0);
      const double along = glm::dot(errors[t][Index(role)], sight);
      const double squares = glm::dot(errors[t][Index(role)], errors[t][Index(role)]);
      sum.along += along * along / growth / growth;
      sum.across += 0.5 * (squares - along * along) / (z / z0) / (z / z0);
      ++count;
    }
  }
  return {sum.along / count, sum.across / count};
}

TEST(JointErrors, AreAsLargeAsTheirGroupSays) {
  const MeanSquares hand = Measure(Dancing(), SensorOf(), Plain(), kLeftHand);
  EXPECT_NEAR(std::sqrt(hand.along + 2 * hand.across), 0.03, 0.003);
}

TEST(JointErrors, AreLongerAlongTheLineOfSightByTheRatioOfTheirGroup) {
  // With the same dice, the ratio r scales errors along by r √(3 / (2 + r²)) and across by √(3 / (2 + r²)).
  constexpr double kRatio = 1.6;
  SkeletonSensorOptions options = Plain();
  options[JointGroup::kHands].depth_ratio = kRatio;
  const MeanSquares plain = Measure(Dancing(), SensorOf(), Plain(), kLeftHand);
  const MeanSquares deep = Measure(Dancing(), SensorOf(), options, kLeftHand);
  const double across = 3 / (2 + kRatio * kRatio);
  EXPECT_NEAR(deep.across / plain.across, across, 1e-9);
  EXPECT_NEAR(deep.along / plain.along, kRatio * kRatio * across, 1e-9);
  // A joint of another group keeps its errors.
  EXPECT_EQ(Measure(Dancing(), SensorOf(), options, kLeftElbow).along,
            Measure(Dancing(), SensorOf(), Plain(), kLeftElbow).along);
}

TEST(JointErrors, GrowWithTheDistanceByTheSensorsLaw) {
  // The same dice at both distances, so the ratio in each frame is exactly the law's.
  const BodyMotion motion = Dancing();
  for (const DepthLaw law : {DepthLaw::kStructuredLight, DepthLaw::kTimeOfFlight}) {
    SkeletonSensorOptions options = Plain();
    options.depth_law = law;
    const Camera near = SensorOf(2), far = SensorOf(4);
    const JointErrors at_near = ErrorsOver(motion, near, options, ModelWorld(0));
    const JointErrors at_far = ErrorsOver(motion, far, options, ModelWorld(0));
    for (std::size_t t = 0; t < motion.poses.size(); t += 7) {
      const glm::dvec3 place = motion.poses[t][kHead];
      const auto split = [&](const JointErrors& errors, const Camera& sensor) {
        const glm::dvec3 error = errors[t][Index(kHead)], sight = glm::normalize(place - sensor.p_WC);
        const double along = glm::dot(error, sight);
        return std::pair(along, glm::length(error - along * sight));
      };
      const auto [near_along, near_across] = split(at_near, near);
      const auto [far_along, far_across] = split(at_far, far);
      const double z_near = near.p_WC.z - place.z, z_far = far.p_WC.z - place.z;
      EXPECT_NEAR(far_across / near_across, z_far / z_near, 1e-6);
      EXPECT_NEAR(far_along / near_along, DepthDeviation(law, z_far) / DepthDeviation(law, z_near), 1e-6);
    }
  }
}

TEST(JointErrors, DepthLawsAreThePublishedFormulas) {
  EXPECT_NEAR(DepthDeviation(DepthLaw::kStructuredLight, 0.4), 0.0012, 1e-12);
  EXPECT_NEAR(DepthDeviation(DepthLaw::kStructuredLight, 2.4), 0.0012 + 0.0019 * 4, 1e-12);
  EXPECT_NEAR(DepthDeviation(DepthLaw::kTimeOfFlight, 2), 0.0017, 1e-12);
  EXPECT_NEAR(DepthDeviation(DepthLaw::kTimeOfFlight, 4), 0.0043, 1e-12);
}

double CorrelationOf(const SkeletonSensorOptions& options, Role a, Role b) {
  double both = 0, first = 0, second = 0;
  const BodyMotion motion = Dancing();
  for (int trial = 0; trial < kWorlds; ++trial) {
    for (const auto& frame : ErrorsOver(motion, SensorOf(), options, ModelWorld(trial))) {
      both += glm::dot(frame[Index(a)], frame[Index(b)]);
      first += glm::dot(frame[Index(a)], frame[Index(a)]);
      second += glm::dot(frame[Index(b)], frame[Index(b)]);
    }
  }
  return both / std::sqrt(first * second);
}

TEST(JointErrors, GoTogetherAlongTheTreeAsTheBonesSay) {
  SkeletonSensorOptions options = Plain();
  options.correlation[Index(BoneKind::kForearm)] = 0.6;
  options.correlation[Index(BoneKind::kHand)] = 0.5;
  options.correlation[Index(BoneKind::kThigh)] = -0.4;
  EXPECT_NEAR(CorrelationOf(options, kLeftElbow, kLeftWrist), 0.6, 0.1);
  EXPECT_NEAR(CorrelationOf(options, kRightWrist, kRightHand), 0.5, 0.1);
  EXPECT_NEAR(CorrelationOf(options, kRightElbow, kRightHand), 0.6 * 0.5, 0.1);  // indirectly, through the wrist
  EXPECT_NEAR(CorrelationOf(options, kLeftHip, kLeftKnee), -0.4, 0.1);
  EXPECT_NEAR(CorrelationOf(options, kLeftShoulder, kLeftElbow), 0, 0.1);  // the control: uncorrelated
}

/// Returns the sensed forearm length's deviation divided by its mean.
double ForearmVariation(const SkeletonSensorOptions& options) {
  const BodyMotion motion = Dancing();
  double sum = 0, squares = 0, count = 0;
  for (int trial = 0; trial < kWorlds; ++trial) {
    const JointErrors errors = ErrorsOver(motion, SensorOf(), options, ModelWorld(trial));
    for (std::size_t t = 0; t < errors.size(); ++t) {
      const auto place = [&](Role role) { return motion.poses[t][role] + errors[t][Index(role)]; };
      const double length = glm::distance(place(kLeftElbow), place(kLeftWrist));
      sum += length;
      squares += length * length;
      ++count;
    }
  }
  return std::sqrt(squares / count - sum * sum / count / count) / (sum / count);
}

TEST(JointErrors, StretchLimbsLessWhenTheSensorKnowsTheirLength) {
  SkeletonSensorOptions stiff = Plain();
  stiff.arm_stretch = 0.2;
  EXPECT_LT(ForearmVariation(stiff), 0.5 * ForearmVariation(Plain()));
}

/// Returns the deviation of a joint's error from its mean over a recording.
double Restlessness(const BodyMotion& motion, const SkeletonSensorOptions& options, Role role) {
  double sum = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const JointErrors errors = ErrorsOver(motion, SensorOf(), options, ModelWorld(trial));
    glm::dvec3 mean(0);
    for (const auto& frame : errors) mean += frame[Index(role)] / static_cast<double>(errors.size());
    for (const auto& frame : errors) {
      const glm::dvec3 off = frame[Index(role)] - mean;
      sum += glm::dot(off, off) / static_cast<double>(errors.size());
    }
  }
  return std::sqrt(sum / 10);
}

TEST(JointErrors, LeavePlantedFeetQuietWhileTheArmsDance) {
  BodyMotion motion = Dancing();
  for (BodyPose& pose : motion.poses) {
    for (const Role role : {kLeftAnkle, kLeftFoot}) pose[role] = motion.poses.front()[role];
  }
  const SkeletonSensorOptions v2 = SensorV2();
  EXPECT_LT(Restlessness(motion, v2, kLeftFoot), 0.006);
  EXPECT_GT(Restlessness(motion, v2, kLeftHand), 0.03);
  // The control: a kicking foot.
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    motion.poses[t][kLeftFoot].y += 0.3 * std::sin(0.2 * static_cast<double>(t));
  }
  EXPECT_GT(Restlessness(motion, v2, kLeftFoot), 0.015);
}

TEST(SlowNoise, HasUnitVarianceAndItsTimeConstantWithAndWithoutSmoothing) {
  for (const double smoothing : {0.0, 0.15}) {
    RandomStream dice(ModelWorld(1), "slow");
    SlowNoise noise(0.4, smoothing, 30, dice);
    double squares = 0, lagged = 0, differences = 0;
    constexpr int kFrames = 300000, kLag = 12;
    std::vector<double> values;
    for (int t = 0; t < kFrames; ++t) values.push_back(noise.Next(dice).x);
    for (int t = kLag; t < kFrames; ++t) {
      squares += values[t] * values[t] / kFrames;
      lagged += values[t] * values[t - kLag] / kFrames;
      const double second = values[t] - 2 * values[t - 1] + values[t - 2];
      differences += second * second / kFrames;
    }
    EXPECT_NEAR(squares, 1, 0.03);
    // Two low passes with time constants a and b: (a e^(−t/a) − b e^(−t/b)) / (a − b).
    const double t = kLag / 30.0, a = 0.4, b = smoothing;
    const double expected = (a * std::exp(-t / a) - (b > 0 ? b * std::exp(-t / b) : 0)) / (a - b);
    EXPECT_NEAR(lagged / squares, expected, 0.03);
    // Second differences are as large as those of white noise with a standard deviation of 0.23, or of 0.035 with
    // smoothing.
    EXPECT_NEAR(std::sqrt(differences / 6), smoothing > 0 ? 0.035 : 0.23, 0.02);
  }
}

TEST(BurstNoise, HasUnitVarianceAndTheKurtosisOfALogNormalLoudness) {
  RandomStream dice(ModelWorld(2), "burst");
  BurstNoise noise(0.05, 0.5, 30, dice);
  double squares = 0, fourths = 0;
  constexpr int kFrames = 1000000;
  for (int t = 0; t < kFrames; ++t) {
    const double x = noise.Next(dice).x;
    squares += x * x / kFrames;
    fourths += x * x * x * x / kFrames;
  }
  EXPECT_NEAR(squares, 1, 0.05);
  EXPECT_NEAR(fourths / (squares * squares), 3 * std::exp(4 * 0.25), 1.5);  // 8.2; a Gaussian has 3
}

TEST(JointErrors, AreNothingAtStrengthZero) {
  for (SkeletonSensorOptions options : {SensorV1(), SensorV2()}) {
    options.strength = 0;
    for (const auto& frame : ErrorsOver(Dancing(), SensorOf(), options, ModelWorld(0))) {
      for (const glm::dvec3& error : frame) EXPECT_EQ(error, glm::dvec3(0));
    }
  }
}

TEST(SkeletonSensorLag, TellsPosesLateAndAtStrengthZeroAtOnce) {
  const BodyMotion motion = Dancing();
  SkeletonSensorOptions options = Plain();
  for (GroupErrors& group : options.groups) group.size = 0;
  options.planted_feet = 0;
  options.dropout_share = options.swaps_per_minute = options.wrong_guess_chance = 0;
  options.lag_frames = 3;
  const SkeletonStream late = SenseSkeleton(motion, SensorOf(), {}, options, ModelWorld(0));
  options.strength = 0;
  const SkeletonStream prompt = SenseSkeleton(motion, SensorOf(), {}, options, ModelWorld(0));
  for (std::size_t t = 3; t < motion.poses.size(); ++t) {
    EXPECT_EQ(late.frames[t][kHead].position, motion.poses[t - 3][kHead]);
    EXPECT_EQ(prompt.frames[t][kHead].position, motion.poses[t][kHead]);
  }
  EXPECT_EQ(late.frames[0][kHead].position, motion.poses[0][kHead]);
  EXPECT_EQ(late.frames.size(), motion.poses.size());
}

}  // namespace
}  // namespace etude
