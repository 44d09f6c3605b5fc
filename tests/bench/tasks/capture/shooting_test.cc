#include "bench/tasks/capture/shooting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "engine/retargeting/rig.h"
#include "sim/character/characters.h"
#include "sim/choreography/canonical_body.h"
#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<BodyPose> Poses(std::size_t count, const std::function<double(double)>& x) {
  std::vector<BodyPose> poses;
  for (std::size_t k = 0; k < count; ++k) {
    BodyPose pose = StandingPose();
    for (glm::dvec3& joint : pose.joints) joint.x += x(static_cast<double>(k));
    poses.push_back(pose);
  }
  return poses;
}

double PlaceOf(const BodyPose& pose) { return pose[Role::kHead].x - StandingPose()[Role::kHead].x; }

TEST(PoseAt, IsTheVeryPoseAtAFrameAndHeldBeyondTheEnds) {
  const std::vector<BodyPose> poses = Poses(6, [](double k) { return std::sin(k); });
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(PoseAt(poses, static_cast<double>(k)).joints, poses[k].joints);
  }
  EXPECT_EQ(PoseAt(poses, -0.7).joints, poses.front().joints);
  EXPECT_EQ(PoseAt(poses, 9).joints, poses.back().joints);
  EXPECT_EQ(PoseAt(std::span(poses).first(1), 0.4).joints, poses.front().joints);
}

// The Catmull–Rom curve reproduces a parabola exactly if it knows points on both sides.
TEST(PoseAt, FollowsParabolasExactly) {
  const std::vector<BodyPose> poses = Poses(8, [](double k) { return 0.01 * k * k - 0.05 * k; });
  for (double t = 1; t <= 6; t += 0.125) EXPECT_NEAR(PlaceOf(PoseAt(poses, t)), 0.01 * t * t - 0.05 * t, 1e-12);
}

CaptureWorld WorldOf(std::vector<BodyPose> poses) {
  CaptureWorld world{.truth = std::move(poses)};
  world.brightness.assign(world.truth.size(), 1);
  world.colours = PerformerColours();
  world.cameras = {LookAt({}, {-2.4, 1.2, 3}, {0, 0.95, 0}), LookAt({}, {2.4, 2.2, 3}, {0, 0.95, 0})};
  return world;
}

constexpr WorldKey kShootingKey{.suite_seed = 5, .scenario = "shooting", .trial = 0};

TEST(Shooting, ShowsWhatStandsThereAtTheCamerasOwnTime) {
  ASSERT_OK(renderer, SharedRenderer());
  const CaptureWorld world = WorldOf(Poses(9, [](double k) { return 0.05 * k; }));
  const CameraEffects late{.sync_offset_ms = 50, .noise = 0};
  Shooting shooting(world, late, kShootingKey, **renderer);
  const double time = shooting.camera(1).shutter().TimeOf(4);
  EXPECT_NEAR(std::abs(time - 4), 1.5, 1e-12);
  EXPECT_EQ(shooting.camera(0).shutter().TimeOf(4), 4);
  EXPECT_EQ(shooting.SeenPose(1, 4).joints, PoseAt(world.truth, time).joints);

  CaptureWorld then = WorldOf({PoseAt(world.truth, time)});
  Shooting punctual(then, {.noise = 0}, kShootingKey, **renderer);
  EXPECT_EQ(shooting.Shoot(1, 4, Targets::kAll).colour.pixels, punctual.Shoot(1, 0, Targets::kAll).colour.pixels);
  EXPECT_NE(shooting.Shoot(0, 4, Targets::kAll).colour.pixels, punctual.Shoot(0, 0, Targets::kAll).colour.pixels);
}

