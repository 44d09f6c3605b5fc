// Finds the up axis from people in every posture, with usual camera set-ups; the truth must lie within the stated
// angle.
#include "engine/keypoints/find_up.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/cameras/triangulation.h"
#include "engine/keypoints/place_rig.h"
#include "tests/support/random_clip.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::Dice;
using ::testing::HasSubstr;
using enum Landmark;

constexpr double kPostureRate = 15;
constexpr int kPostureFrames = 45;
const std::vector<std::string> kPostures = {"sits", "crawls", "lies", "squats", "bows"};

glm::dmat3 AboutX(double radians) { return glm::mat3_cast(glm::angleAxis(radians, glm::dvec3(1, 0, 0))); }
glm::dmat3 AboutY(double radians) { return glm::mat3_cast(glm::angleAxis(radians, glm::dvec3(0, 1, 0))); }
glm::dmat3 AboutZ(double radians) { return glm::mat3_cast(glm::angleAxis(radians, glm::dvec3(0, 0, 1))); }

/// A posture's angles, radians, positive towards the front (+Z): limbs from straight down, the trunk from straight up.
struct Posture {
  double trunk = 0, thigh = 0, shank = 0, arm = 0;
  double foot = 0;        ///< angle of the sole from level, toes down
  double roll = 0;        ///< angle of the body about its long axis
  double left_ahead = 0;  ///< angle by which the left leg is ahead
};

/// A person of random stature and foot shape, by forward kinematics. Each lowest landmark has its own height above the
/// floor: foot, knee or trunk.
class PosedPerson {
 public:
  explicit PosedPerson(Dice& dice) : stature(1.7 + 0.15 * dice.Signed()) {
    heel = 0.03 + 0.02 * dice.Signed();
    toe = 0.02 + 0.01 * dice.Signed();
    ankle = 0.08 + 0.02 * dice.Signed();
  }

  LandmarkPositions Posed(const Posture& p, const glm::dvec3& at, double yaw) const {
    LandmarkPositions places;
    const double s = stature / 1.7;
    const auto ahead = [](double angle) { return glm::dvec3(0, -std::cos(angle), std::sin(angle)); };
    double lowest = 1e9;
    const auto put = [&](Landmark landmark, const glm::dvec3& place, double radius) {
      places[Index(landmark)] = place;
      lowest = std::min(lowest, place.y - radius * s);
    };
    const glm::dvec3 up_trunk(0, std::cos(p.trunk), std::sin(p.trunk));
    for (const double side : {1.0, -1.0}) {
      const bool left = side > 0;
      const glm::dvec3 hip(0.1 * side * s, 0, 0), shoulder = 0.5 * s * up_trunk + glm::dvec3(0.18 * side * s, 0, 0);
      const double more = left ? p.left_ahead : -p.left_ahead;
      const glm::dvec3 knee = hip + 0.42 * s * ahead(p.thigh + more), low = knee + 0.42 * s * ahead(p.shank + more);
      const glm::dvec3 sole(0, -std::sin(p.foot), std::cos(p.foot)), under(0, -std::cos(p.foot), -std::sin(p.foot));
      put(left ? kLeftHip : kRightHip, hip, 0.1);
      put(left ? kLeftShoulder : kRightShoulder, shoulder, 0.1);
      put(left ? kLeftKnee : kRightKnee, knee, 0.05);
      put(left ? kLeftAnkle : kRightAnkle, low, 0.05);
      const glm::dvec3 elbow = shoulder + 0.28 * s * ahead(p.arm), wrist = elbow + 0.26 * s * ahead(p.arm);
      put(left ? kLeftElbow : kRightElbow, elbow, 0.04);
      put(left ? kLeftWrist : kRightWrist, wrist, 0.04);
      put(left ? kLeftHeel : kRightHeel, low - 0.05 * s * sole + (ankle - heel) * s * under, 0.03);
      put(left ? kLeftBigToe : kRightBigToe, low + 0.15 * s * sole + (ankle - toe) * s * under, 0.02);
      put(left ? kLeftSmallToe : kRightSmallToe,
          low + 0.13 * s * sole + (ankle - toe) * s * under + glm::dvec3(0.05 * side * s, 0, 0), 0.02);
    }
    put(kNose, (0.68 * s) * up_trunk, 0.1);
    for (auto& place : places) {
      if (!place) continue;
      *place = AboutY(yaw) * (*place - glm::dvec3(0, lowest, 0)) + at;
    }
    return places;
  }

  double stature;

