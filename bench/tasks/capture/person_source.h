#pragma once

#include <compare>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "engine/vision/change_detection.h"

namespace etude {

/// How the person was cut out of the pictures, by a segmenter or by the truth, and who marks what is left.
struct PersonSource {
  Segmenter segmenter = Segmenter::kHue;
  PersonPieces pieces = PersonPieces::kLargest;
  bool is_truth = false;
  /// Cut out for methods that read silhouettes alone: masks are kept, and nobody marks the pictures.
  bool for_silhouettes = false;
  SeatedSegmenter* program = nullptr;  ///< cuts out in the segmenter's place
  bool has_true_marks = false;      ///< drawn by someone who knows where the joints are, where the picture shows them
  bool has_coloured_marks = false;  ///< nobody marks: the colours of the suit tell limbs apart
  auto operator<=>(const PersonSource&) const = default;
};

/// How the method cuts out the person.
PersonSource PersonSourceOf(const CaptureMethod& method);
/// Each source once: methods that cut out alike see the same marks.
void AddSource(const PersonSource& source, std::vector<PersonSource>& sources);

}  // namespace etude
