#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// The map from the rig's pixels to a film's: scale · pixel + shift on each axis, then the mirroring, then the
/// rotation.
struct PixelFit {
  glm::dvec2 scale{1};
  glm::dvec2 shift{0};
  int quarter_turns = 0;     ///< clockwise, 0 to 3
  bool is_mirrored = false;  ///< left and right exchanged, before the rotation
  glm::dvec2 size{0};        ///< size of the film's picture before the rotation; used if it is rotated or mirrored

  glm::dvec2 ToFilm(const glm::dvec2& rig) const;
  glm::dvec2 ToRig(const glm::dvec2& film) const;
  bool IsNone() const { return *this == PixelFit{}; }
  friend bool operator==(const PixelFit&, const PixelFit&) = default;
};

/// The way in which pictures of one size were made from pictures of another.
enum class FitMode {
  kNone,       ///< "none": unchanged; other sizes are refused
  kLetterbox,  ///< "letterbox": scaled equally on both axes until they fit, with bars of equal size
  kStretch,    ///< "stretch": scaled on each axis separately
  kCrop,       ///< "crop": cropped equally on opposite sides, or padded with bars; not scaled
};

std::optional<FitMode> FindFitMode(std::string_view name);

/// Computes the map from the rig's pixels to the film's. Fails if the sizes differ and `mode` is kNone, and if a size
/// is not positive.
Result<PixelFit> FitPictures(FitMode mode, const glm::dvec2& rig, const glm::dvec2& film);

}  // namespace etude
