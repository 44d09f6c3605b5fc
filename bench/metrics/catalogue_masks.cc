#include "bench/metrics/catalogue_parts.h"

namespace etude {
namespace {

using enum Direction;
using enum Aggregate;

const std::vector<MetricInput> kImages = {{"images",
                                           "per image: `found`, `truth` and `shadow`, masks of one size, each a list "
                                           "of rows from the top, each a list of 0 and 1"}};

const char* const kReason = "One pixel in a hundred.";

}  // namespace

std::vector<MetricInfo> MaskCatalogue() {
  return {
      {.id = "iou",
       .label = "person mask overlap (IoU)",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Pixels in both the found and the true person over pixels in either, mean over images.",
       .practical_reason = kReason,
       .formula = "Per image |found ∩ true| / |found ∪ true|; then the mean over the images that have a value (not the "
                  "quotient of sums). An image without a person, found or true, has none.",
       .null_rule = "When no image shows or finds a person" + kOutside,
       .source = "Jaccard 1912.",
       .inputs = kImages},
      {.id = "mask_precision",
       .label = "mask precision",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Share of pixels called person that are person, mean over images.",
       .practical_reason = kReason,
       .formula = "Per image |found ∩ true| / |found|; then the mean over the images in which anything was found.",
       .null_rule = "When nothing was found in any image" + kOutside,
       .source = "van Rijsbergen 1979.",
       .inputs = kImages},
      {.id = "mask_recall",
       .label = "mask recall",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Share of person pixels that are called person, mean over images.",
       .practical_reason = kReason,
       .formula = "Per image |found ∩ true| / |true|; then the mean over the images that show a person.",
       .null_rule = "When no image shows a person" + kOutside,
       .source = "van Rijsbergen 1979.",
       .inputs = kImages},
      {.id = "mask_f1",
       .label = "mask F1",
       .unit = "",
       .direction = kHigherIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Harmonic mean of mask precision and recall, mean over images.",
       .practical_reason = kReason,
       .formula = "Per image 2 |found ∩ true| / (|found| + |true|); then the mean over the images that have a value: "
                  "not the harmonic mean of the two means. 0 where a person was missed altogether.",
       .null_rule = "When no image shows or finds a person" + kOutside,
       .source = "Dice 1945.",
       .inputs = kImages},
      {.id = "shadow_error",
       .label = "shadow taken for person",
       .unit = "",
       .direction = kLowerIsBetter,
       .aggregate = kMedian,
       .practical = 0.01,
       .definition = "Share of true shadow pixels called person, mean over images.",
       .practical_reason = "One shadow pixel in a hundred.",
       .formula = "Per image |found ∩ shadow| / |shadow|; then the mean over the images that show a shadow. The shadow "
                  "is where the room, not the person, lies in the person's shadow.",
       .null_rule = "When no image shows a shadow" + kOutside,
       .source = "Prati et al. 2003 (1 − their shadow detection rate).",
       .inputs = kImages},
  };
}

}  // namespace etude
