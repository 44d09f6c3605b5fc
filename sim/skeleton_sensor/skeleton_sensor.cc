#include "sim/skeleton_sensor/skeleton_sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/directions.h"

namespace etude {
namespace {

/// Returns the distance from `eye` at which the ray to `joint` first hits furniture or the second person.
double NearestOccluder(const std::vector<Cuboid>& furniture, const std::vector<Capsule>& bystander,
                       const glm::dvec3& joint, const glm::dvec3& eye) {
  double nearest = std::numeric_limits<double>::infinity();
  const double distance = glm::distance(joint, eye);
  if (distance == 0) return nearest;
  const glm::dvec3 direction = (joint - eye) / distance;
  for (const Cuboid& box : furniture) nearest = std::min(nearest, HitDistance(box, eye, direction));
  for (const Capsule& capsule : bystander) nearest = std::min(nearest, HitDistance(capsule, eye, direction));
  return nearest;
}

using enum Role;

/// A limb's joints from its root outwards, which is also the order of increasing errors of a guess.
struct Limb {
  std::array<Role, 4> joints;
};
constexpr std::array<Limb, 4> kLimbRoles = {{{{kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand}},
                                             {{kRightShoulder, kRightElbow, kRightWrist, kRightHand}},
                                             {{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot}},
                                             {{kRightHip, kRightKnee, kRightAnkle, kRightFoot}}}};
constexpr std::array<double, 4> kShareOfOffset = {0.0, 0.5, 0.9, 1.0};

// A dropout lasts for a number of frames in this range (ours).
constexpr std::uint64_t kMinDropout = 2, kMaxDropout = 10;

using enum Role;

bool IsInView(const Camera& camera, const ProjectionMatrix& matrix, const glm::dvec3& point) {
  const std::optional<glm::dvec2> pixel = Project(matrix, point);
  return pixel && pixel->x >= 0 && pixel->y >= 0 && pixel->x < camera.intrinsics.width &&
         pixel->y < camera.intrinsics.height;
}

/// Returns the angle by which the body is turned away from the sensor, radians.
double TurnFrom(const glm::dvec3& eye, const BodyPose& pose) {
  const glm::dvec3 to_eye = eye - pose[kHipCentre];
  return AngleBetween(Facing(pose), {to_eye.x, 0, to_eye.z});
}

void Exchange(SensedFrame& frame, std::initializer_list<Role> left_joints) {
  for (Role role : left_joints) std::swap(frame[role], frame[Mirrored(role)]);
}

}  // namespace

HiddenJoints FindHidden(const BodyPose& pose, std::size_t frame, const Occluders& occluders, const glm::dvec3& eye) {
  const BodySight body(pose, eye);
  std::vector<Capsule> bystander;
  if (!occluders.bystander.empty()) {
    bystander = BodyCapsules(occluders.bystander[std::min(frame, occluders.bystander.size() - 1)]);
  }
  HiddenJoints hidden;
  for (const Role role : AllRoles()) {
    const JointSight sight = body.Of(role);
    const double other = std::min(sight.other, NearestOccluder(occluders.furniture, bystander, pose[role], eye));
    hidden[Index(role)] = other < sight.skin - kHidingClearance;
  }
  return hidden;
}

OcclusionGuesses::OcclusionGuesses(const SkeletonSensorOptions& options, const WorldKey& world)
    : options_(options), dice_(world, "skeleton/occlusion") {}

OcclusionGuesses::Episode OcclusionGuesses::DrawEpisode() {
  const double wrong_chance = std::min(1.0, options_.wrong_guess_chance * options_.strength);
  const int lengths = options_.longest_episode - options_.shortest_episode + 1;
  return {.age = 0,
          .length = options_.shortest_episode + static_cast<int>(dice_.IndexBelow(lengths)),
          .wrong = dice_.Chance(wrong_chance),
          .size_m = options_.nearest_guess_m *
                    std::pow(options_.farthest_guess_m / options_.nearest_guess_m, dice_.Uniform()),
          .direction = dice_.Normal3(),
          .joints = {}};
}

FrameGuesses OcclusionGuesses::Next(const BodyPose& pose, const HiddenJoints& hidden) {
  FrameGuesses guesses;
  for (std::size_t j = 0; j < kRoleCount; ++j) guesses[j].inferred = hidden[j];

  // Begin, continue or end each limb's episode.
  for (std::size_t l = 0; l < kLimbs; ++l) {
    const Limb& limb = kLimbRoles[l];
    const Episode fresh = DrawEpisode();  // drawn in every frame, but used only if an episode begins

    Episode& episode = episodes_[l];
    bool hides = false;
    for (std::size_t k = 1; k < limb.joints.size(); ++k) hides |= hidden[Index(limb.joints[k])];
    const bool seen_again = !hides && episode.age >= options_.shortest_episode;
    if (episode.IsRunning() && (seen_again || episode.age >= episode.length)) episode = Episode{};
    if (!episode.IsRunning() && hides) episode = fresh;
    if (!episode.IsRunning()) continue;

    ++episode.age;
    // Bias wrong guesses towards the body, because the sensor takes a visible part of the body for the hidden limb.
    const glm::dvec3 inwards = pose[limb.joints.front()] - pose[limb.joints.back()];
    const glm::dvec3 lean = glm::normalize(inwards + glm::dvec3(0, 1e-6, 0)) + episode.direction;
    const glm::dvec3 offset = episode.wrong ? episode.size_m * glm::normalize(lean) : glm::dvec3(0);
    // Offset every joint that was hidden at some time in the episode; the offset increases towards the limb's end.
    for (std::size_t k = 1; k < limb.joints.size(); ++k) {
      const std::size_t joint = Index(limb.joints[k]);
      episode.joints[k] |= hidden[joint];
      if (episode.joints[k]) guesses[joint] = {.inferred = true, .offset = kShareOfOffset[k] * offset};
    }
  }
  return guesses;
}

Outliers::Outliers(const SkeletonSensorOptions& options, const WorldKey& world)
    : chance_(std::min(1.0, options.outlier_chance * options.strength)),
      size_m_(options.outlier_size_m),
      dice_(world, "skeleton/outliers") {}

FrameErrors Outliers::Next() {
  FrameErrors outliers;
  for (glm::dvec3& outlier : outliers) {
    const bool strikes = dice_.Chance(chance_);
    const double x = dice_.Uniform(-1, 1), y = dice_.Uniform(-1, 1), z = dice_.Uniform(-1, 1);
    outlier = strikes ? size_m_ * glm::dvec3(x, y, z) : glm::dvec3(0);
  }
  return outliers;
}

Swaps::Swaps(double rate_hz, const SkeletonSensorOptions& options, const WorldKey& world)
    : usual_chance_(options.swaps_per_minute * options.strength / (60.0 * rate_hz)),
      when_facing_(options.swaps_when_facing),
      length_(static_cast<int>(rate_hz / 3.0)),
      dice_(world, "skeleton/swaps") {}

Swap Swaps::Next(double turn) {
  const double chance = std::min(1.0, when_facing_ ? usual_chance_ : usual_chance_ * (1 - std::cos(turn)));
  const bool starts = dice_.Chance(chance), arms = dice_.Chance(0.5);
  if (left_ == 0 && starts) {
    left_ = length_;
    current_ = {.arms = arms, .legs = !arms};
  }
  if (left_ == 0) return {};
  --left_;
  return current_;
}

Dropouts::Dropouts(const SkeletonSensorOptions& options, const WorldKey& world) : dice_(world, "skeleton/dropouts") {
  constexpr double kMeanLength = 0.5 * (kMinDropout + kMaxDropout);
  const double share = std::min(0.9, options.dropout_share * options.strength);
  chance_ = share / ((1.0 - share) * kMeanLength);
}

bool Dropouts::Next() {
  const bool starts = dice_.Chance(chance_);
  const std::uint64_t length = kMinDropout + dice_.IndexBelow(kMaxDropout - kMinDropout + 1);
  if (left_ == 0 && starts) left_ = length;
  if (left_ == 0) return false;
  --left_;
  return true;
}

Camera SkeletonSensorAt(const SensorPlacement& place, const Intrinsics& view) {
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

/// Returns the frame that was sensed Lag() frames earlier; at first, while there is none, the first frame.
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
  std::vector<SensedFrame> remaining;
  while (const auto known = motion_.Next()) remaining.push_back(Delayed(Sense(known->pose, known->motion)));
  return remaining;
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
