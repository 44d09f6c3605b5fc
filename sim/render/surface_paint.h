#pragma once

#include <glm/glm.hpp>

#include "engine/base/image.h"

namespace etude {

/// How two colours share a surface. Places are metres in the surface's own space: of clothes the body at rest (so that
/// patterns move with it), of a wall or floor its plane, of furniture the box.
enum class Pattern {
  kPlain,      ///< the first colour
  kBands,      ///< level bands, `size` apart
  kStripes,    ///< upright stripes, `size` apart
  kChecks,     ///< bands over stripes
  kTwoTone,    ///< the second colour below the height `size`
  kPlanks,     ///< boards of width `size`, each a tone of its own
  kTiles,      ///< squares of side `size`, each a tone of its own, joints between
  kSpeckle,    ///< grains of `size`: carpet, plaster, bark
  kPatchwork,  ///< blocks of `size`, each somewhere between the two colours: books, pictures
};

/// A painted surface.
struct SurfacePaint {
  Rgb8 first{};
  Rgb8 second{};
  Pattern pattern = Pattern::kPlain;
  double size = 0.1;         ///< metres
  glm::dvec2 patch{0};       ///< x and y of the middle of a patch of the second colour, in front (z > 0)
  glm::dvec2 patch_half{0};  ///< half its width and height; 0: no patch
  bool is_cloth = false;     ///< with seams and creases
  friend bool operator==(const SurfacePaint&, const SurfacePaint&) = default;
};

}  // namespace etude