 private:
  double heel, toe, ankle;
};

/// Returns three seconds of a posture: the trunk sways, the arms swing, and a crawling person moves on.
std::vector<LandmarkPositions> Motion(const std::string& kind, Dice& dice) {
  const PosedPerson body(dice);
  Posture base;
  const double yaw = kPi * dice.Signed(), way = dice.Signed();
  const glm::dvec3 at(0.5 * dice.Signed(), 0, 0.5 * dice.Signed());
  base.arm = 0.3 * dice.Signed();
  if (kind == "sits") {
    base = {.trunk = 0.1 + 0.25 * dice.Signed(), .thigh = kPi / 2 + 0.1 * dice.Signed(), .shank = 0.25 * dice.Signed()};
  } else if (kind == "crawls") {
    base = {.trunk = kPi / 2 - 0.1,
            .thigh = 0.1 * dice.Signed(),
            .shank = -kPi / 2,
            .arm = 0.1 * dice.Signed(),
            .foot = 1.2 + 0.3 * dice.Signed()};
  } else if (kind == "lies") {
    const double turned = dice.Below(2) == 0 ? 1 : -1;  // on the back or on the belly
    base = {.trunk = turned * kPi / 2,
            .thigh = -turned * (kPi / 2 - 0.1),
            .shank = -turned * kPi / 2,
            .arm = -turned * kPi / 2,
            .foot = turned > 0 ? 1.3 : -1.2};
  } else if (kind == "squats") {
    const bool on_toes = dice.Below(2) == 0;
    base = {.trunk = 0.5 + 0.2 * dice.Signed(),
            .thigh = 1.9 + 0.2 * dice.Signed(),
            .shank = -0.6 + 0.1 * dice.Signed(),
            .foot = on_toes ? 0.6 : 0.0};
  } else if (kind == "bows") {
    base = {.trunk = 1 + 0.4 * dice.Signed(), .thigh = -0.1, .shank = -0.1};
  }
  const double stride = kind == "crawls" ? 0.15 : 0.0;
  const double slow = 1 + 0.3 * way;
  std::vector<LandmarkPositions> frames;
  for (int k = 0; k < kPostureFrames; ++k) {
    const double t = k / kPostureRate, sway = std::sin(2 * slow * t);
    Posture now = base;
    now.trunk += 0.06 * sway;
    now.arm += 0.3 * std::sin(3 * slow * t);
    now.left_ahead = stride * std::sin(4 * t);
    frames.push_back(body.Posed(now, at + AboutY(yaw) * glm::dvec3(0, 0, stride * t), yaw));
    if (kind == "crawls") continue;
    // The feet stay; only the rest sways.
    for (const Landmark foot :
         {kLeftAnkle, kRightAnkle, kLeftHeel, kRightHeel, kLeftBigToe, kRightBigToe, kLeftSmallToe, kRightSmallToe}) {
      frames.back()[Index(foot)] = frames.front()[Index(foot)];
    }
  }
  return frames;
}

/// Returns cameras around the middle, as on tripods that are level to about 1.5°.
std::vector<NamedCamera> TripodCameras(int count, double roll_deg, Dice& dice) {
  std::vector<NamedCamera> cameras;
  const double first = kPi * dice.Signed();
  for (int i = 0; i < count; ++i) {
    const double angle = first + (i + 0.25 * dice.Signed()) * kPi * (count == 2 ? 0.5 : 2.0 / count);
    const double far = 4 + dice.Signed();
    const glm::dvec3 at(far * std::cos(angle), 1.5 + 0.8 * dice.Signed(), far * std::sin(angle));
    Camera camera = LookAt({1280, 720, 1000, 1000, 640, 360, 0}, at, {0, 0.7 + 0.2 * dice.Signed(), 0});
    const double roll = roll_deg * (dice.Signed() + dice.Signed() + dice.Signed());  // its deviation is roll_deg
    camera.R_CW = AboutZ(Radians(roll)) * camera.R_CW;
    cameras.push_back({"cam" + std::to_string(i + 1), camera});
  }
  return cameras;
}

/// A motion in cameras' keypoints with errors of `noise_px`, triangulated in the first camera's frame.
struct Take {
  RigFile rig;
  std::vector<LandmarkPositions> points;
  glm::dvec3 up{0};  ///< true up axis
};

