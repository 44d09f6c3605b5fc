#include "bench/tasks/evaluation/spoil.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/tasks/evaluation/controls.h"

namespace etude {
namespace {

/// Returns a motion at 50 Hz whose hips swing and whose left foot steps.
RawMotion Swinging() {
  RawMotion motion;
  motion.rate_hz = 50;
  motion.joints = {"left_hip", "right_hip", "hip_centre", "left_ankle", "left_foot"};
  using enum Role;
  int joint = 0;
  for (const Role role : {kLeftHip, kRightHip, kHipCentre, kLeftAnkle, kLeftFoot}) motion.roles[Index(role)] = joint++;
  for (int f = 0; f < 100; ++f) {
    const double t = f / 50.0, swing = 0.1 * std::sin(3 * t), step = 0.08 * std::abs(std::sin(4 * t));
    for (const glm::dvec3& p :
         {glm::dvec3(0.1 + swing, 1, t), {-0.1 + swing, 1, 0}, {swing, 1, 0}, {0.1, 0.1 + step, t}, {0.1, step, t}}) {
      motion.positions.push_back(p);
    }
  }
  return motion;
}

/// Returns the largest distance of a joint from `expected(frame, joint)`.
template <typename Expected>
double WorstOff(const RawMotion& motion, Expected expected) {
  double worst = 0;
  for (std::size_t f = 0; f < motion.FrameCount(); ++f) {
    for (std::size_t j = 0; j < motion.joints.size(); ++j) {
      worst = std::max(worst, glm::distance(motion.At(f, j), expected(f, j)));
    }
  }
  return worst;
}

TEST(Spoilt, NothingChangesWithoutAFault) {
  const RawMotion truth = Swinging();
  EXPECT_EQ(Spoilt(truth, {}, "a").positions, truth.positions);
}

TEST(Spoilt, EachFaultIsItsClosedForm) {
  const RawMotion truth = Swinging();
  const auto at = [&](std::size_t f, std::size_t j) { return truth.At(std::min<std::size_t>(f, 99), j); };
  const auto off = [&](const Spoiler& spoiler, auto expected) {
    return WorstOff(Spoilt(truth, spoiler, "a"), expected);
  };
  constexpr double kRounding = 1e-12;
  EXPECT_LT(off({.scaled_percent = 5}, [&](auto f, auto j) { return 1.05 * at(f, j); }), kRounding);
  EXPECT_LT(off({.moved_cm = 10}, [&](auto f, auto j) { return at(f, j) + glm::dvec3(0.1, 0, 0); }), kRounding);
  EXPECT_LT(off({.lifted_cm = 5}, [&](auto f, auto j) { return at(f, j) + glm::dvec3(0, 0.05, 0); }), kRounding);
  EXPECT_LT(off({.gliding_cm_s = 30}, [&](auto f, auto j) { return at(f, j) + glm::dvec3(0.006 * f, 0, 0); }),
            kRounding);
  EXPECT_LT(off({.late_ms = 100}, [&](auto f, auto j) { return at(f < 5 ? 0 : f - 5, j); }), kRounding);
  EXPECT_LT(
      off({.late_ms = 110}, [&](auto f, auto j) { return f < 6 ? at(0, j) : 0.5 * (at(f - 5, j) + at(f - 6, j)); }),
      kRounding)
      << "half a frame";
  EXPECT_LT(off({.frozen_share = 0.5}, [&](auto f, auto j) { return at(std::min<std::size_t>(f, 50), j); }), kRounding);
  EXPECT_LT(off({.frozen_share = 1}, [&](auto, auto j) { return at(0, j); }), kRounding);
  EXPECT_LT(off({.kept_frames = 2},
                [&](auto f, auto j) { return f % 2 == 0 || f == 99 ? at(f, j) : 0.5 * (at(f - 1, j) + at(f + 1, j)); }),
            kRounding);
  EXPECT_LT(off({.smoothed_ms = 40},
                [&](auto f, auto j) {
                  return f == 0 || f == 99 ? at(f, j) : (at(f - 1, j) + at(f, j) + at(f + 1, j)) / 3.0;
                }),
            kRounding);
}

TEST(Spoilt, AllFadedRestsAtTheMean) {
  const RawMotion rest = Spoilt(Swinging(), {.faded_percent = 100}, "a");
  EXPECT_LT(WorstOff(rest, [&](std::size_t, std::size_t j) { return rest.At(0, j); }), 1e-12);
  EXPECT_NEAR(rest.At(0, 1).z, 0, 1e-12);
  EXPECT_NEAR(rest.At(0, 0).z, 0.99, 1e-12) << "the mean time";
}

TEST(Spoilt, AMirrorSwapsSidesAndIsItsOwnInverse) {
  const RawMotion truth = Swinging(), once = Spoilt(truth, {.mirrored_share = 1}, "a");
  EXPECT_EQ(once.At(30, 1).z, truth.At(30, 0).z);
  const RawMotion twice = Spoilt(once, {.mirrored_share = 1}, "a");
  EXPECT_LT(WorstOff(twice, [&](std::size_t f, std::size_t j) { return truth.At(f, j); }), 1e-12);
}

TEST(Spoilt, LockedFeetRestWhileTheyAreLow) {
  const RawMotion truth = Swinging(), locked = Spoilt(truth, {.feet_locked_cm = 5}, "a");
  int rests = 0, moves = 0;
  for (std::size_t f = 1; f < 100; ++f) {
    const bool is_low = truth.At(f, 4).y < 0.05 && truth.At(f - 1, 4).y < 0.05;
    (is_low ? rests : moves) += 1;
    EXPECT_EQ(is_low, locked.At(f, 4) == locked.At(f - 1, 4)) << f;
    EXPECT_EQ(locked.At(f, 0), truth.At(f, 0)) << "other joints stay";
  }
  EXPECT_GT(rests, 10);
  EXPECT_GT(moves, 10);
}

TEST(Spoilt, NoiseHasItsDeviationAndDependsOnTheNameAlone) {
  const RawMotion truth = Swinging(), noisy = Spoilt(truth, {.noisy_mm = 10}, "a");
  double square = 0;
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    const glm::dvec3 off = noisy.positions[i] - truth.positions[i];
    square += glm::dot(off, off) / 3;
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(truth.positions.size())), 0.010, 0.0006) << "1500 draws";
  EXPECT_EQ(noisy.positions, Spoilt(truth, {.noisy_mm = 10}, "a").positions);
  EXPECT_NE(noisy.positions, Spoilt(truth, {.noisy_mm = 10}, "b").positions);
}

