#include "engine/transitions/choices/fuzzy_gate.h"

#include <utility>

namespace etude {
namespace {

std::vector<Grades> GradesOf(const TaggedClip& clip, std::span<const int> frames) {
  std::vector<Grades> grades;
  for (int frame : frames) grades.push_back(clip.grades[frame]);
  return grades;
}

}  // namespace

FuzzyGate::FuzzyGate(const TaggedClip& playing, const TaggedClip& next, std::vector<int> entering,
                     const MatchRules& rules)
    : playing_(playing),
      next_(next),
      entering_(std::move(entering)),
      rules_(rules),
      rows_(GradesOf(next, entering_), rules.weights),
      distances_(entering_.size()) {}

std::span<const FuzzyGate::Compared> FuzzyGate::Compare(int from) {
  rows_.Compute(playing_.grades[from], distances_);
  compared_.clear();
  for (std::size_t i = 0; i < entering_.size(); ++i) {
    if (rules_.within_class && playing_.tags[from] != next_.tags[entering_[i]]) continue;
    compared_.push_back({entering_[i], distances_[i], distances_[i] < rules_.threshold});
  }
  return compared_;
}

}  // namespace etude
