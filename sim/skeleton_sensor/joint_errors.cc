#include "sim/skeleton_sensor/joint_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/angles.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {
namespace {

/// Returns the factor by which the state of a first-order low pass decays in one frame; 0 for a time constant of 0.
double MemoryOf(double time_s, double rate_hz) { return time_s > 0 ? std::exp(-1.0 / (rate_hz * time_s)) : 0.0; }

constexpr double kLoudnessTime = 0.7;  // approximate duration of a burst of fast noise, seconds (ours)

using enum Role;

bool IsLeft(Role role) { return RoleName(role).starts_with("left"); }

/// Returns the number that a standard normal random number exceeds with this probability, in (0, 1). Uses bisection.
double NormalQuantileAbove(double probability) {
  double low = -9, high = 9;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

PoseLengths LengthsOf(const SkeletonSensorOptions& options) {
  return {.own = options.pose_length_m, .far = options.far_pose_length_m};
}

constexpr double kFullSpeed = 0.5;  // m/s; FastGain is 1 if the mean of the joint's and the body's speeds is this
constexpr double kSpeedCap = 1.3;   // as a multiple of kFullSpeed; above this speed the fast part does not grow

double FastGain(const JointSpeeds& speeds, std::size_t joint, const SkeletonSensorOptions& options) {
  double body = 0;
  for (double speed : speeds) body += speed / kRoleCount;
  // The joint's speed and the body's mean speed count equally, because a moving body also disturbs joints at rest.
  const double activity = std::min(0.5 * (speeds[joint] + body) / kFullSpeed, kSpeedCap);
  return options.fast_quiet + (1 - options.fast_quiet) * activity * activity;
}

/// The line of sight to a joint, two axes across it, and the growth of errors, which is the size of errors at the
/// joint's distance divided by their size at the reference distance.
struct Sight {
  glm::dmat3 axes;  ///< columns: two axes across the line of sight, then the line of sight
  double across_growth, along_growth;
};

Sight SightOf(const Camera& sensor, const glm::dvec3& joint, const SkeletonSensorOptions& options) {
  const glm::dvec3 from = joint - sensor.p_WC;
  const double distance = glm::length(from);
  const glm::dvec3 right(sensor.R_CW[0][0], sensor.R_CW[1][0], sensor.R_CW[2][0]);
  const glm::dvec3 forward(sensor.R_CW[0][2], sensor.R_CW[1][2], sensor.R_CW[2][2]);
  const glm::dvec3 along = distance > 0 ? from / distance : forward;
  const glm::dvec3 off = right - glm::dot(right, along) * along;
  const double length = glm::length(off);
  const glm::dvec3 across = length > 1e-9 ? off / length : glm::dvec3(sensor.R_CW[0][1], sensor.R_CW[1][1], 0);
  const double z = std::max(0.5, glm::dot(forward, from));  // ≥ 0.5 m: a Kinect sees no nearer body
  const double z0 = options.reference_distance_m;
  return {.axes = {across, glm::cross(along, across), along},
          .across_growth = z / z0,
          .along_growth = DepthDeviation(options.depth_law, z) / DepthDeviation(options.depth_law, z0)};
}

/// Converts errors of unit size in the axes of `sight` to metres in the world.
glm::dvec3 InWorld(const Sight& sight, const glm::dvec3& unit, double size, double depth_ratio) {
  const double across = size / std::sqrt(2 + depth_ratio * depth_ratio);
  return sight.axes *
         (across * unit * glm::dvec3(sight.across_growth, sight.across_growth, depth_ratio * sight.along_growth));
}

/// A bone at a joint: the bone's other end, and the factor on that part of the joint's own error which is along the
/// bone.
struct StiffBone {
  std::optional<Role> other;
  double stretch = 1;
};

std::array<StiffBone, 2> StiffBonesOf(Role role, const SkeletonSensorOptions& options) {
  const auto child = [&] { return AllRoles()[Index(role) + 1]; };  // an arm's roles are in order from the shoulder
  switch (GroupOf(role)) {
    case JointGroup::kShoulders:
      return {{{child(), options.arm_stretch}, {Mirrored(role), options.shoulder_stretch}}};
    case JointGroup::kElbows:
      return {{{ParentOf(role), options.arm_stretch}, {child(), options.arm_stretch}}};
    case JointGroup::kWrists:
      return {{{ParentOf(role), options.arm_stretch}, {}}};
    case JointGroup::kHands:
      return {{{ParentOf(role), options.hand_stretch}, {}}};
    default:
      return {};
  }
}

/// Multiplies a joint's own error (in the axes of `sight`) along its bones by their stretch factors, then scales it so
/// that the mean square stays the same. This is exact with one bone or with perpendicular bones.
glm::dvec3 Stiffened(glm::dvec3 own, Role role, const BodyPose& pose, const Sight& sight,
                     const SkeletonSensorOptions& options) {
  double mean_square = 3;
  for (const StiffBone& bone : StiffBonesOf(role, options)) {
    if (!bone.other || pose[*bone.other] == pose[role]) continue;
    const glm::dvec3 along = glm::transpose(sight.axes) * glm::normalize(pose[*bone.other] - pose[role]);
    own += (bone.stretch - 1) * glm::dot(own, along) * along;
    mean_square += bone.stretch * bone.stretch - 1;
  }
  return own * std::sqrt(3 / mean_square);
}

}  // namespace

SlowNoise::SlowNoise(double time_s, double smoothing_s, double rate_hz, RandomStream& dice)
    : memory_(MemoryOf(time_s, rate_hz)),
      novelty_(std::sqrt(1 - memory_ * memory_)),
      smoothing_(MemoryOf(smoothing_s, rate_hz)) {
  // Compute the variance of a second low pass (s) applied to a unit AR(1) process (m): (1 − s) (1 + s m) / ((1 + s) (1
  // − s m)).
  const double s = smoothing_, m = memory_;
  scale_ = std::sqrt((1 + s) * (1 - s * m) / ((1 - s) * (1 + s * m)));
  // Draw the states of both low passes together from their stationary distribution: variances 1 and 1/scale²,
  // covariance (1 − s) / (1 − s m).
  const glm::dvec3 a = dice.Normal3(), b = dice.Normal3();
  const double covariance = (1 - s) / (1 - s * m);
  const double rest = std::max(0.0, 1 / (scale_ * scale_) - covariance * covariance);
  first_ = a;
  second_ = covariance * a + std::sqrt(rest) * b;
}

glm::dvec3 SlowNoise::Next(RandomStream& dice) {
  first_ = memory_ * first_ + novelty_ * dice.Normal3();
  second_ = smoothing_ * second_ + (1 - smoothing_) * first_;
  return scale_ * second_;
}

BurstNoise::BurstNoise(double time_s, double tail, double rate_hz, RandomStream& dice)
    : tail_(tail), noise_(time_s, 0, rate_hz, dice), loudness_(kLoudnessTime, 0, rate_hz, dice) {}

glm::dvec3 BurstNoise::Next(RandomStream& dice) {
  const glm::dvec3 noise = noise_.Next(dice);
  // Scale by a log-normal factor of unit mean square, the same for all axes.
  const double loudness = std::exp(tail_ * loudness_.Next(dice).x - tail_ * tail_);
  return loudness * noise;
}

PoseField::PoseField(Role role, const PoseLengths& lengths, RandomStream& dice) {
  // Choose the joint positions on which the random function depends.
  const auto depend_on = [&](Role joint, bool from_shoulders, double length) {
    points_[point_count_++] = {joint, from_shoulders, length};
  };
  const auto depend_on_arms = [&] {
    for (const Role joint : {kLeftElbow, kLeftWrist, kRightElbow, kRightWrist}) depend_on(joint, true, lengths.far);
  };
  switch (GroupOf(role)) {
    case JointGroup::kElbows:
    case JointGroup::kWrists:
    case JointGroup::kHands:
      depend_on(IsLeft(role) ? kLeftElbow : kRightElbow, true, lengths.own);
      depend_on(IsLeft(role) ? kLeftWrist : kRightWrist, true, lengths.own);
      break;
    case JointGroup::kFeet:
      depend_on(role, false, lengths.own);
      break;
    default:
      depend_on(role, false, lengths.own);
      depend_on_arms();
  }
  // Draw the random directions, phases and gradients of the waves.
  for (Wave& wave : waves_) {
    wave.direction = dice.Normal3() * std::sqrt(2.0 / kWaves);
    wave.phase = dice.Uniform(0, 2 * kPi);
    // Draw equally many random numbers for every joint.
    for (std::size_t i = 0; i < kMaxPoints; ++i) {
      const glm::dvec3 drawn = dice.Normal3();
      wave.per_metre[i] = i < point_count_ ? drawn / points_[i].length : glm::dvec3(0);
    }
  }
}

std::array<double, PoseField::kWaves> PoseField::PhasesAt(const BodyPose& pose) const {
  std::array<glm::dvec3, kMaxPoints> points;
  for (std::size_t i = 0; i < point_count_; ++i) {
    points[i] = pose[points_[i].joint] - (points_[i].from_shoulders ? pose[kShoulderCentre] : glm::dvec3(0));
  }
  std::array<double, kWaves> phases;
  for (std::size_t w = 0; w < kWaves; ++w) {
    phases[w] = waves_[w].phase;
    for (std::size_t i = 0; i < point_count_; ++i) phases[w] += glm::dot(waves_[w].per_metre[i], points[i]);
  }
  return phases;
}

glm::dvec3 PoseField::At(const BodyPose& pose) const {
  const std::array<double, kWaves> phases = PhasesAt(pose);
  glm::dvec3 sum(0);
  for (std::size_t w = 0; w < kWaves; ++w) sum += waves_[w].direction * std::cos(phases[w]);
  return sum;
}

bool PoseField::ExceedsAlongX(const BodyPose& pose, double threshold) const {
  // Sum cosines with an error of at most kError: in full turns, a polynomial of the difference from the nearest turn.
  constexpr double kError = 2e-4;
  const std::array<double, kWaves> phases = PhasesAt(pose);
  double sum = 0, margin = 0;
  for (std::size_t w = 0; w < kWaves; ++w) {
    const double turns = phases[w] * (0.5 / kPi), rest = 2 * kPi * (turns - std::floor(turns + 0.5));
    const double x = rest * rest;  // at most π²
    const double cosine =
        1 - x / 2 * (1 - x / 12 * (1 - x / 30 * (1 - x / 56 * (1 - x / 90 * (1 - x / 132)))));  // Taylor's series
    sum += waves_[w].direction.x * cosine;
    margin += kError * std::abs(waves_[w].direction.x);
  }
  if (std::abs(sum - threshold) > margin) return sum > threshold;
  return At(pose).x > threshold;
}

PoseError::PoseError(Role role, const SkeletonSensorOptions& options, RandomStream& dice)
    : usual_(role, LengthsOf(options), dice),
      in_mode_(role, LengthsOf(options), dice),
      preference_(role, LengthsOf(options), dice) {
  const double q = options.mode_share, r = options.mode_ratio;
  usual_size_ = 1 / std::sqrt(1 - q + q * r * r);
  mode_size_ = r * usual_size_;
  threshold_ = NormalQuantileAbove(q);
}

glm::dvec3 PoseError::At(const BodyPose& pose) const {
  const bool mode = preference_.ExceedsAlongX(pose, threshold_);
  return mode ? mode_size_ * in_mode_.At(pose) : usual_size_ * usual_.At(pose);
}

ContinuousErrors::ContinuousErrors(const Camera& sensor, const SkeletonSensorOptions& options, double rate_hz,
                                   const WorldKey& world)
    : sensor_(sensor),
      options_(options),
      wander_dice_(world, "skeleton/wander"),
      pose_dice_(world, "skeleton/pose-error"),
      fast_dice_(world, "skeleton/fast-error"),
      rest_dice_(world, "skeleton/planted-feet") {
  for (const Role role : AllRoles()) {
    noises_.push_back({PoseError(role, options, pose_dice_),
                       BurstNoise(options.fast_time_s, options.fast_tail, rate_hz, fast_dice_),
                       SlowNoise(options.wander_time_s, options.wander_smoothing_s, rate_hz, wander_dice_),
                       SlowNoise(options.rest_time_s, 0, rate_hz, rest_dice_)});
  }
}

FrameErrors ContinuousErrors::Next(const BodyPose& pose, const FrameMotion& motion) {
  const double by_pose_share = std::sqrt(1 - options_.fast_share), fast_share = std::sqrt(options_.fast_share);
  FrameErrors errors;
  std::array<glm::dvec3, kRoleCount> unit;
  for (const Role role : AllRoles()) {
    const std::size_t j = Index(role);
    JointNoise& noise = noises_[j];
    // Draw the joint's own error. In motion it has a pose-dependent and a fast part; at rest it changes slowly.
    const Sight sight = SightOf(sensor_, pose[role], options_);
    const double moves = motion.moves[j];
    const glm::dvec3 fast = FastGain(motion.speeds, j, options_) * noise.fast.Next(fast_dice_);
    const glm::dvec3 moving = by_pose_share * noise.by_pose.At(pose) + fast_share * fast;
    const glm::dvec3 resting = noise.resting.Next(rest_dice_);
    const glm::dvec3 own =
        Stiffened(std::sqrt(moves) * moving + std::sqrt(1 - moves) * resting, role, pose, sight, options_);
    // Correlate the joint's own error with the parent's error.
    const auto parent = ParentOf(role);
    const double rho = parent ? options_.correlation[Index(BoneKindOf(role))] : 0;
    unit[j] = (parent ? rho * unit[Index(*parent)] : glm::dvec3(0)) + std::sqrt(1 - rho * rho) * own;

    // Add drift and white noise, and convert to metres in the world.
    const GroupErrors& group = options_[GroupOf(role)];
    const glm::dvec3 wander = group.still * noise.wander.Next(wander_dice_);
    const glm::dvec3 white = group.white * wander_dice_.Normal3();
    const bool is_foot = GroupOf(role) == JointGroup::kFeet;
    const double size = is_foot ? glm::mix(options_.planted_feet, group.size, moves) : group.size;
    const double rest_axis = std::sqrt(3.0);  // `still` and `white` are per axis; InWorld expects a size in 3D
    errors[j] = options_.strength * (InWorld(sight, unit[j], size, group.depth_ratio) +
                                     InWorld(sight, wander + white, rest_axis, group.depth_ratio));
  }
  return errors;
}

}  // namespace etude
