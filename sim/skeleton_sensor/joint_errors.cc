#include "sim/skeleton_sensor/joint_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/smoothstep.h"
#include "sim/skeleton_sensor/pose_field.h"
#include "sim/skeleton_sensor/processes.h"

namespace etude {
namespace {

/// Metres per second over the neighbouring frames.
double SpeedAt(const BodyMotion& motion, std::size_t frame, std::size_t joint) {
  const std::size_t before = frame >= 2 ? frame - 2 : 0;
  const std::size_t after = std::min(frame + 2, motion.poses.size() - 1);
  if (after == before) return 0;
  const double seconds = static_cast<double>(after - before) / motion.rate_hz;
  return glm::distance(motion.poses[after].joints[joint], motion.poses[before].joints[joint]) / seconds;
}

using JointSpeeds = std::array<double, kRoleCount>;

std::vector<JointSpeeds> SpeedsOf(const BodyMotion& motion) {
  std::vector<JointSpeeds> speeds(motion.poses.size());
  for (std::size_t t = 0; t < speeds.size(); ++t) {
    for (std::size_t j = 0; j < kRoleCount; ++j) speeds[t][j] = SpeedAt(motion, t, j);
  }
  return speeds;
}

/// The standard normal value that is exceeded with this probability, in (0, 1).
double NormalQuantileAbove(double probability) {
  double low = -9, high = 9;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Which error goes with a pose: unit mean square per axis, with jumps where the mode changes.
class PoseError {
 public:
  PoseError(Role role, const SkeletonSensorOptions& options, RandomStream& dice)
      : usual_(role, LengthsOf(options), dice),
        in_mode_(role, LengthsOf(options), dice),
        preference_(role, LengthsOf(options), dice) {
    const double q = options.mode_share, r = options.mode_ratio;
    usual_size_ = 1 / std::sqrt(1 - q + q * r * r);
    mode_size_ = r * usual_size_;
    threshold_ = NormalQuantileAbove(q);
  }

  glm::dvec3 At(const BodyPose& pose) const {
    const bool mode = preference_.At(pose).x > threshold_;
    return mode ? mode_size_ * in_mode_.At(pose) : usual_size_ * usual_.At(pose);
  }

 private:
  static PoseLengths LengthsOf(const SkeletonSensorOptions& options) {
    return {.own = options.pose_length_m, .far = options.far_pose_length_m};
  }

  PoseField usual_, in_mode_, preference_;
  double usual_size_ = 1, mode_size_ = 1, threshold_ = 0;
};

/// The dice of one joint, and what they have come to.
struct JointNoise {
  PoseError by_pose;
  BurstNoise fast;
  SlowNoise wander;
  SlowNoise resting;
};

constexpr double kFullSpeed = 0.5;  // m/s at which the fast part has its size
constexpr double kSpeedCap = 1.3;   // times kFullSpeed: no further growth

double FastGain(const JointSpeeds& speeds, std::size_t joint, const SkeletonSensorOptions& options) {
  double body = 0;
  for (double speed : speeds) body += speed / kRoleCount;
  // A joint that rests on a moving body is not seen as well as one that rests on a resting body.
  const double activity = std::min(0.5 * (speeds[joint] + body) / kFullSpeed, kSpeedCap);
  return options.fast_quiet + (1 - options.fast_quiet) * activity * activity;
}

/// 0 for a foot that rests on the floor, 1 for one in motion and for all other joints.
double MotionAt(Role role, const std::vector<JointSpeeds>& speeds, std::size_t frame) {
  if (GroupOf(role) != JointGroup::kFeet) return 1;
  constexpr std::size_t kReach = 5;                // frames to both sides: a foot is about to land, or has just left
  constexpr double kResting = 0.1, kMoving = 0.6;  // m/s
  double fastest = 0;
  for (std::size_t t = frame - std::min(frame, kReach); t <= std::min(frame + kReach, speeds.size() - 1); ++t) {
    fastest = std::max(fastest, speeds[t][Index(role)]);
  }
  return Smoothstep(kResting, kMoving, fastest);
}

/// The line of sight and two axes across it, and how much larger errors are there than at the reference distance.
struct Sight {
  glm::dmat3 axes;  ///< columns: across, across, along
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
  const double z = std::max(0.5, glm::dot(forward, from));  // nearer no Kinect sees a body
  const double z0 = options.reference_distance_m;
  return {.axes = {across, glm::cross(along, across), along},
          .across_growth = z / z0,
          .along_growth = DepthDeviation(options.depth_law, z) / DepthDeviation(options.depth_law, z0)};
}

/// From unit errors (across, across, along) to metres in the world.
glm::dvec3 InWorld(const Sight& sight, const glm::dvec3& unit, double size, double depth_ratio) {
  const double across = size / std::sqrt(2 + depth_ratio * depth_ratio);
  return sight.axes *
         (across * unit * glm::dvec3(sight.across_growth, sight.across_growth, depth_ratio * sight.along_growth));
}

/// The other end of a bone that ends in a joint, and how much of the joint's own error along it is left.
struct StiffBone {
  std::optional<Role> other;
  double stretch = 1;
};

std::array<StiffBone, 2> StiffBonesOf(Role role, const SkeletonSensorOptions& options) {
  const auto child = [&] { return AllRoles()[Index(role) + 1]; };  // along an arm, roles follow each other
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

/// Takes from a joint's own error (along the axes of sight) what would stretch its bones; its mean square stays as it
/// is when the bones are perpendicular or one.
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

JointErrors ContinuousErrors(const BodyMotion& truth, const Camera& sensor, const SkeletonSensorOptions& options,
                             const WorldKey& world) {
  RandomStream wander_dice(world, "skeleton/wander");
  RandomStream pose_dice(world, "skeleton/pose-error");
  RandomStream fast_dice(world, "skeleton/fast-error");
  RandomStream rest_dice(world, "skeleton/planted-feet");
  std::vector<JointNoise> noises;
  for (const Role role : AllRoles()) {
    noises.push_back({PoseError(role, options, pose_dice),
                      BurstNoise(options.fast_time_s, options.fast_tail, truth.rate_hz, fast_dice),
                      SlowNoise(options.wander_time_s, options.wander_smoothing_s, truth.rate_hz, wander_dice),
                      SlowNoise(options.rest_time_s, 0, truth.rate_hz, rest_dice)});
  }
  const std::vector<JointSpeeds> speeds = SpeedsOf(truth);
  const double by_pose_share = std::sqrt(1 - options.fast_share), fast_share = std::sqrt(options.fast_share);

  JointErrors errors(truth.poses.size());
  for (std::size_t t = 0; t < errors.size(); ++t) {
    const BodyPose& pose = truth.poses[t];
    std::array<glm::dvec3, kRoleCount> unit;
    for (const Role role : AllRoles()) {
      const std::size_t j = Index(role);
      JointNoise& noise = noises[j];
      const Sight sight = SightOf(sensor, pose[role], options);
      const double motion = MotionAt(role, speeds, t);
      const glm::dvec3 fast = FastGain(speeds[t], j, options) * noise.fast.Next(fast_dice);
      const glm::dvec3 moving = by_pose_share * noise.by_pose.At(pose) + fast_share * fast;
      const glm::dvec3 resting = noise.resting.Next(rest_dice);
      const glm::dvec3 own =
          Stiffened(std::sqrt(motion) * moving + std::sqrt(1 - motion) * resting, role, pose, sight, options);
      const auto parent = ParentOf(role);
      const double rho = parent ? options.correlation[Index(BoneKindOf(role))] : 0;
      unit[j] = (parent ? rho * unit[Index(*parent)] : glm::dvec3(0)) + std::sqrt(1 - rho * rho) * own;

      const GroupErrors& group = options[GroupOf(role)];
      const glm::dvec3 wander = group.still * noise.wander.Next(wander_dice);
      const glm::dvec3 white = group.white * wander_dice.Normal3();
      const bool is_foot = GroupOf(role) == JointGroup::kFeet;
      const double size = is_foot ? glm::mix(options.planted_feet, group.size, motion) : group.size;
      const double rest_axis = std::sqrt(3.0);  // still and white are per axis
      errors[t][j] = options.strength * (InWorld(sight, unit[j], size, group.depth_ratio) +
                                         InWorld(sight, wander + white, rest_axis, group.depth_ratio));
    }
  }
  return errors;
}

}  // namespace etude
