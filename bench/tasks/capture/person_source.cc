#include "bench/tasks/capture/person_source.h"

#include <algorithm>

namespace etude {

PersonSource PersonSourceOf(const CaptureMethod& method) {
  const bool for_silhouettes = method.recovery == Recovery::kSilhouettes;
  PersonSource source{.segmenter = method.segmenter,
                      .pieces = for_silhouettes ? PersonPieces::kLarge : method.pieces,
                      .is_truth = false,
                      .for_silhouettes = for_silhouettes,
                      .program = method.program,
                      .has_true_marks = method.oracle.marks,
                      .has_coloured_marks = method.marks == MarkSource::kColours};
  if (method.oracle.segmentation) {
    source.segmenter = Segmenter::kHue;
    source.pieces = PersonPieces::kLargest;
    source.is_truth = true;
  }
  return source;
}

void AddSource(const PersonSource& source, std::vector<PersonSource>& sources) {
  if (std::ranges::find(sources, source) == sources.end()) sources.push_back(source);
}

}  // namespace etude
