#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "engine/base/result.h"
#include "engine/capture/recover_frames.h"
#include "engine/kinematics/capture_body.h"
#include "engine/silhouettes/moment_fitter.h"
#include "engine/silhouettes/silhouette_follower.h"
#include "sim/random/stream.h"

namespace etude {

/// The prior knowledge of a person who is followed by silhouettes.
struct SilhouetteInputs {
  const BodyPose& first;  ///< the first true pose, used when the start is `kNear`, and for nothing else
  const WorldKey& key;
  const CaptureBody& body;  ///< paper B's, of which the limb lengths are used
  std::span<const ProjectionMatrix> cameras;
  SilhouetteStart start = SilhouetteStart::kCold;
  int picture_every = 1;  ///< frames from one picture to the next
  /// `marks[camera][frame]`, lenses undone: used when the start is `kKeypoints`.
  std::span<const std::vector<Marks>> marks = {};
};

/// The poses that silhouettes alone tell (engine/silhouettes), one per picture of each camera:
/// `masks[camera][picture]`, half size.
std::vector<std::optional<RecoveredFrame>> FollowSilhouettes(const SilhouetteInputs& inputs,
                                                             std::span<const std::vector<Mask>> masks);

/// Follows silhouettes picture by picture, each pose from the pictures up to it alone.
class LiveSilhouettes {
 public:
  /// `inputs.body` must outlive this.
  explicit LiveSilhouettes(const SilhouetteInputs& inputs);

  /// One mask per camera.
  std::optional<RecoveredFrame> Next(std::span<const Mask> masks);

 private:
  const CaptureBody& body_;
  SilhouetteFollower follower_;
  TreeState last_;
};

}  // namespace etude
