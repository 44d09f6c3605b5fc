#include "engine/transitions/joins/placing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/motion/support.h"
#include "engine/transitions/joins/splice.h"
#include "tests/engine/transitions/expect_pose.h"
#include "tests/engine/transitions/test_clips.h"

namespace etude {
namespace {

constexpr double kRate = kJudgedRateHz;

BodyMotion Gliding(int frames, double metres_per_s) {
  BodyMotion motion = StandingClip(frames, 20);
  for (int f = 0; f < frames; ++f) motion.poses[f] = FloorMove{.z = metres_per_s * f / kRate}.Apply(motion.poses[f]);
  return motion;
}

PosePair EndOf(const BodyMotion& motion, int frame) { return {motion.poses[frame - 1], motion.poses[frame]}; }

TEST(CarriedShift, StopsAPointMassOverItsCapturePoint) {
  constexpr double kSpeed = 1.7, kHeight = 0.9, kGravity = 9.81;
  const BodyMotion glides = Gliding(10, kSpeed), stands = Gliding(60, 0);
  const double seconds = 2 * std::sqrt(kHeight / kGravity);  // 0.606 s, nearly 18 frames
  const int frames = static_cast<int>(std::lround(seconds * kRate));
  const glm::dvec3 shift = CarriedShift(EndOf(glides, 6), glides.poses[6], EndOf(stands, frames), frames);
  const double capture = glides.poses[6][Role::kHipCentre].z + kSpeed * std::sqrt(kHeight / kGravity);
  EXPECT_NEAR(stands.poses[0][Role::kHipCentre].z + shift.z, capture,
              0.5 * kSpeed * std::abs(frames / kRate - seconds) + 1e-12);
  EXPECT_NEAR(shift.x, 0, 1e-12);
}

TEST(CarriedShift, LetsABodyGoOnThatKeepsItsSpeed) {
  const BodyMotion glides = Gliding(60, 1.7);
  // The same clip is left at frame 30 and entered at frame 12, so its path is shifted by the way of 18 frames.
  const glm::dvec3 shift = CarriedShift(EndOf(glides, 30), glides.poses[30], EndOf(glides, 24), 12);
  EXPECT_NEAR(shift.z, 1.7 * 18 / kRate, 1e-12);
}

TEST(Splice, BrakesEvenlyWhereMomentumCarriesIt) {
  constexpr double kSpeed = 1.5, kSeconds = 1;
  const std::vector<BodyMotion> clips = {Gliding(90, kSpeed), Gliding(90, 0)};
  const auto joined = [&](bool carried) {
    std::vector<Segment> way = {{.clip = 0, .first = 0, .last = 40, .own = {}},
                                {.clip = 1, .first = 0, .last = 89, .own = {}}};
    way.back().preferred = PreferredJoin{.blend_s = kSeconds, .way = JoinStyle::kDirect, .carried = carried};
    return SpliceSegments(clips, way, *FindJoin("planted-feet")).motion.poses;
  };
  const auto hardest = [&](const std::vector<BodyPose>& poses) {
    double most = 0;
    for (std::size_t f = 41; f + 1 < poses.size(); ++f) {
      const auto z = [&](std::size_t k) { return poses[k][Role::kHipCentre].z; };
      most = std::max(most, std::abs(z(f + 1) - 2 * z(f) + z(f - 1)) * kRate * kRate);
    }
    return most;
  };
  const std::vector<BodyPose> carried = joined(true);
  EXPECT_NEAR(carried.back()[Role::kHipCentre].z - carried[40][Role::kHipCentre].z, 0.5 * kSpeed * kSeconds, 1e-9);
  // A quintic that goes in time T from speed v to rest over the distance v T/2 has the deceleration 6 v s (1 − s)/T
  // at time s T, at most 1.5 v/T.
  EXPECT_NEAR(hardest(carried), 1.5 * kSpeed / kSeconds, 0.01);
  for (std::size_t f = 40; f + 1 < carried.size(); ++f) {
    EXPECT_GE(carried[f + 1][Role::kHipCentre].z, carried[f][Role::kHipCentre].z - 1e-9) << "it never goes back";
  }
  EXPECT_GT(hardest(joined(false)), 1.2 * hardest(carried));
}

}  // namespace
}  // namespace etude
