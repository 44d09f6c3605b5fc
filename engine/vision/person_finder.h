#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "engine/vision/change_detection.h"
#include "engine/vision/colour_likelihood.h"

namespace etude {

/// Finds the person among the pixels that changed: the pieces that `options` names, and their small holes.
Mask PersonAmong(Mask changed, const PersonOptions& options);

/// Cuts the person out of one camera's pictures, one after the other: what `ExtractPerson` does, pixel by pixel the
/// same, with what depends on the background alone computed once; and `kRunning` and `kLikelihood`, which remember.
class PersonFinder {
 public:
  /// `background` is the empty room; not looked at by `kRunning`, but for its size.
  PersonFinder(const ColourImage& background, const PersonOptions& options);

  /// Finds the person in the next picture, which is of the background's size.
  Mask Find(const ColourImage& picture);

  /// Finds the pixels that changed, before the largest piece is kept (`DetectChange`).
  Mask Detect(const ColourImage& picture);

 private:
  void CompareHues(const ColourImage& picture, Mask& mask) const;
  void Follow(const ColourImage& picture, Mask& mask);

  PersonOptions options_;
  ColourImage background_;
  std::vector<std::int16_t> x_, y_;  ///< kHue: the background's chromas
  double cosine2_ = 0;               ///< of the threshold
  /// kRunning: mean and squared deviation of every pixel's three colours; empty before the first picture.
  std::vector<float> mean_, variance_;
  std::optional<ColourLikelihood> colours_;  ///< kLikelihood
};

}  // namespace etude
