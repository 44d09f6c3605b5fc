#include "sim/skeleton_sensor/skeleton_sensor.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "engine/base/angles.h"
#include "sim/skeleton_sensor/episodes.h"
#include "sim/skeleton_sensor/joint_errors.h"

namespace etude {
namespace {

using enum Role;

bool IsInView(const Camera& camera, const ProjectionMatrix& matrix, const glm::dvec3& point) {
  const std::optional<glm::dvec2> pixel = Project(matrix, point);
  return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x < camera.intrinsics.width &&
         pixel->y < camera.intrinsics.height;
}

/// How far the body is turned away from the sensor, per frame.
std::vector<double> TurnsFrom(const glm::dvec3& eye, const BodyMotion& truth) {
  std::vector<double> turns;
  turns.reserve(truth.poses.size());
  for (const BodyPose& pose : truth.poses) {
    const glm::dvec3 to_eye = eye - pose[kHipCentre];
    turns.push_back(AngleBetween(Facing(pose), {to_eye.x, 0, to_eye.z}));
  }
  return turns;
}

void Exchange(SensedFrame& frame, std::initializer_list<Role> left_joints) {
  for (Role role : left_joints) std::swap(frame[role], frame[Mirrored(role)]);
}

/// Every frame is told `lag` frames late; until then the first one is.
void Delay(std::vector<SensedFrame>& frames, std::size_t lag) {
  lag = std::min(lag, frames.size());
  if (lag == 0) return;
  const SensedFrame first = frames.front();
  std::move_backward(frames.begin(), frames.end() - static_cast<std::ptrdiff_t>(lag), frames.end());
  std::fill_n(frames.begin(), lag, first);
}

}  // namespace

Camera SkeletonSensorAt(const SensorPlace& place, const Intrinsics& view) {
  constexpr double kLooksAtHeight = 1.0;
  const glm::dvec3 eye(place.distance * std::sin(place.turn), place.height, place.distance * std::cos(place.turn));
  return LookAt(view, eye, {0, kLooksAtHeight, 0});
}

SkeletonStream SenseSkeleton(const BodyMotion& truth, const Camera& sensor, const Occluders& occluders,
                             const SkeletonSensorOptions& options, const WorldKey& world) {
  const std::size_t count = truth.poses.size();
  const auto hidden = FindHidden(truth, occluders, sensor.p_WC);
  const auto errors = ContinuousErrors(truth, sensor, options, world);
  const auto guesses = OcclusionGuesses(truth, hidden, options, world);
  const auto outliers = Outliers(count, options, world);
  const auto swaps = Swaps(TurnsFrom(sensor.p_WC, truth), truth.rate_hz, options, world);
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
  Delay(stream.frames, static_cast<std::size_t>(options.Lag()));
  return stream;
}

}  // namespace etude
