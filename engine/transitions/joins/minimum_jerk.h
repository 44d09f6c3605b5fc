#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/transitions/joins/crossfade.h"
#include "engine/transitions/joins/inertialise.h"
#include "engine/transitions/joins/join.h"

namespace etude {

struct MinimumJerkOptions {
  /// The time until only the new motion is shown, in seconds, unless the choice of frames sets it (the default is
  /// ours). Accelerations fall with the square of this time, but poses that are in neither clip are shown for a longer
  /// time.
  double blend_s = 0.5;
  int fades = 0;   ///< if 1, use JoinStyle::kFades, unless the choice of frames prefers a style
  int direct = 0;  ///< if 1, use JoinStyle::kDirect, unless the choice of frames prefers a style
};
const SettingTable<MinimumJerkOptions>& MinimumJerkSettings();

/// A movement relative to its end position: a translation in metres, or a limb's rotation vector in radians; velocities
/// are per second.
struct Movement {
  glm::dvec3 start{0}, start_velocity{0}, end_velocity{0};
};
/// Returns the position in a movement, relative to its end, `seconds` after its start. The curve is the quintic of
/// minimum jerk (Flash and Hogan 1985), with the given velocities and zero accelerations at both ends. The result is
/// zero from `blend_s` on.
glm::dvec3 MinimumJerkAt(const Movement& movement, double seconds, double blend_s);

/// The frames of a join, in the coordinate frame of the spliced motion. "The point" is the transition point.
struct JoinWindow {
  PosePair shown;                       ///< the last two frames shown
  BodyPose target_before;               ///< the new motion's frame before the point
  std::vector<BodyPose> old, next;      ///< frames of both motions from the point on; same size, at least one
  int old_frames = 0, next_frames = 0;  ///< frames after the point until the motion ends; its last frame then repeats
  double rate_hz = kJudgedRateHz;

  int Frames() const { return static_cast<int>(next.size()) - 1; }
};

/// Returns the window of `frames` frames after the point. A motion that ends earlier repeats its last frame.
JoinWindow WindowOf(const JoinInput& input, int frames);

/// Caches the rotations from the new motion's limbs to the old motion's limbs, which all fades of a window share. Each
/// frame is computed on first use.
class WindowTurns {
 public:
  explicit WindowTurns(const JoinWindow& window) : window_(window) {}
  const LimbTurns& At(int frame);

 private:
  const JoinWindow& window_;
  std::vector<LimbTurns> turns_;
};

/// Computes the shown poses of a window, frame by frame. There are three kinds of join:
/// - kDecays: the new motion plays, and limb by limb the offset of the old motion from the new motion decays with
///   minimum jerk. Velocities are measured from the transition point to the next frame, so the first shown frame is
///   almost the old motion's next frame, and a jump of the new motion just before the transition point has no effect.
///   If the old motion ends at the transition point, velocities are measured from the frame before that point.
/// - kFades: both motions play, and the share of the new motion grows along a minimum-jerk curve, limb by limb.
///   Compared with kDecays, the accelerations of both motions are shown only in part (weighted by the shares), but the
///   changing difference between the motions causes further accelerations.
/// - kDirect: every limb and the hip centre move with minimum jerk from the old motion's pose to the new motion's pose
///   at the end of the join, with the motions' velocities at both ends. What the two motions do between these two poses
///   is not shown.
class MinimumJerkPlay {
 public:
  /// Plays a join of `frames` frames, from 1 to the window's number of frames. `window` and `turns` must outlive this
  /// object; all fades of a window may share one `turns`.
  MinimumJerkPlay(const JoinWindow& window, WindowTurns& turns, int frames, JoinStyle way);

  /// Returns the pose in a frame of the join, from 0 (the last frame shown before it) to `frames`.
  BodyPose At(int frame) const;

 private:
  const JoinWindow& window_;
  WindowTurns& turns_;
  const int frames_;
  std::optional<Inertialiser> decay_;
  /// Movements relative to their ends: each limb's rotation vector, indexed by the limb's child joint, and the root's
  /// position.
  std::optional<std::array<Movement, kRoleCount>> movements_;  ///< only for JoinStyle::kDirect
};

/// Returns all frames of the window as MinimumJerkPlay computes them.
std::vector<BodyPose> PlayMinimumJerk(const JoinWindow& window, JoinStyle way);

Blend MinimumJerk(const JoinInput& input, const MinimumJerkOptions& options);
/// Returns the join that the choice of frames prefers; if it prefers none, the join that `options` describe.
/// WindowOfJoin returns the window of that join.
PreferredJoin PreferredJoinOf(const JoinInput& input, const MinimumJerkOptions& options);
JoinWindow WindowOfJoin(const JoinInput& input, const PreferredJoin& preferred);
/// Returns a blend that shows the frames `played` of a window, then the new motion.
Blend ShowPlayed(std::vector<BodyPose> played);

}  // namespace etude
