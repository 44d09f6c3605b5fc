#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// The map from the rig's pixels to a film's: scale · rig + shift, each axis by itself; then mirrored, then turned.
struct PixelFit {
  glm::dvec2 scale{1};
  glm::dvec2 shift{0};
  int quarter_turns = 0;     ///< clockwise, 0 to 3
  bool is_mirrored = false;  ///< left and right, before it is turned
  glm::dvec2 size{0};        ///< of the film's picture before it is turned; of one that is turned or mirrored

  glm::dvec2 ToFilm(const glm::dvec2& rig) const;
  glm::dvec2 ToRig(const glm::dvec2& film) const;
  bool IsNone() const { return *this == PixelFit{}; }
  friend bool operator==(const PixelFit&, const PixelFit&) = default;
};

/// The way pictures of one size were made from those of another.
enum class FitMode {
  kNone,       ///< "none": not at all; other sizes are refused
  kLetterbox,  ///< "letterbox": scaled alike in both axes until they fit in, bars of equal size added
  kStretch,    ///< "stretch": scaled in each axis by itself
  kCrop,       ///< "crop": cut off alike on opposite sides, or bars added; not scaled
};

std::optional<FitMode> FindFitMode(std::string_view name);

/// Computes the map from the rig's pixels to the film's. Fails when sizes differ and `mode` is kNone, and for sizes of
/// nothing.
Result<PixelFit> FitPictures(FitMode mode, const glm::dvec2& rig, const glm::dvec2& film);

}  // namespace etude
