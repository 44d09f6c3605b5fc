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

/// Groups of joints with the same errors.
enum class JointGroup {
  kTorso,  ///< hip centre, spine, shoulder centre, head
  kShoulders,
  kElbows,
  kWrists,
  kHands,
  kHips,
  kKnees,
  kFeet,  ///< the joints ankle and foot
};
constexpr std::size_t kJointGroupCount = 8;
constexpr std::size_t Index(JointGroup group) { return static_cast<std::size_t>(group); }
JointGroup GroupOf(Role role);
/// Returns the name of a group in sensor files and tables: "torso", "shoulders", ….
std::string_view GroupName(JointGroup group);
std::span<const JointGroup, kJointGroupCount> AllJointGroups();

/// The kinds of bones along which errors are correlated. Left and right bones have the same kind.
enum class BoneKind {
  kLowerSpine,  ///< bone from hip centre to spine
  kUpperSpine,  ///< bone from spine to shoulder centre
  kNeck,        ///< bone from shoulder centre to head
  kCollar,      ///< bone from shoulder centre to shoulder
  kUpperArm,
  kForearm,
  kHand,
  kPelvis,  ///< bone from hip centre to hip
  kThigh,
  kShank,
  kFoot,
};
constexpr std::size_t kBoneKindCount = 11;
constexpr std::size_t Index(BoneKind kind) { return static_cast<std::size_t>(kind); }
/// Returns the kind of the bone that ends in `child`, which must not be the hip centre.
BoneKind BoneKindOf(Role child);
/// Returns the name of a kind in sensor files and tables: "lower_spine", "upper_spine", ….
std::string_view BoneName(BoneKind kind);
std::span<const BoneKind, kBoneKindCount> AllBoneKinds();

/// The sizes of a group's errors, metres. `size` is a root mean square distance in three dimensions; `still` and
/// `white` are standard deviations per axis.
struct GroupErrors {
  double size = 0;         ///< root mean square of the pose-dependent and the fast part together, in motion
  double depth_ratio = 1;  ///< ratio of errors along the line of sight to errors along each axis across it
  double still = 0;        ///< the slow drift of the joints of a body that stands still
  double white = 0;        ///< the uncorrelated part of the errors
};

/// The law by which errors along the line of sight grow with the distance z from the sensor (metres along the sensor's
/// axis). Errors across the line of sight are proportional to z, like the size of a pixel on the surface.
enum class DepthLaw {
  /// Structured light: σ_z = 0.0012 + 0.0019 (z − 0.4)² m (Nguyen, Izadi and Lovell 2012).
  kStructuredLight,
  /// Time of flight: σ_z = 1.5 − 0.5 z + 0.3 z² mm (Fankhauser et al. 2015, for surfaces that face the sensor).
  kTimeOfFlight,
};
/// Returns σ_z of a single depth pixel, metres. Errors of joints use only the relative growth of σ_z, because a joint
/// is estimated from many pixels.
double DepthDeviation(DepthLaw law, double z);

/// The errors of a Kinect-like skeleton sensor: `SensorV1()`, `SensorV2()` or a file (docs/sensor.md). Comments at the
/// presets state the sources of the values.
struct SkeletonSensorOptions {
  /// The strength of the errors: a factor on the errors of joints, on the probabilities of wrong guesses, outliers
  /// (both up to 1) and swaps, and on `dropout_share` (up to 0.9). A strength below 1 also multiplies the lag. The
  /// strength does not change the sizes of wrong guesses and outliers, nor which joints are hidden or out of view. At
  /// 0, every joint in view is reported at its true position.
  double strength = 1.0;

  Intrinsics view;  ///< intrinsics of the depth camera
  DepthLaw depth_law = DepthLaw::kTimeOfFlight;
  double reference_distance_m = 2.75;  ///< distance from the sensor at which errors have GroupErrors::size

  std::array<GroupErrors, kJointGroupCount> groups;
  /// Errors follow a linear model on the tree of the body: in units of the size of the joint's group, a joint's error
  /// is ρ times the parent joint's error plus √(1 − ρ²) times an independent part, the joint's own error. ρ depends on
  /// the kind of bone and is in (−1, 1).
  std::array<double, kBoneKindCount> correlation{};
  /// Factors on a joint's own error along the bones that end in the joint. With a factor below 1, the sensor keeps limb
  /// lengths nearly constant.
  double arm_stretch = 1;       ///< factor for shoulders, elbows and wrists along upper arm and forearm
  double hand_stretch = 1;      ///< factor for hands along the hand
  double shoulder_stretch = 1;  ///< factor for shoulders along the line between the shoulders
  /// The `size` of the errors of an ankle or foot at rest on the floor, metres. The noise then has the time constant
  /// `rest_time_s`. An ankle or foot in motion has the `size` of its joint group.
  double planted_feet = 0.003;
  double rest_time_s = 0.2;  ///< time constant of the noise of resting feet (ours)

