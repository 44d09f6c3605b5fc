#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "engine/vision/change_detection.h"

namespace etude {

/// Tells one camera's pictures pixel by pixel what they show likelier *(ours)*: the room behind, as it is or in a
/// shadow or more light, or one of the colours that the person wears. These are learnt from picture to picture, as a
/// histogram that forgets; the first pictures are judged by hues alone. Evidence is smoothed over neighbours, and
/// stands against a person far from where the one before was. The lamp's drift is undone first.
class ColourLikelihood {
 public:
  /// @param background the empty room
  explicit ColourLikelihood(const ColourImage& background);

  /// Finds the pixels that likelier show the person. The picture is of the background's size.
  Mask Detect(const ColourImage& picture);
  /// Learns the colours of the `person` found in the picture that `Detect` saw last: of what no light of the room
  /// explains, away from the rim, so that shadows are not learnt.
  void Learn(const ColourImage& picture, const Mask& person);

 private:
  void LightRoomAs(const ColourImage& picture);
  Image<float> EvidenceOf(const ColourImage& picture, const Image<float>& room) const;
  void TellColours();

  const ColourImage background_;
  ColourImage room_;         ///< the background in the light of the picture seen last
  Mask strange_;             ///< what no light of the room explains in that picture
  std::vector<float> worn_;  ///< how often each cell of colours was worn
  double worn_sum_ = 0;
  std::vector<float> likelihoods_;  ///< of each cell, when the person is there: logarithms
  Mask near_;                       ///< where the person may be next; empty before anybody was found
};

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