Take FilmedTake(const std::vector<LandmarkPositions>& motion, const std::vector<NamedCamera>& cameras, double noise_px,
                const glm::dmat3& R_FW, const glm::dvec3& p_FW, Dice& dice, bool only_ankles = false) {
  Take take;
  take.rig.format = "Pose2Sim";
  take.up = R_FW * glm::dvec3(0, 1, 0);
  std::vector<ProjectionMatrix> matrices;
  for (NamedCamera named : cameras) {
    named.camera.R_CW = named.camera.R_CW * glm::transpose(R_FW);
    named.camera.p_WC = R_FW * named.camera.p_WC + p_FW;
    take.rig.cameras.push_back(named);
    matrices.push_back(MatrixOf(named.camera));
  }
  for (const LandmarkPositions& frame : motion) {
    LandmarkPositions& seen = take.points.emplace_back();
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      if (!frame[i] || (only_ankles && i >= Index(kLeftBigToe))) continue;
      std::vector<Sighting> sightings;
      for (const ProjectionMatrix& matrix : matrices) {
        const auto pixel = Project(matrix, R_FW * *frame[i] + p_FW);
        const glm::dvec2 off = noise_px * glm::dvec2(dice.Signed() + dice.Signed(), dice.Signed() + dice.Signed());
        if (pixel) sightings.push_back({matrix, *pixel + off});
      }
      const TriangulatedPoint point = Triangulate(sightings);
      if (point.status == PointStatus::kOk) seen[i] = point.position;
    }
  }
  return take;
}

Take InFirstCamera(const std::vector<LandmarkPositions>& motion, const std::vector<NamedCamera>& cameras,
                   double noise_px, Dice& dice, bool only_ankles = false) {
  const Camera& first = cameras.front().camera;
  return FilmedTake(motion, cameras, noise_px, first.R_CW, -(first.R_CW * first.p_WC), dice, only_ankles);
}

struct Covered {
  int takes = 0, covered = 0, refused = 0;
  double worst_deg = 0, sum_told_deg = 0;
};

Covered Cover(int takes, std::uint64_t seed, double roll_deg, double noise_px) {
  Covered counted;
  for (int i = 0; i < takes; ++i) {
    Dice dice(seed + static_cast<std::uint64_t>(i));
    const auto motion = Motion(kPostures[static_cast<std::size_t>(i) % kPostures.size()], dice);
    const auto cameras = TripodCameras(2 + static_cast<int>(dice.Below(3)), roll_deg, dice);
    const Take take = InFirstCamera(motion, cameras, noise_px, dice, dice.Below(3) == 0);
    const FoundUp found = FindUp(take.rig.cameras, take.points, kPostureRate, 1.7, 1);
    const double off = AngleBetween(found.up, take.up);
    ++counted.takes;
    counted.covered += off <= found.within;
    counted.worst_deg = std::max(counted.worst_deg, Degrees(off));
    counted.sum_told_deg += Degrees(found.within);
  }
  return counted;
}

TEST(FindUp, TheTruthIsWithinTheAngleToldInWhateverPosture) {
  for (const double noise_px : {0.0, 1.5}) {
    const Covered covered = Cover(15, 700, 1.5, noise_px);
    EXPECT_GE(covered.covered, 14) << "at " << noise_px << " px; worst " << covered.worst_deg << "°";
    EXPECT_LT(covered.worst_deg, 10);
    EXPECT_LT(covered.sum_told_deg / covered.takes, 10) << "an angle so wide says nothing";
  }
}

TEST(FindUp, HEAVY_TheTruthIsWithinTheAngleToldInNinetyFiveTakesOfAHundred) {
  for (const double roll_deg : {0.0, 1.5, 4.0}) {
    for (const double noise_px : {0.0, 1.0, 3.0}) {
      const Covered covered = Cover(60, 7000, roll_deg, noise_px);
      EXPECT_GE(covered.covered, 57) << roll_deg << "° rolled, " << noise_px << " px; worst " << covered.worst_deg;
      EXPECT_LT(covered.sum_told_deg / covered.takes, 12);
      fmt::print(
          "cameras rolled {}°, keypoints {} px off: {} of {} takes within the angle told, {:.1f}° in the mean; the "
          "worst {:.1f}° off\n",
          roll_deg, noise_px, covered.covered, covered.takes, covered.sum_told_deg / covered.takes, covered.worst_deg);
    }
  }
}

