#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"

namespace etude {

/// Groups of joints that a sensor sees alike.
enum class JointGroup {
  kTorso,  ///< hip centre, spine, shoulder centre, head
  kShoulders,
  kElbows,
  kWrists,
  kHands,
  kHips,
  kKnees,
  kFeet,  ///< ankles and feet
};
constexpr std::size_t kJointGroupCount = 8;
constexpr std::size_t Index(JointGroup group) { return static_cast<std::size_t>(group); }
JointGroup GroupOf(Role role);
/// Returns the name of a group in sensor files and tables: "torso", "shoulders", ….
std::string_view GroupName(JointGroup group);
std::span<const JointGroup, kJointGroupCount> AllJointGroups();

/// Bones along which errors go together; the same on both sides of the body.
enum class BoneKind {
  kLowerSpine,  ///< hip centre – spine
  kUpperSpine,  ///< spine – shoulder centre
  kNeck,        ///< shoulder centre – head
  kCollar,      ///< shoulder centre – shoulder
  kUpperArm,
  kForearm,
  kHand,
  kPelvis,  ///< hip centre – hip
  kThigh,
  kShank,
  kFoot,
};
constexpr std::size_t kBoneKindCount = 11;
constexpr std::size_t Index(BoneKind kind) { return static_cast<std::size_t>(kind); }
/// Returns the kind of the bone that ends in `child`, which is not the hip centre.
BoneKind BoneKindOf(Role child);
/// Returns the name of a kind in sensor files and tables: "lower_spine", "upper_spine", ….
std::string_view BoneName(BoneKind kind);
std::span<const BoneKind, kBoneKindCount> AllBoneKinds();

/// The size of a group's errors, metres. All are distances in three dimensions (root mean square) but `still` and
/// `white`, which are deviations per axis.
struct GroupErrors {
  double size = 0;         ///< at the reference distance, in motion: what depends on the pose, and the fast part
  double depth_ratio = 1;  ///< of `size`: along the line of sight ÷ along each axis across it
  double still = 0;        ///< the slow wander of a body that stands still
  double white = 0;        ///< the part without memory
};

/// The law by which errors grow with the distance z from the sensor (metres along its axis). Across the line of sight
/// they grow as the pixels' footprint, with z.
enum class DepthLaw {
  /// Structured light: σ_z = 0.0012 + 0.0019 (z − 0.4)² m (Nguyen, Izadi and Lovell 2012).
  kStructuredLight,
  /// Time of flight: σ_z = 1.5 − 0.5 z + 0.3 z² mm (Fankhauser et al. 2015, facing the surface).
  kTimeOfFlight,
};
/// Returns σ_z of a single depth pixel, metres. Joints take its growth only, because each comes from many pixels.
double DepthDeviation(DepthLaw law, double z);

/// The errors of a Kinect-like skeleton sensor: `SensorV1()` or `SensorV2()`, or a file (docs/sensor.md). What comes
/// from where stands with the presets.
struct SkeletonSensorOptions {
  /// A factor on every size, chance and lag below (chances stop at 1); occlusion itself, its offsets and what falls out
  /// of view stay as they are. 0: hidden joints are inferred correctly, all else is true.
  double strength = 1.0;

  Intrinsics view;  ///< of the depth camera
  DepthLaw depth_law = DepthLaw::kTimeOfFlight;
  double reference_distance_m = 2.75;  ///< where sizes hold

  std::array<GroupErrors, kJointGroupCount> groups;
  /// Errors are a linear model over the tree of the body: in units of its own size, a joint's error is ρ times its
  /// parent's and √(1 − ρ²) of its own. ρ by the kind of bone, in (−1, 1).
  std::array<double, kBoneKindCount> correlation{};
  /// A joint's own error along the bones that end in it is times this: below 1 the sensor knows how long limbs are.
  double arm_stretch = 1;       ///< of shoulders, elbows and wrists along upper arm and forearm
  double hand_stretch = 1;      ///< of hands along the hand
  double shoulder_stretch = 1;  ///< of shoulders towards each other
  /// The `size` of an ankle or foot that rests on the floor, whose noise is slow (`rest_time_s`); in motion it is the
  /// group's.
  double planted_feet = 0.003;
  double rest_time_s = 0.2;  ///< (ours)