  // The slow drift: its time constant, and the time constant of a second low pass. If the second time constant is 0,
  // there is only one low pass (an Ornstein–Uhlenbeck process).
  double wander_time_s = 0.4;
  double wander_smoothing_s = 0;

  // The pose-dependent part: a smooth random function of the joint positions. A second such function selects the mode:
  // where it exceeds a threshold, the error jumps, as if the sensor preferred another estimate of the body.
  double pose_length_m = 0.25;     ///< correlation length over the joint's own position
  double far_pose_length_m = 0.8;  ///< correlation length over the arms' positions, for trunk and legs (ours)
  double mode_share = 0.12;        ///< share of all poses in the second mode (ours)
  double mode_ratio = 4;           ///< size of errors in the second mode ÷ size in the first (ours)

  // The fast part: noise in bursts, larger when the body moves.
  double fast_share = 0.2;    ///< share of the variance of `size` that is fast
  double fast_time_s = 0.05;  ///< time constant of the fast noise (ours)
  double fast_quiet = 0.05;   ///< factor on fast noise at rest; grows with the square of speed to 1 at 0.5 m/s (ours)
  double fast_tail = 0.7;     ///< standard deviation of the logarithm of the bursts' strength; 0: Gaussian noise (ours)

  int lag_frames = 0;  ///< delay of the reported skeleton, frames

  // Occlusion: the guess for hidden joints is kept for an episode. The length of an episode is a number of frames in
  // this range. After the shortest length, an episode also ends when the limb is seen again.
  int shortest_episode = 3;
  int longest_episode = 40;
  double nearest_guess_m = 0.2;  ///< smallest and largest error of a wrong guess for a hand or foot
  double farthest_guess_m = 1.1;
  double wrong_guess_chance = 0.6;  ///< probability of a wrong guess; a right one has a seen joint's error (ours)

  double dropout_share = 0.02;    ///< share of all frames in which the whole body is lost
  double swaps_per_minute = 1.0;  ///< rate in profile; a swap exchanges left and right arms or legs for 1/3 s (ours)
  bool swaps_when_facing = true;  ///< false: rate proportional to 1 − cos(the body's turn from the sensor) (ours)
  /// Probability of an outlier, per joint and frame (ours). Gaussian noise with uniform outliers: arXiv 1512.04134.
  double outlier_chance = 0.001;
  double outlier_size_m = 0.15;  ///< largest error of an outlier on each axis, drawn uniformly (ours)

  /// Returns the lag in frames: `lag_frames` times the smaller of `strength` and 1, rounded.
  int Lag() const;

  GroupErrors& operator[](JointGroup group) { return groups[Index(group)]; }
  const GroupErrors& operator[](JointGroup group) const { return groups[Index(group)]; }
};

/// Returns the options of Kinect v1 according to published measurements (sources: options.cc). Tests compare the
/// simulator with these measurements.
SkeletonSensorOptions SensorV1();
/// Returns the options of Kinect v2, fitted to a recording with an optical reference. Options that the recording cannot
/// determine have the v1's values or ours.
SkeletonSensorOptions SensorV2();
/// Returns the preset "v1" or "v2"; nullopt for other names.
std::optional<SkeletonSensorOptions> FindSensorPreset(std::string_view name);

/// Reads a sensor file (docs/sensor.md) in YAML. All keys are optional. Missing values come from the preset that
/// `based_on` names.
///
///     based_on: v2                # or v1
///     reference_distance_m: 2.9
///     planted_feet_m: 0.003
///     fast_share: 0.2
///     groups:
///       torso: {size_m: 0.021, depth_ratio: 1.2, still_m: 0.001, white_m: 0.0001}
///     correlation: {upper_arm: 0.04, shank: 0.49}
///
/// Fails for unknown keys and values out of range, with file, line and column.
Result<SkeletonSensorOptions> ReadSensorFile(std::string_view text, const std::string& file);

/// Writes all keys of a sensor file. `strength` is not a key, because it belongs to the scenario. Reading the text and
/// writing it again gives the same text.
std::string WriteSensorFile(const SkeletonSensorOptions& options, std::string_view based_on);

}  // namespace etude
