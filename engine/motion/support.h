#pragma once

#include <array>
#include <bitset>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A set of joints, by role.
using JointSet = std::bitset<kRoleCount>;

/// Rules that decide which joints support a body, without an assumed floor; metres, seconds. The rules are our own.
/// Their values were tuned on a hundred transition requests to each of ten libraries (built-in moves, captures,
/// cartoons) and evaluated on two hundred other requests.
struct SupportRules {
  double lowest = 0.12;       ///< a joint may bear the body if it is at most this high above the lowest joint
  double rest_speed = 0.5;    ///< a joint is at rest up to this speed (feet roll, and captures are noisy)
  double height = 0.025;      ///< a shown joint may be this much higher than the clip's joint at rest
  double heel = 0.03;         ///< a heel is raised if its ankle is this much higher above the toes than in a flat foot
  double toes = 0.05;         ///< toes are raised if they are more than this above the lowest joint of the clip's pose
  double level = 0.12;        ///< rest heights that differ by more than this are two surfaces, such as floor and step
  double window_s = 1.0 / 3;  ///< a clip's rest heights near a frame are those up to this long before or after
  /// A body without support is in flight if the downward acceleration of its centre of mass is in this range, metres
  /// per second², and if the height deviates from a parabola by at most `flight_stray` (root mean square).
  double min_fall = 6.5, max_fall = 13;
  double flight_stray = 0.008;
  double max_push = 3;  ///< largest force, in body weights, with which the ground throws a body into the air
};

/// The joints that support a body in one frame of a clip.
struct Bearing {
  JointSet rests;  ///< lowest joints that are at rest; none while the centre of mass falls (SupportRules::min_fall)
  /// Equals `rests` unless `rests` is empty (a jump, walking on the spot, a skating foot). If it is empty, all of the
  /// lowest joints that do not glide count as bearing, because a clip is taken to be right. A joint glides if it
  /// moves over the floor faster than SupportRules::rest_speed and faster than three times its speed relative to the
  /// hip centre.
  JointSet bears;
};

/// Returns the velocities of all joints, metres per second: central differences, one-sided at both ends; 0 for a single
/// frame.
std::vector<BodyPose> JointVelocities(std::span<const BodyPose> poses, double rate_hz);

/// Finds, for every frame of a clip, the joints that bear the body. No floor is assumed: any of the lowest joints may
/// bear the body.
std::vector<Bearing> FindBearing(std::span<const BodyPose> poses, double rate_hz, const SupportRules& rules = {});

/// The rules for a foot in stance. They are stricter than the default rules, so that contacts are unambiguous.
constexpr SupportRules kFootRules{.lowest = 0.06, .rest_speed = 0.3};
/// For each foot (in the order of Side) and each frame: true if the toes or the ankle support the body. kFootRules
/// decides whether a joint supports the body.
using FootContacts = std::array<std::vector<bool>, 2>;
FootContacts FindFootContacts(std::span<const BodyPose> poses, double rate_hz);

/// A played clip with the time at which it was played. The clip shows where a body may be supported.
struct SupportingClip {
  std::span<const BodyPose> poses;  ///< poses of the clip, moved on the floor to where the clip is shown
  int begin = 0;                    ///< the shown frame of poses[0]; may be outside of the requested frames
  /// The last shown frame of the clip. In later frames, a joint may still rest at a height at which the clip's joint
  /// rests near this frame. By default, the clip is shown to the end.
  int left_at = std::numeric_limits<int>::max();
};

/// The joints that support a body in a shown frame.
struct Support {
  JointSet joints;      ///< joints that rest where the same joint of a clip rests, or move as that joint does
  bool flight = false;  ///< the body is in flight and needs no support

  bool Holds() const { return joints.any() || flight; }
};

/// Finds the joints that support a body while clips are shown. Only joints of the clips show where support is
/// possible, so a motion that floats is not supported at its own lowest height. A raised heel or a raised foot of a
/// clip shows no support while another joint bears the clip's body (SupportRules::heel, toes). A joint supports the
/// body in two cases:
/// - The joint is at rest, and the same joint of a clip is at rest near that time. The clip's joint may rest at several
///   heights, for example on a step. The joint is at most SupportRules::height above and at most SupportRules::level
///   below the lowest of these heights, or within SupportRules::height of another of these heights.
/// - The joint moves like the same joint of a clip, and that joint bears the clip's body in that frame or in the frame
///   before or after it. The heights of the two joints differ by at most SupportRules::height, their velocities by at
///   most SupportRules::rest_speed. Consecutive frames without support are a flight if the body is supported just
///   before and just after them, if the ground can have thrown it (SupportRules::max_push), and if the centre of mass
///   falls within the limits min_fall, max_fall and flight_stray of SupportRules. The fall is judged over these frames,
///   or over these frames and the two neighbouring frames, but at least over five frames.
class SupportFinder {
 public:
  /// The clips' poses must outlive this object.
  SupportFinder(std::span<const SupportingClip> clips, double rate_hz, const SupportRules& rules = {});
  ~SupportFinder();
  SupportFinder(const SupportFinder&) = delete;
  SupportFinder& operator=(const SupportFinder&) = delete;

  /// Returns the support of the body in the frames `first` … `last` of `shown`; both must be valid indices.
  std::vector<Support> Find(std::span<const BodyPose> shown, int first, int last) const;

 private:
  class ClipSupport;
  const double rate_hz_;
  const SupportRules rules_;
  std::vector<ClipSupport> clip_supports_;
};

/// Makes a SupportFinder and returns the result of its Find. Use it if the clips are needed only once.
std::vector<Support> FindSupport(std::span<const BodyPose> shown, std::span<const SupportingClip> clips, int first,
                                 int last, double rate_hz, const SupportRules& rules = {});

/// Returns the centre of mass, computed from fourteen segments with Dempster's masses and centres as given by Winter
/// (2009), "Biomechanics and Motor Control of Human Movement", table 4.1. The mass of head and neck is at the head
/// joint; hands extend to the finger tips.
glm::dvec3 MassCentre(const BodyPose& pose);

/// Returns the horizontal distance from a point (x, z) of the floor to the convex hull of `joints`, metres; 0 inside
/// the hull. Returns nullopt if `joints` is empty. Feet have no width here.
std::optional<double> OffsetFromJoints(const glm::dvec2& point, const BodyPose& pose, const JointSet& joints);
/// Returns OffsetFromJoints of the centre of mass.
std::optional<double> BalanceOffset(const BodyPose& pose, const JointSet& joints);

}  // namespace etude
