#include "bench/training/training_pairs.h"

#include "bench/metrics/matching.h"
#include "engine/transitions/base/alignment.h"

namespace etude {
namespace {

std::vector<Grades> GradesOf(std::span<const TrainingFrame> frames, const Memberships& memberships) {
  std::vector<Grades> grades;
  for (const TrainingFrame& frame : frames) grades.push_back(Fuzzify(frame.features, memberships));
  return grades;
}

}  // namespace

std::vector<LabelledPair> LabelPairs(std::span<const TrainingFrame> a, std::span<const TrainingFrame> b,
                                     const Memberships& memberships) {
  const std::vector<Grades> grades_a = GradesOf(a, memberships), grades_b = GradesOf(b, memberships);
  std::vector<LabelledPair> pairs;
  pairs.reserve(a.size() * b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      pairs.push_back({SquaredGradeGaps(grades_a[i], grades_b[j]), PoseGap(a[i].pose, b[j].pose) < kCloseGap});
    }
  }
  return pairs;
}

std::vector<LabelledPair> LabelPairsAcross(std::span<const std::vector<TrainingFrame>> clips,
                                           const Memberships& memberships) {
  std::vector<LabelledPair> all;
  for (std::size_t i = 0; i < clips.size(); ++i) {
    for (std::size_t j = i + 1; j < clips.size(); ++j) {
      const std::vector<LabelledPair> pairs = LabelPairs(clips[i], clips[j], memberships);
      all.insert(all.end(), pairs.begin(), pairs.end());
    }
  }
  return all;
}

void GradeAnew(std::span<const std::vector<TrainingFrame>> clips, const Memberships& memberships,
               std::span<LabelledPair> pairs) {
  std::vector<std::vector<Grades>> grades;
  for (const std::vector<TrainingFrame>& frames : clips) grades.push_back(GradesOf(frames, memberships));
  auto pair = pairs.begin();
  for (std::size_t i = 0; i < clips.size(); ++i) {
    for (std::size_t j = i + 1; j < clips.size(); ++j) {
      for (const Grades& a : grades[i]) {
        for (const Grades& b : grades[j]) (pair++)->squared_gaps = SquaredGradeGaps(a, b);
      }
    }
  }
}

}  // namespace etude
