#pragma once

#include <optional>
#include <span>

#include "engine/base/image.h"

namespace etude {

/// The agreement of one mask with the true one, or the mean of many. A share whose denominator has no pixels is empty.
struct MaskScore {
  std::optional<double> iou = {};           ///< |found ∩ true| / |found ∪ true|
  std::optional<double> precision = {};     ///< |found ∩ true| / |found|
  std::optional<double> recall = {};        ///< |found ∩ true| / |true|
  std::optional<double> f1 = {};            ///< 2 |found ∩ true| / (|found| + |true|)
  std::optional<double> shadow_error = {};  ///< |found ∩ shadow| / |shadow|
  std::optional<double> pwc = {};           ///< 100 |found ≠ true| / |pixels|: percentage of wrong classification
};

/// Scores a mask. All three have the same size; `shadow` marks the pixels of the room that are in the person's shadow.
MaskScore ScoreMask(const Mask& found, const Mask& truth, const Mask& shadow);

/// Returns the mean of each value over the images that have it.
MaskScore MeanScore(std::span<const MaskScore> scores);

}  // namespace etude
