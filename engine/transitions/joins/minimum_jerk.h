#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/transitions/joins/crossfade.h"
#include "engine/transitions/joins/inertialise.h"
#include "engine/transitions/joins/join.h"

namespace etude {

struct MinimumJerkOptions {
  /// Seconds until the new motion is shown alone, where the choice of frames does not say. Ours. Longer ones accelerate
  /// less, with its square, and show poses of neither clip for longer.
  double blend_s = 0.5;
  int fades = 0;   ///< 1: JoinWay::kFades, where the choice does not say
  int direct = 0;  ///< 1: JoinWay::kDirect, likewise
};
const SettingTable<MinimumJerkOptions>& MinimumJerkSettings();

/// A movement as seen from its end: metres, or the turn of a limb in radians; velocities per second.
struct Movement {
  glm::dvec3 start{0}, start_velocity{0}, end_velocity{0};
};
/// Computes where a movement is `seconds` after it began: the quintic of least jerk (Flash and Hogan 1985) with these
/// velocities, and without acceleration, at both ends; zero from its end on, `blend_s` after it began.
glm::dvec3 MinimumJerkAt(const Movement& movement, double seconds, double blend_s);

/// A join's window, in the place where it is shown.
struct JoinWindow {
  PosePair shown;                       ///< the last two frames shown
  BodyPose target_before;               ///< the new motion's frame before the point
  std::vector<BodyPose> old, next;      ///< both motions' own frames from the point on; as many each, one at least
  int old_frames = 0, next_frames = 0;  ///< how many after the point are real, not their last one held
  double rate_hz = kJudgedRateHz;

  int Frames() const { return static_cast<int>(next.size()) - 1; }
};

/// The window of `frames` frames after the point; where a motion ends earlier, it holds its last frame.
JoinWindow WindowOf(const JoinInput& input, int frames);

/// The turns from the new motion's limbs to the old one's in a window, which no length of a fade changes: each frame's
/// are computed when they are first asked for.
class WindowTurns {
 public:
  explicit WindowTurns(const JoinWindow& window) : window_(window) {}
  const LimbTurns& At(int frame);

 private:
  const JoinWindow& window_;
  std::vector<LimbTurns> turns_;
};

/// Computes what is shown of a window, frame by frame.
///
/// When it decays, the new motion plays, and limb by limb what the old one was off from it dies away with least jerk.
/// Velocities are those from the point to the next frame: so the first frame shown is the old motion's next one, and
/// how the new motion jumps at the point itself does not matter. Where the old motion has ended they are those up to
/// the point. When it fades, both motions play on, and limb by limb the new one takes over by the share of the way
/// that a movement of least jerk has made: less of what either accelerates is shown, more of how they differ. When it
/// is direct, every limb, and the hips' centre, goes with least jerk from where the old motion left it to where the new
/// one has it at the join's end, with its velocities at both: of what either accelerates in between nothing is shown.
class MinimumJerkPlay {
 public:
  /// A join of `frames` ≥ 1 frames, at most the window's, which must outlive this, as must its `turns`: who plays
  /// several fades of one window keeps them.
  MinimumJerkPlay(const JoinWindow& window, WindowTurns& turns, int frames, JoinWay way);

  /// Returns the pose of a frame from 0, which is the last one shown, to `frames`.
  BodyPose At(int frame) const;

 private:
  const JoinWindow& window_;
  WindowTurns& turns_;
  const int frames_;
  std::optional<Inertialiser> decay_;
  /// The movements by limb, of its child joint, as a turn from where it ends; of the root its place.
  std::optional<std::array<Movement, kRoleCount>> movements_;  ///< with neither the motions fade
};

/// Returns every frame of the window by MinimumJerkPlay.
std::vector<BodyPose> PlayMinimumJerk(const JoinWindow& window, JoinWay way);

Blend MinimumJerk(const JoinInput& input, const MinimumJerkOptions& options);
/// Returns what the choice of frames prefers, or else the options; and the window of that.
PreferredJoin PreferredJoinOf(const JoinInput& input, const MinimumJerkOptions& options);
JoinWindow WindowOfJoin(const JoinInput& input, const PreferredJoin& preferred);
/// Shows `played` (a window's frames), then the new motion.
Blend ShowPlayed(std::vector<BodyPose> played);

}  // namespace etude
