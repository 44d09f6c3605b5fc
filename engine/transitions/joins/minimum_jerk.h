#pragma once

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
  int fades = 0;  ///< 1: both motions go on (PlayMinimumJerk), where the choice does not say
};
const SettingTable<MinimumJerkOptions>& MinimumJerkSettings();

/// Computes the quintic from an offset and its whole velocity, acceleration 0, to rest at zero after `blend_s`: a
/// movement of least jerk (Flash and Hogan 1985) with that start. Unlike Bollo's it keeps what grows, and what turns
/// the axis.
glm::dvec3 MinimumJerkDecay(const Offset& offset, double seconds, double blend_s);

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
/// By default the new motion plays, and limb by limb what the old one was off from it dies away along MinimumJerkDecay.
/// Velocities are those from the point to the next frame: so the first frame shown is the old motion's next one, and
/// how the new motion jumps at the point itself does not matter. Where the old motion has ended they are those up to
/// the point. When it `fades`, both motions play on, and limb by limb the new one takes over by the share of the way
/// that a movement of least jerk has made: less of what either accelerates is shown, more of how they differ.
class MinimumJerkPlay {
 public:
  /// A join of `frames` ≥ 1 frames, at most the window's, which must outlive this, as must its `turns`: who plays
  /// several fades of one window keeps them.
  MinimumJerkPlay(const JoinWindow& window, WindowTurns& turns, int frames, bool fades);

  /// Returns the pose of a frame from 0, which is the last one shown, to `frames`.
  BodyPose At(int frame) const;

 private:
  const JoinWindow& window_;
  WindowTurns& turns_;
  const int frames_;
  std::optional<Inertialiser> decay_;  ///< without it the motions fade
};

/// Returns every frame of the window by MinimumJerkPlay.
std::vector<BodyPose> PlayMinimumJerk(const JoinWindow& window, bool fades);

Blend MinimumJerk(const JoinInput& input, const MinimumJerkOptions& options);
/// Returns what the choice of frames prefers, or else the options; and the window of that.
PreferredJoin PreferredJoinOf(const JoinInput& input, const MinimumJerkOptions& options);
JoinWindow WindowOfJoin(const JoinInput& input, const PreferredJoin& preferred);
/// Shows `played` (a window's frames), then the new motion.
Blend ShowPlayed(std::vector<BodyPose> played);

}  // namespace etude
