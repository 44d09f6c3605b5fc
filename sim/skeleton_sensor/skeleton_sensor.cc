#include "sim/skeleton_sensor/skeleton_sensor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/directions.h"

namespace etude {
namespace {

using enum Role;

bool IsInView(const Camera& camera, const ProjectionMatrix& matrix, const glm::dvec3& point) {
  const std::optional<glm::dvec2> pixel = Project(matrix, point);
  return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x < camera.intrinsics.width &&
         pixel->y < camera.intrinsics.height;
}

/// Returns how far the body is turned away from the sensor, radians.
double TurnFrom(const glm::dvec3& eye, const BodyPose& pose) {
  const glm::dvec3 to_eye = eye - pose[kHipCentre];
  return AngleBetween(Facing(pose), {to_eye.x, 0, to_eye.z});
}

void Exchange(SensedFrame& frame, std::initializer_list<Role> left_joints) {
  for (Role role : left_joints) std::swap(frame[role], frame[Mirrored(role)]);
}

}  // namespace

Camera SkeletonSensorAt(const SensorPlace& place, const Intrinsics& view) {
  constexpr double kLooksAtHeight = 1.0;
  const glm::dvec3 eye(place.distance * std::sin(place.turn), place.height, place.distance * std::cos(place.turn));
  return LookAt(view, eye, {0, kLooksAtHeight, 0});
}

SkeletonSensor::SkeletonSensor(const Camera& sensor, const Occluders& occluders, const SkeletonSensorOptions& options,
                               double rate_hz, const WorldKey& world)
    : sensor_(sensor),
      view_(MatrixOf(sensor)),
      occluders_(occluders),
      motion_(rate_hz),
      errors_(sensor, options, rate_hz, world),
      guesses_(options, world),
      outliers_(options, world),
      swaps_(rate_hz, options, world),
      dropouts_(options, world),
      delayed_(static_cast<std::size_t>(options.Lag()) + 1) {}

SensedFrame SkeletonSensor::Sense(const BodyPose& pose, const FrameMotion& motion) {
  const FrameErrors errors = errors_.Next(pose, motion);
  const FrameGuesses guesses = guesses_.Next(pose, FindHidden(pose, frame_, occluders_, sensor_.p_WC));
  const FrameErrors outliers = outliers_.Next();
  const Swap swap = swaps_.Next(TurnFrom(sensor_.p_WC, pose));
  SensedFrame frame;
  frame.body_seen = !dropouts_.Next();
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    const glm::dvec3& place = pose.joints[j];
    const Guess& guess = guesses[j];
    frame.joints[j].position = place + errors[j] + guess.offset + outliers[j];
    frame.joints[j].state = guess.inferred ? TrackingState::kInferred : TrackingState::kTracked;
    if (!frame.body_seen || !IsInView(sensor_, view_, place)) {
      frame.joints[j] = {.position = last_.joints[j].position, .state = TrackingState::kNotTracked};
    }
  }
  last_ = frame;
  if (swap.arms) Exchange(frame, {kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand});
  if (swap.legs) Exchange(frame, {kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot});
  return frame;
}

/// Delays every frame by Lag() frames; until then the first one is reported.
SensedFrame SkeletonSensor::Delayed(const SensedFrame& sensed) {
  if (frame_ == 0) std::fill(delayed_.begin(), delayed_.end(), sensed);
  delayed_[frame_ % delayed_.size()] = sensed;
  ++frame_;
  return delayed_[frame_ % delayed_.size()];
}

std::optional<SensedFrame> SkeletonSensor::Update(const BodyPose& pose) {
  motion_.Push(pose);
  const auto known = motion_.Next();
  if (!known) return std::nullopt;
  return Delayed(Sense(known->pose, known->motion));
}

std::vector<SensedFrame> SkeletonSensor::Finish() {
  motion_.End();
  std::vector<SensedFrame> owed;
  while (const auto known = motion_.Next()) owed.push_back(Delayed(Sense(known->pose, known->motion)));
  return owed;
}

SkeletonStream SenseSkeleton(const BodyMotion& truth, const Camera& sensor, const Occluders& occluders,
                             const SkeletonSensorOptions& options, const WorldKey& world) {
  SkeletonSensor skeleton(sensor, occluders, options, truth.rate_hz, world);
  SkeletonStream stream{.rate_hz = truth.rate_hz, .frames = {}};
  stream.frames.reserve(truth.poses.size());
  for (const BodyPose& pose : truth.poses) {
    if (const auto frame = skeleton.Update(pose)) stream.frames.push_back(*frame);
  }
  for (const SensedFrame& frame : skeleton.Finish()) stream.frames.push_back(frame);
  return stream;
}

}  // namespace etude