  // The slow wander: its own time constant, and that of what smooths it (0: an Ornstein–Uhlenbeck process).
  double wander_time_s = 0.4;
  double wander_smoothing_s = 0;

  // What depends on the pose: a smooth random function of the places of the limbs, with modes: where a second such
  // function is high, another guess of the body is preferred, and the error jumps.
  double pose_length_m = 0.25;     ///< correlation length over a joint's own place
  double far_pose_length_m = 0.8;  ///< over the places of the arms, for joints of the trunk and legs (ours)
  double mode_share = 0.12;        ///< of all poses (ours)
  double mode_ratio = 4;           ///< size of errors in the mode ÷ elsewhere (ours)

  // The fast part: short, in bursts, more when the body moves.
  double fast_share = 0.2;    ///< of the variance of `size`
  double fast_time_s = 0.05;  ///< (ours)
  double fast_quiet = 0.05;   ///< times this in a body at rest; grows with the square of speed to 1 at 0.5 m/s (ours)
  double fast_tail = 0.7;     ///< deviation of the logarithm of its strength; 0: Gaussian (ours)

  int lag_frames = 0;  ///< how many frames late a pose is reported

  // Occlusion: an episode lasts this many frames, or until the limb is seen again, then the guess changes.
  int shortest_episode = 3;
  int longest_episode = 40;
  double nearest_guess_m = 0.2;  ///< how far a hidden hand or foot is off
  double farthest_guess_m = 1.1;
  double wrong_guess_chance = 0.6;  ///< else the guess is as good as if seen (ours)

  double dropout_share = 0.02;    ///< of all frames: the whole body is lost
  double swaps_per_minute = 1.0;  ///< arms or legs, left for right, a third of a second long, in profile (ours)
  bool swaps_when_facing = true;  ///< else in proportion to 1 − cos of the body's turn from the sensor (ours)
  double outlier_chance = 0.001;  ///< per joint and frame (ours; Gaussian + uniform: arXiv 1512.04134)
  double outlier_size_m = 0.15;   ///< uniform in a cube of this half side (ours)

  /// Returns `lag_frames` at this strength.
  int Lag() const;

  GroupErrors& operator[](JointGroup group) { return groups[Index(group)]; }
  const GroupErrors& operator[](JointGroup group) const { return groups[Index(group)]; }
};

/// Kinect v1 as published measurements describe it (algorithms A7, first paragraph; tests hold the simulator to them).
SkeletonSensorOptions SensorV1();
/// Kinect v2, fitted to a recording with an optical twin; what one recording cannot tell is v1's or ours.
SkeletonSensorOptions SensorV2();
/// Returns the preset "v1" or "v2"; nothing for other names.
std::optional<SkeletonSensorOptions> FindSensorPreset(std::string_view name);

/// Reads a sensor file (docs/sensor.md): YAML, all keys optional on top of the preset that `based_on` names.
///
///     based_on: v2                # or v1
///     reference_distance_m: 2.9
///     planted_feet_m: 0.003
///     fast_share: 0.2
///     groups:
///       torso: {size_m: 0.021, depth_ratio: 1.2, still_m: 0.001, white_m: 0.0001}
///     correlation: {upper_arm: 0.04, shank: 0.49}
///
/// Refuses unknown keys and values out of range, with file, line and column.
Result<SkeletonSensorOptions> ReadSensorFile(std::string_view text, const std::string& file);

/// Writes all keys of such a file but `strength`, which is a scenario's. What was read from it is written the same.
std::string WriteSensorFile(const SkeletonSensorOptions& options, std::string_view based_on);

}  // namespace etude
