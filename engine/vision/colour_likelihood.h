#pragma once

#include <vector>

#include "engine/base/image.h"

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

}  // namespace etude
