#pragma once

#include <vector>

#include "bench/tasks/tracking/options.h"
#include "engine/kinematics/tree.h"
#include "io/clips/clip_library.h"
#include "sim/random/stream.h"

namespace etude {

/// A motion that solvers follow: paper B's body with the limb lengths of a clip's performer, and the targets of its end
/// effectors in every frame. The truth is a motion of this body. Its limbs point in the directions of the clip's limbs
/// as far as joints and limits allow (FindStartState), so every target can be reached unless it is disturbed. The
/// motion differs from the clip, because the clip has joints that this body lacks.
///
/// No angle of the truth turns faster than 1200° per second, the speed of a boxer's elbow. Without this bound, an arm
/// that exceeds its limit would jump from one end of its range to the other within a frame, and a straight arm would
/// spin. With the bound, an arm that exceeds its limit stays at the end where it left its range, even if the other end
/// is nearer.
struct TrackingWorld {
  KinematicTree tree;
  std::vector<TreeState> truth;                      ///< one state per frame; solvers are given only the root of each
                                                     ///< state
  std::vector<std::vector<EffectorTarget>> targets;  ///< indexed [frame][effector]
  std::vector<double> first_angles;                  ///< the angles at which the first frame starts, within the limits
};

/// Makes the world of `key`. The window of the clip begins at a random frame. Clips that loop are repeated; other clips
/// that are shorter than the window are used whole. If the rate is not the clips' 30 Hz, joints are interpolated
/// linearly between two frames. In a secret world the clip is disguised (bench/tasks/base/disguise.h), its place and
/// heading are random, and the five angles that no target determines are random functions of time. Fails if the
/// window has fewer than kMinTrackedFrames frames, or if a frame's limbs give no pose of the body.
Result<TrackingWorld> MakeTrackingWorld(const TrackingOptions& options, const LibraryClip& clip, const WorldKey& key);
/// Makes a world for a given body. The body's limb lengths may differ from those of the clip's performer.
Result<TrackingWorld> MakeTrackingWorld(const KinematicTree& body, const TrackingOptions& options,
                                        const LibraryClip& clip, const WorldKey& key);

}  // namespace etude
