#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// A set of joints, by role.
using JointSet = std::bitset<kRoleCount>;

/// The rules of support: what holds a body up, whatever its floor. Metres, seconds. Ours; tuned on a hundred requests
/// to each of ten libraries (built-in moves, captures, cartoons), judged on two hundred others.
struct SupportRules {
  double lowest = 0.12;       ///< a joint this little above the body's lowest one may bear it
  double rest_speed = 0.5;    ///< a joint that is no faster is at rest: feet roll, and takes are noisy
  double height = 0.025;      ///< a shown joint may be so far above the height at which a clip's own joint rests
  double level = 0.12;        ///< heights of rest further apart than this are two surfaces: a floor and a step
  double window_s = 1.0 / 3;  ///< a clip is asked where a joint rests so long before and after the shown frame
  /// A body that nothing holds is in flight while the vertical acceleration of its mass centre, metres per second², is
  /// within this band and it strays from its parabola by no more than `flight_stray` (root mean square).
  double least_fall = 6.5, most_fall = 13;
  double flight_stray = 0.008;
};

/// The joints that hold a body up in one frame of a clip.
struct Bearing {
  JointSet rests;  ///< those of its lowest joints that are at rest; none while its mass centre falls (least_fall)
  /// `rests`; where it is empty (a jump, a walk on the spot, a foot that skates), all of the lowest joints, for the
  /// clip itself shows it so, but for those of a body that glides: faster over the floor than SupportRules::rest_speed
  /// and three times as fast as they move as seen from the hips.
  JointSet bears;
};

/// The velocities of all joints, metres per second: central differences, and one-sided ones at both ends; 0 of a single
/// frame.
std::vector<BodyPose> JointVelocities(std::span<const BodyPose> poses, double rate_hz);

/// Finds what bears a body in every frame of its clip. No floor is assumed: a joint may bear when it is one of the
/// lowest.
std::vector<Bearing> FindBearing(std::span<const BodyPose> poses, double rate_hz, const SupportRules& rules = {});

/// The rules of a foot that stands, narrower than those of support: it should do so clearly.
constexpr SupportRules kFootRules{.lowest = 0.06, .rest_speed = 0.3};
/// Tells whether each foot bears the body by kFootRules, with its toes or its ankle; by side (Side's order) and frame.
using FootContacts = std::array<std::vector<bool>, 2>;
FootContacts FindFootContacts(std::span<const BodyPose> poses, double rate_hz);

/// A clip that tells what a body may rest on where it is shown.
struct SupportingClip {
  std::span<const BodyPose> poses;  ///< placed on the floor as it is shown
  int begin = 0;                    ///< the frame shown where poses[0] stands; may be beyond the frames asked for
  /// The last shown frame that was the clip's own: what it rested on there may be rested on later, too. None: a clip
  /// that is entered.
  int left_at = std::numeric_limits<int>::max();
};

/// The joints that hold a body up in a frame that is shown.
struct Support {
  JointSet joints;      ///< those that rest where, or move as, the clips' own do
  bool flight = false;  ///< it flies: nothing need hold it

  bool Holds() const { return joints.any() || flight; }
};

/// Finds what holds up a body where clips are shown. The clips alone say what can: a motion that floats cannot be its
/// own floor. A joint supports
/// - when it is at rest where the same joint rests in a clip at about that time: at most SupportRules::height above the
///   lowest of these places and at most SupportRules::level below it, or within `height` of a higher surface, or
/// - when it does what a joint that bears the clip does at that frame or the next to it: its height differs by no more
///   than SupportRules::height, its velocity by no more than SupportRules::rest_speed.
/// Frames in a row without any are a flight when the mass centre falls as SupportRules says over them, or over them and
/// the frame before and after, five frames at least, and something holds the body in those two: it takes off and lands.
class SupportFinder {
 public:
  /// The clips' poses must outlive this.
  SupportFinder(std::span<const SupportingClip> clips, double rate_hz, const SupportRules& rules = {});
  ~SupportFinder();
  SupportFinder(const SupportFinder&) = delete;
  SupportFinder& operator=(const SupportFinder&) = delete;

  /// Returns what holds the body up in the frames `first` … `last` of `shown`, both within it.
  std::vector<Support> Find(std::span<const BodyPose> shown, int first, int last) const;

 private:
  class Witness;
  const double rate_hz_;
  const SupportRules rules_;
  std::vector<Witness> witnesses_;
};

/// Finds as SupportFinder::Find does, of clips that are asked once.
std::vector<Support> FindSupport(std::span<const BodyPose> shown, std::span<const SupportingClip> clips, int first,
                                 int last, double rate_hz, const SupportRules& rules = {});

/// The centre of mass: of fourteen segments, their masses and centres Dempster's as in Winter (2009), "Biomechanics and
/// Motor Control of Human Movement", table 4.1; head and neck at the head joint, hands to the finger tips.
glm::dvec3 MassCentre(const BodyPose& pose);

/// The distance over the floor from the point below the mass centre to the convex hull of `joints`, seen from above,
/// metres; 0 within it. None without joints. Feet have no width here.
std::optional<double> BalanceOffset(const BodyPose& pose, const JointSet& joints);

}  // namespace etude