/// Returns the same motion with rotations: each joint turns about Z over time; the left hip has another rest pose.
RawMotion Turning() {
  RawMotion motion = Swinging();
  motion.rest_positions.assign(5, glm::dvec3(0));
  motion.rest_rotations.assign(5, glm::dquat(1, 0, 0, 0));
  motion.rest_rotations[0] = glm::angleAxis(0.7, glm::dvec3(1, 0, 0));
  for (std::size_t i = 0; i < motion.positions.size(); ++i) {
    const double turn = 0.01 * static_cast<double>(i / 5) * (i % 5 == 0 ? 1 : 0.5);
    motion.rotations.push_back(glm::angleAxis(turn, glm::dvec3(0, 0, 1)) * motion.rest_rotations[i % 5]);
  }
  return motion;
}

double Apart(const glm::dquat& a, const glm::dquat& b) {
  return 2 * std::acos(std::min(1.0, std::abs(glm::dot(a, b))));
}

TEST(Spoilt, RotationsAreSpoiltLikePositions) {
  const RawMotion truth = Turning();
  const auto spoilt = [&](const Spoiler& spoiler) { return Spoilt(truth, spoiler, "a").rotations; };
  const auto at = [](std::size_t f, std::size_t j) { return f * 5 + j; };
  EXPECT_EQ(spoilt({.scaled_percent = 5, .lifted_cm = 5}), truth.rotations);
  // A centred moving mean does not change a rotation at constant speed.
  EXPECT_NEAR(Apart(spoilt({.smoothed_ms = 200})[at(50, 0)], truth.rotations[at(50, 0)]), 0, 1e-6);
  // Faded by 100 %, every frame is the mean rotation, which lies half-way.
  const auto faded = spoilt({.faded_percent = 100});
  EXPECT_NEAR(Apart(faded[at(0, 0)], faded[at(99, 0)]), 0, 1e-6);
  EXPECT_NEAR(Apart(faded[at(0, 0)], truth.rotations[at(0, 0)]), 0.495, 1e-6);
  // Mirroring gives the right hip the left hip's rotation from rest, mirrored. Mirroring twice changes nothing.
  const auto mirrored = spoilt({.mirrored_share = 1});
  EXPECT_NEAR(Apart(mirrored[at(60, 1)], glm::angleAxis(-0.6, glm::dvec3(0, 0, 1))), 0, 1e-6);
  RawMotion once = truth;
  once.rotations = mirrored;
  EXPECT_NEAR(Apart(Spoilt(once, {.mirrored_share = 1}, "a").rotations[at(60, 0)], truth.rotations[at(60, 0)]), 0,
              1e-6);
  // Noise of 10 mm on limbs of 420 mm turns a joint by √2 · 10 / 420 rad about each axis.
  const auto noisy = spoilt({.noisy_mm = 10});
  double square = 0;
  for (std::size_t i = 0; i < noisy.size(); ++i) square += std::pow(Apart(noisy[i], truth.rotations[i]), 2) / 3;
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(noisy.size())), std::sqrt(2.0) / 42, 0.002);
}

TEST(HideWorst, HidesTheFarthestJointsAndNoMore) {
  const RawMotion truth = Swinging();
  RawMotion answer = truth;
  for (std::size_t i = 0; i < 50; ++i) answer.positions[7 * i].x += 0.1;
  HideWorst(answer, truth, 10);  // 50 of 500 points
  for (std::size_t i = 0; i < answer.positions.size(); ++i)
    EXPECT_EQ(IsSeen(answer.positions[i]), i % 7 != 0 || i >= 350);
}

TEST(ContactsByMotion, AreOfFeetThatAreLowAndSlow) {
  RawMotion motion;
  motion.rate_hz = 30;
  using enum Role;
  int joint = 0;
  for (const Role role : {kLeftAnkle, kLeftFoot, kRightAnkle, kRightFoot}) motion.roles[Index(role)] = joint++;
  motion.joints = {"la", "lf", "ra", "rf"};
  for (int f = 0; f < 30; ++f) {
    for (const glm::dvec3& p :
         {glm::dvec3(0.006 * f, 0.1, 0), {0.006 * f, 0.04, 0}, {0.007 * f, 0.1, 0}, {0, 0.06, 0}}) {
      motion.positions.push_back(p);  // 0.18 m/s, 0.21 m/s, and toes that are too high
    }
  }
  const std::vector<bool> contacts = ContactsByMotion(motion);
  ASSERT_EQ(contacts.size(), 120u);
  for (std::size_t f = 0; f < 30; ++f) {
    EXPECT_TRUE(contacts[4 * f] && contacts[4 * f + 1]) << f;
    EXPECT_FALSE(contacts[4 * f + 2] || contacts[4 * f + 3]) << f;
  }
  motion.roles[Index(kRightFoot)] = -1;
  EXPECT_TRUE(ContactsByMotion(motion).empty());
}

}  // namespace
}  // namespace etude
