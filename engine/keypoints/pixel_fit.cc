#include "engine/keypoints/pixel_fit.h"

#include <algorithm>

#include "engine/base/named.h"

namespace etude {

glm::dvec2 PixelFit::ToFilm(const glm::dvec2& rig) const {
  glm::dvec2 p = scale * rig + shift;
  if (is_mirrored) p.x = size.x - p.x;
  if (quarter_turns == 1) return {size.y - p.y, p.x};
  if (quarter_turns == 2) return size - p;
  return quarter_turns == 3 ? glm::dvec2(p.y, size.x - p.x) : p;
}

glm::dvec2 PixelFit::ToRig(const glm::dvec2& film) const {
  glm::dvec2 p = film;
  if (quarter_turns == 1) p = {film.y, size.y - film.x};
  if (quarter_turns == 2) p = size - film;
  if (quarter_turns == 3) p = {size.x - film.y, film.x};
  if (is_mirrored) p.x = size.x - p.x;
  return (p - shift) / scale;
}

std::optional<FitMode> FindFitMode(std::string_view name) {
  constexpr Named<FitMode> kModes[] = {{"none", FitMode::kNone},
                                       {"letterbox", FitMode::kLetterbox},
                                       {"stretch", FitMode::kStretch},
                                       {"crop", FitMode::kCrop}};
  return FindValue(kModes, name);
}

Result<PixelFit> FitPictures(FitMode mode, const glm::dvec2& rig, const glm::dvec2& film) {
  if (!(rig.x > 0 && rig.y > 0 && film.x > 0 && film.y > 0))
    return Fail({}, "the width or height of a picture is not above 0");
  if (rig == film) return PixelFit{};
  switch (mode) {
    case FitMode::kNone:
      return Fail({},
                  "the film has {:g} x {:g} pixels, but the rig's camera has {:g} x {:g}; use --fit to state how the "
                  "pictures were resized (letterbox, stretch or crop)",
                  film.x, film.y, rig.x, rig.y);
    case FitMode::kLetterbox: {
      const double scale = std::min(film.x / rig.x, film.y / rig.y);
      return PixelFit{.scale = glm::dvec2(scale), .shift = 0.5 * (film - scale * rig)};
    }
    case FitMode::kStretch:
      return PixelFit{.scale = film / rig};
    case FitMode::kCrop:
      return PixelFit{.shift = 0.5 * (film - rig)};
  }
  return PixelFit{};
}

}  // namespace etude
