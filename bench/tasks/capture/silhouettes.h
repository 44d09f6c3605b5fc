#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "engine/base/result.h"
#include "engine/capture/recover_frames.h"

namespace etude {

struct SilhouetteInputs {
  /// Of the world the limb lengths are used; of its truth, the first frame's pose when the start is `kNear`.
  const CaptureWorld& world;
  const WorldKey& key;
  std::span<const ProjectionMatrix> cameras;
  /// `masks[camera][frame]`, half size.
  std::span<const std::vector<Mask>> masks;
  SilhouetteStart start = SilhouetteStart::kCold;
};

/// The poses that silhouettes alone tell (engine/silhouettes). Fails when there are more pictures than are held in
/// memory.
Result<std::vector<std::optional<RecoveredFrame>>> FollowSilhouettes(const SilhouetteInputs& inputs);

}  // namespace etude
