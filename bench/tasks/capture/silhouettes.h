#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "engine/capture/recover_frames.h"
#include "engine/kinematics/capture_body.h"
#include "engine/silhouettes/silhouette_follower.h"
#include "sim/random/stream.h"

namespace etude {

/// The inputs of tracking a person by silhouettes.
struct SilhouetteInputs {
  const BodyPose& first;  ///< the first true pose; used only if the start is `kNear`
  const WorldKey& key;
  const CaptureBody& body;  ///< paper B's body; its limb lengths are used
  std::span<const ProjectionMatrix> cameras;
  SilhouetteStart start = SilhouetteStart::kCold;
  int picture_every = 1;  ///< number of frames from one picture to the next
  /// The marks as `marks[camera][frame]`, without lens distortion. They are used only if `start` is `kKeypoints`.
  std::span<const std::vector<Marks>> marks = {};
};

/// Tracks silhouettes over the whole take (engine/silhouettes). `masks[camera][picture]` have half the pictures' size.
/// Returns one pose per picture; nullopt if no pose was found.
std::vector<std::optional<RecoveredFrame>> FollowSilhouettes(const SilhouetteInputs& inputs,
                                                             std::span<const std::vector<Mask>> masks);

/// Tracks silhouettes picture by picture. Each pose depends only on the pictures up to the time of the pose.
class LiveSilhouettes {
 public:
  /// `inputs.body` must outlive this object.
  explicit LiveSilhouettes(const SilhouetteInputs& inputs);

  /// Returns the next pose from one mask per camera; nullopt if no pose was found.
  std::optional<RecoveredFrame> Next(std::span<const Mask> masks);

 private:
  const CaptureBody& body_;
  SilhouetteFollower follower_;
  TreeState last_;
};

}  // namespace etude