TEST(FindUp, AFilesOwnAxisIsKeptWhateverThePosture) {
  // The world of a Pose2Sim rig has Y up, like ours. If a file's world has Z up, exactly Z is found, and not an axis
  // estimated from the posture.
  for (std::size_t i = 0; i < kPostures.size(); ++i) {
    Dice dice(40 + i);
    const auto motion = Motion(kPostures[i], dice);
    const auto cameras = TripodCameras(3, 1, dice);
    const Take as_said = FilmedTake(motion, cameras, 1, glm::dmat3(1), {1, 2, 3}, dice);
    ASSERT_OK(kept, PlaceRig(as_said.rig, as_said.points, kPostureRate, {}));
    EXPECT_EQ(kept->R, glm::dmat3(1)) << kPostures[i] << ": " << kept->told;
    const Take z_up = FilmedTake(motion, cameras, 1, AboutX(kPi / 2), {1, 2, 3}, dice);
    ASSERT_OK(found, PlaceRig(z_up.rig, z_up.points, kPostureRate, {}));
    EXPECT_LT(AngleBetween(found->R * z_up.up, {0, 1, 0}), 1e-9) << kPostures[i] << ": " << found->told;
    EXPECT_THAT(found->told, HasSubstr("up is z (found: "));
  }
}

TEST(FindUp, CamerasInPortraitAreReadAsTurnedAndTheirUpIsFound) {
  for (std::size_t i = 0; i < 6; ++i) {
    Dice dice(90 + i);
    const auto motion = Motion(i == 0 ? "stands" : kPostures[i - 1], dice);
    auto cameras = TripodCameras(3, 1, dice);
    cameras[i % 3].camera.R_CW = AboutZ(Radians(i % 2 == 0 ? 90 : -90)) * cameras[i % 3].camera.R_CW;
    const Take take = InFirstCamera(motion, cameras, 1, dice);
    const FoundUp found = FindUp(take.rig.cameras, take.points, kPostureRate, 1.7, 1);
    EXPECT_LT(AngleBetween(found.up, take.up), found.within) << i;
    EXPECT_LT(found.within, Radians(15)) << i;
  }
}

TEST(FindUp, AHandstandIsNotTurnedUpsideDownAndMayBeAskedFor) {
  Dice dice(5);
  auto motion = Motion("stands", dice);
  for (LandmarkPositions& frame : motion) {
    for (auto& place : frame) {
      if (place) *place = AboutZ(kPi) * *place + glm::dvec3(0, 2, 0);
    }
  }
  const Take take = FilmedTake(motion, TripodCameras(2, 1, dice), 0, glm::dmat3(1), {0, 0, 0}, dice);
  for (const char* up : {"auto", "y"}) {
    ASSERT_OK(place, PlaceRig(take.rig, take.points, kPostureRate, {.up = up}));
    EXPECT_EQ(place->R, glm::dmat3(1)) << place->told;
  }
}

TEST(FindUp, JumpsTellGravityWhereFeetAndCamerasTellLittle) {
  // Two neighbouring cameras, both rolled by 4°: only the free flight shows gravity.
  Dice dice(12);
  const auto standing = Motion("sits", dice);  // a sitting pose: the legs are tucked in the jump
  std::vector<LandmarkPositions> motion;
  for (int k = 0; k < 60; ++k) {
    LandmarkPositions frame = standing.front();
    const double t = std::fmod(k / 60.0, 0.5), height = 9.81 / 2 * t * (0.5 - t);
    for (auto& place : frame) {
      if (place) *place += glm::dvec3(0.4 * k / 60.0, height, 0);
    }
    motion.push_back(frame);
  }
  std::vector<NamedCamera> cameras;
  for (const double x : {-0.6, 0.6}) {
    Camera camera = LookAt({1280, 720, 1000, 1000, 640, 360, 0}, {x, 1.2, 4}, {0, 0.9, 0});
    camera.R_CW = AboutZ(Radians(4)) * camera.R_CW;
    cameras.push_back({x < 0 ? "a" : "b", camera});
  }
  const Take take = InFirstCamera(motion, cameras, 0, dice);
  const FoundUp found = FindUp(take.rig.cameras, take.points, 60, 1.7, 1);
  EXPECT_THAT(found.by, HasSubstr("gravity in jumps"));
  EXPECT_LT(Degrees(AngleBetween(found.up, take.up)), Degrees(found.within));
  // The control: without a jump.
  const FoundUp still = FindUp(take.rig.cameras, std::span(take.points).first(1), 60, 1.7, 1);
  EXPECT_THAT(still.by, ::testing::Not(HasSubstr("gravity")));
  EXPECT_LT(AngleBetween(found.up, take.up), 0.7 * AngleBetween(still.up, take.up));
}

}  // namespace
}  // namespace etude
