#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "engine/vision/change_detection.h"

namespace [[gnu::visibility("default")]] etude {

/// Classifies one camera's pictures pixel by pixel *(ours)*, by the ratio of two likelihoods of the pixel's colour:
/// given the person, and given the room, which may be unchanged, in shadow or in more light. The person's colours are
/// learnt from picture to picture as a histogram with exponential forgetting; the first pictures are classified by hues
/// alone. The log-likelihood ratio is smoothed over neighbours, and lowered at pixels far from the person's last
/// position. Drift of the lamp is corrected first.
class ColourLikelihood {
 public:
  /// @param background a picture of the empty room
  explicit ColourLikelihood(const ColourImage& background);

  /// Finds the pixels that more likely show the person than the room. The picture must have the background's size.
  Mask Detect(const ColourImage& picture);
  /// Learns the colours of the `person` found in the picture last passed to `Detect`. Pixels near the rim, and pixels
  /// that the room explains in some light, are not learnt, because they may be shadow.
  void Learn(const ColourImage& picture, const Mask& person);

 private:
  void LightRoomAs(const ColourImage& picture);
  Image<float> EvidenceOf(const ColourImage& picture, const Image<float>& room) const;
  void TellColours();

  const ColourImage background_;
  ColourImage room_;         ///< the background in the light of the last picture
  Mask strange_;             ///< pixels of the last picture that the room does not explain in any light
  std::vector<float> worn_;  ///< for each colour cell: the decayed count of the person's pixels
  double worn_sum_ = 0;
  std::vector<float> likelihoods_;  ///< log-likelihood of each cell, given the person
  Mask near_;  ///< pixels that the person can reach in the next picture; empty before a person was found
};

/// Finds the person among the changed pixels: selects components by `options`, and fills small holes in the result.
Mask PersonAmong(Mask changed, const PersonOptions& options);

/// Segments the person in one camera's pictures, one after the other. The masks equal those of `ExtractPerson` in every
/// pixel, but everything that depends only on the background is computed once. This class also supports `kRunning` and
/// `kLikelihood`, which keep a state.
class PersonFinder {
 public:
  /// `background` is a picture of the empty room; `kRunning` uses only its size.
  PersonFinder(const ColourImage& background, const PersonOptions& options);

  /// Finds the person in the next picture, which must have the background's size.
  Mask Find(const ColourImage& picture);

  /// Finds the pixels of the next picture that differ from the background, before components are selected
  /// (`DetectChange`).
  Mask Detect(const ColourImage& picture);

 private:
  void CompareHues(const ColourImage& picture, Mask& mask) const;
  void Follow(const ColourImage& picture, Mask& mask);

  PersonOptions options_;
  ColourImage background_;
  std::vector<std::int16_t> x_, y_;  ///< kHue: the background's chromas
  double cosine2_ = 0;               ///< the threshold's squared cosine
  /// kRunning: mean and variance of every pixel's three channels; empty before the first picture.
  std::vector<float> mean_, variance_;
  std::optional<ColourLikelihood> colours_;  ///< used only by kLikelihood
};

}  // namespace etude
