#include "sim/sensors/skeleton_sensor.h"

#include <cmath>
#include <optional>
#include <utility>

#include "sim/body/shape.h"
#include "sim/sensors/skeleton_errors.h"

namespace etude {
namespace {

using enum Role;

std::vector<HiddenJoints> FindHidden(const BodyMotion& truth, const glm::dvec3& eye) {
  std::vector<HiddenJoints> hidden(truth.poses.size());
  for (std::size_t t = 0; t < truth.poses.size(); ++t) {
    const std::vector<Capsule> flesh = BodyCapsules(truth.poses[t]);
    for (Role role : AllRoles()) hidden[t][Index(role)] = IsHidden(flesh, truth.poses[t], role, eye);
  }
  return hidden;
}

bool IsInView(const Camera& camera, const ProjectionMatrix& matrix, const glm::dvec3& point) {
  const std::optional<glm::dvec2> pixel = Project(matrix, point);
  return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x < camera.intrinsics.width &&
         pixel->y < camera.intrinsics.height;
}

void Exchange(SensedFrame& frame, std::initializer_list<Role> left_joints) {
  for (Role role : left_joints) std::swap(frame[role], frame[Mirrored(role)]);
}

}  // namespace

Camera SkeletonSensorAt(double distance, double turn) {
  constexpr double kHeight = 1.0;
  const Intrinsics depth_camera{.width = 640, .height = 480, .fx = 580, .fy = 580, .cx = 320, .cy = 240, .skew = 0};
  const glm::dvec3 eye(distance * std::sin(turn), kHeight, distance * std::cos(turn));
  return LookAt(depth_camera, eye, {0, kHeight, 0});
}

SkeletonStream SenseSkeleton(const BodyMotion& truth, const Camera& sensor, const SkeletonSensorOptions& options,
                             const WorldKey& world) {
  const std::size_t count = truth.poses.size();
  const auto hidden = FindHidden(truth, sensor.p_WC);
  const auto errors = ContinuousErrors(truth, options, world);
  const auto guesses = OcclusionGuesses(truth, hidden, options, world);
  const auto outliers = Outliers(count, options, world);
  const auto swaps = Swaps(count, truth.rate_hz, options, world);
  const auto dropouts = Dropouts(count, options, world);
  const ProjectionMatrix view = MatrixOf(sensor);

  SkeletonStream stream{.rate_hz = truth.rate_hz, .frames = {}};
  stream.frames.reserve(count);
  SensedFrame last;
  for (std::size_t t = 0; t < count; ++t) {
    SensedFrame frame;
    frame.body_seen = !dropouts[t];
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3& place = truth.poses[t].joints[j];
      const Guess& guess = guesses[t][j];
      frame.joints[j].position = place + errors[t][j] + guess.offset + outliers[t][j];
      frame.joints[j].state = guess.inferred ? TrackingState::kInferred : TrackingState::kTracked;
      if (!frame.body_seen || !IsInView(sensor, view, place)) {
        frame.joints[j] = {.position = last.joints[j].position, .state = TrackingState::kNotTracked};
      }
    }
    last = frame;
    if (swaps[t].arms) Exchange(frame, {kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand});
    if (swaps[t].legs) Exchange(frame, {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot});
    stream.frames.push_back(frame);
  }
  return stream;
}

}  // namespace etude