// The figure is a file's own. The world shows it from frame 4 on of a clip that moves away from the origin.
TEST(Shooting, ShowsAClipsOwnFigureWhereItsBodyIs) {
  ASSERT_OK(renderer, SharedRenderer());
  const auto mannequin = std::make_shared<const Character>(MannequinCharacter());
  BodyConversion body{.metres_per_unit = 1};
  body.motion = {.rate_hz = 30, .poses = Poses(12, [](double k) { return 0.5 * k; })};
  Clip clip = RigClip(body.motion, StandingPose(), "walk");
  clip.skeleton = mannequin->skeleton;
  ASSERT_OK(map, FindJointMap(clip.skeleton, "walk"));

  constexpr std::size_t kFirst = 4;
  const FloorMove move{.yaw = 0.3, .x = -2, .z = 0.6};
  std::vector<BodyPose> truth;
  for (const BodyPose& pose : std::span(body.motion.poses).subspan(kFirst, 2)) truth.push_back(move.Apply(pose));
  CaptureWorld world = WorldOf(std::move(truth));
  world.own = {std::make_shared<const RecordedFigure>(mannequin, clip, *map, body), kFirst, move};
  Shooting shooting(world, {.noise = 0}, kShootingKey, **renderer);
  for (const std::size_t frame : {0, 1}) {
    const LabelImage labels = shooting.Shoot(0, frame, Targets::kAll).labels;
    const auto label_between = [&](Role from, Role to) {
      const glm::dvec3 middle = 0.5 * (world.truth[frame][from] + world.truth[frame][to]);
      const glm::ivec2 pixel(*Project(world.cameras[0], middle));
      return static_cast<Part>(labels.pixels[static_cast<std::size_t>(pixel.y * labels.width + pixel.x)]);
    };
    EXPECT_EQ(label_between(Role::kLeftKnee, Role::kLeftAnkle), Part::kLeftShank);
    EXPECT_EQ(label_between(Role::kRightHip, Role::kRightKnee), Part::kRightThigh);
    EXPECT_EQ(label_between(Role::kRightElbow, Role::kRightWrist), Part::kRightForearm);
    EXPECT_EQ(label_between(Role::kSpine, Role::kShoulderCentre), Part::kTrunk);
  }
}

TEST(Shooting, RollsExactlyBandByBand) {
  ASSERT_OK(renderer, SharedRenderer());
  const CaptureWorld world = WorldOf(Poses(9, [](double k) { return 0.08 * k; }));
  Shooting rolling(world, {.rolling_shutter_ms = 30, .noise = 0}, kShootingKey, **renderer);
  const View view = rolling.Shoot(0, 4, Targets::kAll);
  int differing = 0;
  for (const Shutter::Band& band : rolling.camera(0).shutter().BandsOf(4, 480)) {
    CaptureWorld then = WorldOf({PoseAt(world.truth, band.time)});
    Shooting still(then, {.noise = 0}, kShootingKey, **renderer);
    const View whole = still.Shoot(0, 0, Targets::kAll);
    for (int y = band.rows.first; y < band.rows.end; ++y) {
      for (int x = 0; x < 640; ++x) {
        ASSERT_EQ(view.colour.At(x, y), whole.colour.At(x, y));
        ASSERT_EQ(view.labels.At(x, y), whole.labels.At(x, y));
        ASSERT_EQ(view.depth.At(x, y), whole.depth.At(x, y));
      }
    }
    Shooting global(world, {.noise = 0}, kShootingKey, **renderer);
    differing += global.Shoot(0, 4, Targets::kAll).labels.pixels != whole.labels.pixels;
  }
  EXPECT_EQ(differing, 8) << "none of the bands is the picture of the middle";
}

TEST(Shooting, OfTheTruthHasLensAndClockAndNoFaults) {
  const CameraEffects all{.sync_offset_ms = 1,
                          .clock_drift_ppm = 2,
                          .rolling_shutter_ms = 3,
                          .motion_blur = 0.4,
                          .radial_distortion = 0.05,
                          .tangential_distortion = 0.01,
                          .defocus_px = 1,
                          .vignette = 1,
                          .dust = 0.1,
                          .exposure_ev = 1,
                          .exposure_drift_ev = 1,
                          .gain_db = 3,
                          .white_balance_ev = 1,
                          .white_balance_drift_ev = 1,
                          .bayer = 1,
                          .noise = 2,
                          .jpeg_loss = 10};
  const CameraEffects kept = FaultlessPictures(all);
  EXPECT_EQ(kept.sync_offset_ms, 1);
  EXPECT_EQ(kept.clock_drift_ppm, 2);
  EXPECT_EQ(kept.rolling_shutter_ms, 3);
  EXPECT_EQ(kept.radial_distortion, 0.05);
  EXPECT_EQ(kept.tangential_distortion, 0.01);
  for (const double strength :
       {kept.motion_blur, kept.defocus_px, kept.vignette, kept.dust, kept.exposure_ev, kept.exposure_drift_ev,
        kept.gain_db, kept.white_balance_ev, kept.white_balance_drift_ev, kept.bayer, kept.noise, kept.jpeg_loss}) {
    EXPECT_EQ(strength, 0);
  }
}

}  // namespace
}  // namespace etude
