#include "sim/skeleton_sensor/skeleton_sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "sim/choreography/move.h"
#include "tests/sim/performer/all_moves.h"
#include "tests/sim/skeleton_sensor/whole_motion.h"

// Compares the simulated Kinect v1 with published figures; every band is the published one. Recordings of a v2 are
// compared in tests/tools/sensor_fit and docs/sensor.md.

namespace etude {
namespace {

using enum Role;

constexpr std::array kTorso = {kHipCentre, kSpine, kShoulderCentre, kHead};
constexpr std::array kHands = {kLeftHand, kRightHand};
constexpr std::array kEnds = {kLeftHand, kRightHand, kLeftFoot, kRightFoot};
constexpr std::array kArmBones = {kLeftElbow, kLeftWrist, kRightElbow, kRightWrist};  // named by their child joint

WorldKey World(int trial) { return {.suite_seed = 1, .scenario = "sensor-statistics", .trial = trial}; }

BodyMotion Dance(const char* name, std::size_t repeats) {
  return AfterEachOther(std::vector<std::string>(repeats, name));
}

Camera Sensor() { return SkeletonSensorAt({}, SensorV1().view); }

JointErrors Errors(const BodyMotion& motion, const WorldKey& world, double strength = 1) {
  SkeletonSensorOptions options = SensorV1();
  options.strength = strength;
  return ErrorsOver(motion, Sensor(), options, world);
}

BodyPose Standing() { return LoadBuiltinMove("sway")->motion.poses.front(); }

BodyMotion StandingStill(std::size_t frames) {
  BodyMotion motion;
  motion.poses.assign(frames, Standing());
  return motion;
}

/// Returns the covariance of joints' errors over `lag` frames, averaged over joints and axes.
template <std::size_t N>
double Covariance(const JointErrors& errors, const std::array<Role, N>& roles, std::size_t lag) {
  double sum = 0;
  for (Role role : roles) {
    glm::dvec3 mean(0);
    for (const auto& frame : errors) mean += frame[Index(role)] / static_cast<double>(errors.size());
    for (std::size_t t = 0; t + lag < errors.size(); ++t) {
      sum += glm::dot(errors[t][Index(role)] - mean, errors[t + lag][Index(role)] - mean);
    }
  }
  return sum / (3.0 * N * static_cast<double>(errors.size() - lag));
}

/// The parts of a process "slow wander + white noise", from its covariance at lags 0, 5 and 10.
struct Wander {
  double slow_mm, white_mm, time_constant_s;
};
template <std::size_t N>
Wander AnalyseWander(const JointErrors& errors, const std::array<Role, N>& roles) {
  const double c0 = Covariance(errors, roles, 0), c5 = Covariance(errors, roles, 5),
               c10 = Covariance(errors, roles, 10);
  const double slow = c5 * c5 / c10;  // an exponential, extrapolated to lag 0
  return {.slow_mm = 1000 * std::sqrt(slow),
          .white_mm = 1000 * std::sqrt(std::max(0.0, c0 - slow)),
          .time_constant_s = 5.0 / kJudgedRateHz / std::log(c5 / c10)};
}

TEST(SkeletonSensor, WandersByMillimetresWithATimeConstantOfHalfASecondWhenTheBodyStands) {
  const auto errors = Errors(StandingStill(10000), World(0));
  const Wander torso = AnalyseWander(errors, kTorso), ends = AnalyseWander(errors, kEnds);
  EXPECT_GT(torso.slow_mm, 1.0);
  EXPECT_LT(torso.slow_mm, 2.0);
  EXPECT_GT(ends.slow_mm, 2.0);
  EXPECT_LT(ends.slow_mm, 4.0);
  for (const Wander& wander : {torso, ends}) {
    EXPECT_GT(wander.time_constant_s, 0.3);
    EXPECT_LT(wander.time_constant_s, 0.5);
  }
  EXPECT_LT(torso.white_mm, 0.4);  // 0.3 mm, and the estimate's own noise
  EXPECT_LT(ends.white_mm, 1.5);
  EXPECT_GT(ends.white_mm, 0.5);
}

/// Returns the distances (cm) of sensed joints from the true ones in dances, pooled over moves and worlds, sorted.
template <std::size_t N>
std::vector<double> DancingErrorsCm(const std::array<Role, N>& roles, double strength) {
  std::vector<double> lengths;
  int trial = 0;
  for (const char* move : {"clap", "side_kick", "boxing", "sway"}) {
    const BodyMotion motion = Dance(move, 2);
    for (int world = 0; world < 8; ++world) {
      for (const auto& frame : Errors(motion, World(trial++), strength)) {
        for (Role role : roles) lengths.push_back(100 * glm::length(frame[Index(role)]));
      }
    }
  }
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

double RootMeanSquare(const std::vector<double>& values) {
  double sum = 0;
  for (double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(SkeletonSensor, ErrsByTwoToThreeCentimetresAtTheTorsoAndFiveToSixAtTheHandsInADance) {
  const auto torso = DancingErrorsCm(kTorso, 1), hands = DancingErrorsCm(kHands, 1);
  EXPECT_GT(RootMeanSquare(torso), 2.0);
  EXPECT_LT(RootMeanSquare(torso), 3.0);
  EXPECT_GT(RootMeanSquare(hands), 5.0);
  EXPECT_LT(RootMeanSquare(hands), 6.0);
  const double p95 = hands[hands.size() * 95 / 100];
  EXPECT_GT(p95, 8.0);
  EXPECT_LT(p95, 11.0);
}

TEST(SkeletonSensor, ErrsInProportionToItsStrength) {
  // Also the control of the test above: at double strength the bands are exceeded.
  const double once = RootMeanSquare(DancingErrorsCm(kHands, 1)), twice = RootMeanSquare(DancingErrorsCm(kHands, 2));
  EXPECT_NEAR(twice, 2 * once, 1e-9);
  EXPECT_GT(twice, 6.0);
}

TEST(SkeletonSensor, ErrsMoreWhenTheBodyMovesFaster) {
  BodyMotion slow = Dance("boxing", 4), fast;
  for (std::size_t t = 0; t < slow.poses.size(); t += 2) fast.poses.push_back(slow.poses[t]);
  const auto size = [](const BodyMotion& motion) {
    double sum = 0, count = 0;
    for (int trial = 0; trial < 10; ++trial) {
      for (const auto& frame : Errors(motion, World(trial))) {
        sum += glm::dot(frame[Index(kLeftHand)], frame[Index(kLeftHand)]);
        ++count;
      }
    }
    return std::sqrt(sum / count);
  };
  EXPECT_GT(size(fast), 1.05 * size(slow));
}

TEST(SkeletonSensor, StretchesTheArmsBonesByFourToTwelvePercent) {
  double sum = 0, count = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const BodyMotion motion = Dance(trial % 2 == 0 ? "clap" : "sway", 3);
    const auto errors = Errors(motion, World(trial));
    for (Role child : kArmBones) {
      const std::size_t c = Index(child), p = Index(*ParentOf(child));
      double lengths = 0, squares = 0;
      for (std::size_t t = 0; t < errors.size(); ++t) {
        const glm::dvec3 bone = motion.poses[t].joints[c] + errors[t][c] - motion.poses[t].joints[p] - errors[t][p];
        lengths += glm::length(bone);
        squares += glm::dot(bone, bone);
      }
      const double mean = lengths / static_cast<double>(errors.size());
      sum += std::sqrt(squares / static_cast<double>(errors.size()) - mean * mean) / mean;
      ++count;
    }
  }
  EXPECT_GT(sum / count, 0.04);
  EXPECT_LT(sum / count, 0.12);
}

TEST(SkeletonSensor, LosesTheWholeBodyInTwoPercentOfFrames) {
  Dropouts dropouts(SensorV1(), World(0));
  int lost = 0;
  for (int t = 0; t < 300000; ++t) lost += dropouts.Next();
  EXPECT_NEAR(lost / 300000.0, 0.02, 0.003);
}

/// Consecutive frames in which the guess has the same offset. On a still body, each episode of a wrong guess is one
/// stretch.
struct Stretch {
  int frames;
  double off_m;
};

TEST(SkeletonSensor, GuessesHiddenHandsFarOffInEpisodesOfThreeToFortyFrames) {
  const std::size_t frames = 20000;
  std::vector<HiddenJoints> hidden(frames);
  for (HiddenJoints& frame : hidden) frame[Index(kLeftHand)] = true;
  const auto guesses = GuessesOver(StandingStill(frames), hidden, SensorV1(), World(0));
  std::vector<Stretch> stretches;
  for (std::size_t t = 0; t < frames; ++t) {
    const Guess& guess = guesses[t][Index(kLeftHand)];
    ASSERT_TRUE(guess.inferred);
    ASSERT_FALSE(guesses[t][Index(kLeftElbow)].inferred);
    const bool same = t > 0 && guess.offset == guesses[t - 1][Index(kLeftHand)].offset;
    if (!same) stretches.push_back({0, glm::length(guess.offset)});
    ++stretches.back().frames;
  }
  int wrong_frames = 0, shortest = 1000, longest = 0;
  double nearest = 10, farthest = 0;
  stretches.pop_back();  // cut off by the end of the recording
  for (const Stretch& stretch : stretches) {
    if (stretch.off_m == 0) continue;  // good guesses, possibly several in sequence
    wrong_frames += stretch.frames;
    shortest = std::min(shortest, stretch.frames);
    longest = std::max(longest, stretch.frames);
    nearest = std::min(nearest, stretch.off_m);
    farthest = std::max(farthest, stretch.off_m);
  }
  EXPECT_EQ(shortest, 3);
  EXPECT_EQ(longest, 40);
  EXPECT_NEAR(nearest, 0.2, 0.02);
  EXPECT_NEAR(farthest, 1.1, 0.05);
  EXPECT_NEAR(wrong_frames / static_cast<double>(frames), SensorV1().wrong_guess_chance, 0.08);
}

TEST(SkeletonSensor, InfersAtLeastThreeFramesOnceAJointWasHidden) {
  std::vector<HiddenJoints> hidden(30);
  hidden[10][Index(kRightWrist)] = true;
  const auto guesses = GuessesOver(StandingStill(30), hidden, SensorV1(), World(0));
  for (std::size_t t = 0; t < 30; ++t) {
    EXPECT_EQ(guesses[t][Index(kRightWrist)].inferred, t >= 10 && t < 13) << "frame " << t;
  }
}

/// Returns options without errors; tests switch some on.
SkeletonSensorOptions Faultless() {
  SkeletonSensorOptions options = SensorV1();
  options.strength = 0;
  return options;
}

TEST(SkeletonSensor, InfersTheArmBehindTheBodyAndTracksTheOneBeforeIt) {
  // From the performer's left, the trunk hides the right arm.
  const BodyMotion motion = StandingStill(5);
  const SkeletonStream stream =
      SenseSkeleton(motion, SkeletonSensorAt({.turn = Radians(90)}, SensorV1().view), {}, Faultless(), World(0));
  for (const SensedFrame& frame : stream.frames) {
    EXPECT_EQ(frame[kLeftElbow].state, TrackingState::kTracked);
    EXPECT_EQ(frame[kRightElbow].state, TrackingState::kInferred);
    EXPECT_EQ(frame[kRightElbow].position, motion.poses[0][kRightElbow]);  // at strength 0 a guess is exact
  }
}

TEST(SkeletonSensor, RepeatsTheLastReportOfAJointThatLeavesTheView) {
  BodyMotion motion = StandingStill(4);
  motion.poses[2][kLeftHand] = {0, 5, 0};
  motion.poses[3][kLeftHand] = {0, 5, 0};
  const SkeletonStream stream = SenseSkeleton(motion, Sensor(), {}, Faultless(), World(0));
  EXPECT_EQ(stream.frames[1][kLeftHand].state, TrackingState::kTracked);
  EXPECT_EQ(stream.frames[3][kLeftHand].state, TrackingState::kNotTracked);
  EXPECT_EQ(stream.frames[3][kLeftHand].position, motion.poses[1][kLeftHand]);
  EXPECT_TRUE(stream.frames[3].body_seen);
}

TEST(SkeletonSensor, ExchangesArmsOrLegsForAThirdOfASecondNowAndThen) {
  SkeletonSensorOptions options = SensorV1();
  options.swaps_per_minute = 30;
  const std::size_t frames = 18000;  // ten minutes at 30 Hz
  int arms = 0, legs = 0;
  Swaps swaps(30, options, World(0));
  for (std::size_t t = 0; t < frames; ++t) {
    const Swap swap = swaps.Next(0);
    arms += swap.arms;
    legs += swap.legs;
    EXPECT_FALSE(swap.arms && swap.legs);
  }
  // On average a swap begins 60 frames after the previous one's ten frames.
  constexpr double kSwapFrames = 10, kPause = 60;
  EXPECT_NEAR((arms + legs) / static_cast<double>(frames), kSwapFrames / (kSwapFrames + kPause), 0.02);
  EXPECT_GT(std::min(arms, legs), 500);
}

TEST(SkeletonSensor, ThrowsTheSameDiceWhateverTheOptionsSay) {
  const BodyMotion motion = Dance("clap", 2);
  SkeletonSensorOptions no_dropouts = SensorV1();
  no_dropouts.dropout_share = 0;
  const SkeletonStream with = SenseSkeleton(motion, Sensor(), {}, SensorV1(), World(1));
  const SkeletonStream without = SenseSkeleton(motion, Sensor(), {}, no_dropouts, World(1));
  int compared = 0;
  for (std::size_t t = 0; t < motion.poses.size(); ++t) {
    EXPECT_TRUE(without.frames[t].body_seen);
    if (!with.frames[t].body_seen) continue;
    for (Role role : AllRoles()) {
      EXPECT_EQ(with.frames[t][role].position, without.frames[t][role].position);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(SkeletonSensor, DependsOnItsWorldAlone) {
  const BodyMotion motion = Dance("clap", 1);
  const Camera sensor = SkeletonSensorAt({.turn = 0.5}, SensorV1().view);
  const auto hand = [&](int trial) {
    return SenseSkeleton(motion, sensor, {}, SensorV1(), World(trial)).frames[20][kLeftHand].position;
  };
  EXPECT_EQ(hand(3), hand(3));
  EXPECT_NE(hand(3), hand(4));
}

TEST(SkeletonSensor, ReportsAFrameAsSoonAsTheNextSevenPosesAreKnownWhateverFollowsThem) {
  const BodyMotion dance = Dance("boxing", 2);
  const std::size_t turns_off = 60;
  BodyMotion other = dance;
  for (std::size_t t = turns_off; t < other.poses.size(); ++t) other.poses[t] = Dance("jump", 4).poses[t];
  const SkeletonStream whole = SenseSkeleton(dance, Sensor(), {}, SensorV1(), World(0));
  const Occluders nothing;
  SkeletonSensor sensor(Sensor(), nothing, SensorV1(), other.rate_hz, World(0));
  std::size_t told = 0;
  for (std::size_t t = 0; t < other.poses.size(); ++t) {
    const auto frame = sensor.Update(other.poses[t]);
    ASSERT_EQ(frame.has_value(), t >= SkeletonSensor::kAhead);
    if (!frame || told + SkeletonSensor::kAhead >= turns_off) continue;
    for (const Role role : AllRoles()) {
      ASSERT_EQ((*frame)[role].position, whole.frames[told][role].position) << "frame " << told;
      ASSERT_EQ((*frame)[role].state, whole.frames[told][role].state);
    }
    ++told;
  }
  EXPECT_EQ(told, turns_off - SkeletonSensor::kAhead);
  EXPECT_EQ(sensor.Finish().size(), SkeletonSensor::kAhead);
}

TEST(SkeletonSensor, ReportsEveryFrameOfAMotionShorterThanItLooksAhead) {
  for (const std::size_t frames : {0, 1, 3, 7, 8}) {
    EXPECT_EQ(SenseSkeleton(StandingStill(frames), Sensor(), {}, SensorV2(), World(0)).frames.size(), frames);
  }
}

}  // namespace
}  // namespace etude
