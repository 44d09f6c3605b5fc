#include "engine/keypoints/pixel_fit.h"

#include <algorithm>

namespace etude {

std::optional<FitMode> FindFitMode(std::string_view name) {
  if (name == "none") return FitMode::kNone;
  if (name == "letterbox") return FitMode::kLetterbox;
  if (name == "stretch") return FitMode::kStretch;
  if (name == "crop") return FitMode::kCrop;
  return std::nullopt;
}

Result<PixelFit> FitPictures(FitMode mode, const glm::dvec2& rig, const glm::dvec2& film) {
  if (!(rig.x > 0 && rig.y > 0 && film.x > 0 && film.y > 0)) return Fail({}, "a picture without size");
  if (rig == film) return PixelFit{};
  switch (mode) {
    case FitMode::kNone:
      return Fail({}, "{:g} x {:g} pixels, the rig's camera {:g} x {:g}; tell how they were fitted (--fit)", film.x,
                  film.y, rig.x, rig.y);
    case FitMode::kLetterbox: {
      const double scale = std::min(film.x / rig.x, film.y / rig.y);
      return PixelFit{glm::dvec2(scale), 0.5 * (film - scale * rig)};
    }
    case FitMode::kStretch:
      return PixelFit{film / rig, glm::dvec2(0)};
    case FitMode::kCrop:
      return PixelFit{glm::dvec2(1), 0.5 * (film - rig)};
  }
  return PixelFit{};
}

}  // namespace etude
