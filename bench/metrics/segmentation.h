#pragma once

#include <optional>
#include <span>

#include "engine/base/image.h"

namespace etude {

/// The agreement of one mask with the true mask, or the mean over many masks. A share whose denominator has no pixels
/// is empty.
struct MaskScore {
  std::optional<double> iou = {};           ///< |found ∩ true| / |found ∪ true|
  std::optional<double> precision = {};     ///< |found ∩ true| / |found|
  std::optional<double> recall = {};        ///< |found ∩ true| / |true|
  std::optional<double> f1 = {};            ///< 2 |found ∩ true| / (|found| + |true|)
  std::optional<double> shadow_error = {};  ///< |found ∩ shadow| / |shadow|
  std::optional<double> pwc = {};           ///< 100 |found ≠ true| / |pixels|: percentage of wrong classification
};

/// Scores a mask against the true mask. `shadow` marks the pixels of the room that lie in the person's shadow. All
/// three masks have the same size.
MaskScore ScoreMask(const Mask& found, const Mask& truth, const Mask& shadow);

/// Returns the mean of each score over the images that have this score.
MaskScore MeanScore(std::span<const MaskScore> scores);

}  // namespace etude
