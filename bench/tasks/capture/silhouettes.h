#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "engine/base/result.h"
#include "engine/capture/recover_frames.h"
#include "engine/kinematics/capture_body.h"
#include "sim/random/stream.h"

namespace etude {

struct SilhouetteInputs {
  std::span<const BodyPose> truth;  ///< its first pose is used when the start is `kNear`, and nothing else
  const WorldKey& key;
  const CaptureBody& body;  ///< paper B's, of which the limb lengths are used
  std::span<const ProjectionMatrix> cameras;
  /// `masks[camera][frame]`, half size.
  std::span<const std::vector<Mask>> masks;
  SilhouetteStart start = SilhouetteStart::kCold;
};

/// The poses that silhouettes alone tell (engine/silhouettes). Fails when there are more pictures than are held in
/// memory.
Result<std::vector<std::optional<RecoveredFrame>>> FollowSilhouettes(const SilhouetteInputs& inputs);

}  // namespace etude
