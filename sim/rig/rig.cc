#include "sim/rig/rig.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "sim/render/scene.h"

namespace etude {
namespace {

constexpr double kAimHeight = 0.95;      // height of the centre of a standing body, metres
constexpr double kFlesh = 0.15;          // metres of flesh around a joint that must also be in the picture
constexpr double kWallDistance = 0.3;    // minimum distance from the wall, metres
constexpr double kMinFocalShare = 0.5;   // minimum focal length as a share of the usual focal length
constexpr double kPositionError = 0.05;  // standard deviations from here on: position on the floor, metres
constexpr double kHeightError = 0.03;    // metres
constexpr double kAngleError = 2;        // degrees
constexpr double kAimError = 0.02;       // metres

// The intended position of a camera, relative to the middle of the motion.
struct Stand {
  double angle_deg = 0;
  double height = 0;
  double aside = 0;  // offset to the camera's own right, metres
};

std::vector<Stand> StandsOf(const RigOptions& options) {
  std::vector<Stand> stands;
  const auto add = [&](double angle_deg, double aside = 0) {
    stands.push_back({angle_deg, options.heights_m[stands.size() % options.heights_m.size()], aside});
  };
  switch (options.shape) {
    case RigShape::kAngles:
      for (const double angle_deg : options.angles_deg) add(angle_deg);
      break;
    case RigShape::kStereo:
      for (const double side : {-0.5, 0.5}) add(0, side * options.baseline_m);
      for (Stand& stand : stands) stand.height = options.heights_m.front();
      break;
    case RigShape::kRing:
      for (int i = 0; i < options.cameras; ++i) add(360.0 * i / options.cameras);
      break;
    case RigShape::kCorners:
      for (const double angle_deg : {-45, 45, 135, -135}) add(angle_deg);
      break;
    case RigShape::kFile:
      break;
  }
  return stands;
}

glm::dvec3 OnFloor(double angle) { return {std::sin(angle), 0, std::cos(angle)}; }

// Returns a camera's distance from `middle`: `wanted`, or less if the back wall is in the way.
double DistanceWithin(const glm::dvec3& middle, const glm::dvec3& outwards, double wanted) {
  if (outwards.z >= 0) return wanted;
  const double to_wall = (kWallZ + kWallDistance - middle.z) / outwards.z;
  return std::min(wanted, std::max(to_wall, kWallDistance));
}

// Returns the largest focal length, as a share of the usual focal length, with which `point` and the flesh around it
// stay in the picture.
double LensFor(const Camera& camera, const glm::dvec3& point) {
  const glm::dvec3 p_C = camera.R_CW * (point - camera.p_WC);
  if (p_C.z <= kFlesh) return 0;
  const Intrinsics& inside = camera.intrinsics;
  const double across = inside.fx * (std::abs(p_C.x) + kFlesh) / p_C.z;
  const double along = inside.fy * (std::abs(p_C.y) + kFlesh) / p_C.z;
  return std::min(0.5 * inside.width / across, 0.5 * inside.height / along);
}

void ChooseLens(std::span<const BodyPose> motion, Camera& camera) {
  double lens = 1;
  for (const BodyPose& pose : motion) {
    for (const glm::dvec3& joint : pose.joints) lens = std::min(lens, LensFor(camera, joint));
  }
  lens = std::max(lens, kMinFocalShare);
  camera.intrinsics.fx *= lens;
  camera.intrinsics.fy *= lens;
}

Camera SetUp(const Stand& stand, const glm::dvec3& middle, double distance, RandomStream& random) {
  const double angle = Radians(stand.angle_deg + random.Normal(0, kAngleError));
  const double wanted = distance + random.Normal(0, kPositionError);
  const double height = stand.height + random.Normal(0, kHeightError);
  const double aim_x = random.Normal(0, kAimError), aim_y = kAimHeight + random.Normal(0, kAimError);
  const glm::dvec3 outwards = OnFloor(angle), aside = stand.aside * OnFloor(angle + kPi / 2);
  const glm::dvec3 foot = middle + DistanceWithin(middle, outwards, wanted) * outwards + aside;
  return LookAt({}, foot + glm::dvec3(0, height, 0), middle + glm::dvec3(aim_x, aim_y, 0) + aside);
}

// Returns the point nearest to all optical axes in the least-squares sense. If the axes are parallel, returns a point
// some metres in front of the cameras.
glm::dvec3 CommonMiddle(std::span<const Camera> cameras) {
  constexpr double kAhead = 3;          // metres in front of the cameras
  constexpr double kHintWeight = 1e-3;  // small: the point ahead matters only if the axes are nearly parallel
  glm::dmat3 normal(0);
  glm::dvec3 right(0);
  for (const Camera& camera : cameras) {
    const glm::dvec3 axis = glm::transpose(camera.R_CW)[2];
    const glm::dmat3 across = glm::dmat3(1) - glm::outerProduct(axis, axis);
    normal += across + kHintWeight * glm::dmat3(1);
    right += across * camera.p_WC + kHintWeight * (camera.p_WC + kAhead * axis);
  }
  return glm::inverse(normal) * right;
}

std::vector<Camera> MovedTo(const glm::dvec3& middle, std::vector<Camera> cameras) {
  const glm::dvec3 way = middle - CommonMiddle(cameras);
  for (Camera& camera : cameras) camera.p_WC += glm::dvec3(way.x, 0, way.z);
  return cameras;
}

}  // namespace

glm::dvec3 MiddleOnFloor(std::span<const BodyPose> motion) {
  glm::dvec3 low = motion.front().joints.front(), high = low;
  for (const BodyPose& pose : motion) {
    for (const glm::dvec3& joint : pose.joints) {
      low = glm::min(low, joint);
      high = glm::max(high, joint);
    }
  }
  const glm::dvec3 middle = 0.5 * (low + high);
  return {middle.x, 0, middle.z};
}

std::vector<Camera> SetUpCameras(const RigOptions& options, std::span<const BodyPose> motion, const WorldKey& key) {
  const glm::dvec3 middle = MiddleOnFloor(motion);
  if (options.shape == RigShape::kFile) return MovedTo(middle, options.own);
  std::vector<Camera> cameras;
  for (const Stand& stand : StandsOf(options)) {
    RandomStream random(key, fmt::format("capture/camera-{}/place", cameras.size()));
    cameras.push_back(SetUp(stand, middle, options.distance_m, random));
    ChooseLens(motion, cameras.back());
  }
  return cameras;
}

bool IsInPicture(const Camera& camera, const BodyPose& pose) {
  return std::ranges::all_of(pose.joints, [&](const glm::dvec3& joint) {
    const auto pixel = Project(camera, joint);
    return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x < camera.intrinsics.width &&
           pixel->y < camera.intrinsics.height;
  });
}

std::vector<bool> FramesInView(std::span<const Camera> cameras, std::span<const BodyPose> motion) {
  std::vector<bool> in_view;
  for (const BodyPose& pose : motion) {
    const auto seeing = std::ranges::count_if(cameras, [&](const Camera& camera) { return IsInPicture(camera, pose); });
    in_view.push_back(seeing >= 2);
  }
  return in_view;
}

}  // namespace etude
