#pragma once

#include <memory>

#include "engine/base/image.h"

namespace etude {

/// A picture that is laid on a surface by coordinates (u, v): (0, 0) is its upper left corner, (1, 1) the lower right
/// one.
struct Texture {
  /// What lies beyond 0…1.
  enum class Beyond { kRepeats, kMirrors, kStays };

  ColourImage picture;
  Beyond beyond_u = Beyond::kRepeats, beyond_v = Beyond::kRepeats;
};

/// Shared between a file's materials, the surfaces of every frame and what draws them: large, and never changed.
using SharedTexture = std::shared_ptr<const Texture>;

}  // namespace etude
