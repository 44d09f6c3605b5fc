#pragma once

#include <vector>

#include "bench/tasks/tracking/options.h"
#include "engine/kinematics/tree.h"
#include "io/clips/clip_library.h"
#include "sim/random/stream.h"

namespace etude {

/// One motion to be followed: paper B's body with the limbs of a clip's performer, and where its ends shall be in every
/// frame. The truth is a motion of that very body, whose limbs point as the clip's as far as joints and limits allow
/// (FindStartState): every target can be reached, unless it is disturbed. It is not the clip, which has joints that
/// this body lacks. No angle of it turns faster than 1200° a second *(ours: a boxer's elbow)*: an arm beyond its limit
/// would else go from one end of its range to the other within a frame, a straight one spin. So such an arm stays at
/// the end where it left its range, however long the clip's is nearer to the other one.
struct TrackingWorld {
  KinematicTree tree;
  std::vector<TreeState> truth;                      ///< one per frame; the root is given to solvers
  std::vector<std::vector<EffectorTarget>> targets;  ///< [frame][effector]
  std::vector<double> first_angles;                  ///< what the first frame starts with, within the limits
};

/// The world of `key`. The window of the clip begins by dice; moves that loop are repeated, other clips shorter than
/// the window are taken whole. At rates below the clips' 30 Hz joints lie on the straight line between two frames. In
/// a secret world the clip is disguised (bench/tasks/base/disguise.h), stands and faces anywhere, and five angles that
/// no target tells follow dice of their own.
/// Fails for a clip of fewer than kFewestTrackedFrames frames, and when a frame's limbs give no pose of the body.
Result<TrackingWorld> MakeTrackingWorld(const TrackingOptions& options, const LibraryClip& clip, const WorldKey& key);
/// Makes a world for a body of other limbs than the clip's performer has.
Result<TrackingWorld> MakeTrackingWorld(const KinematicTree& body, const TrackingOptions& options,
                                        const LibraryClip& clip, const WorldKey& key);

}  // namespace etude
