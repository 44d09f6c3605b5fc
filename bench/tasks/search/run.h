#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "bench/metrics/matching.h"
#include "bench/tasks/search/options.h"
#include "bench/tasks/search/world.h"

namespace etude {

/// What a method found, one entry per query in all that there is.
struct SearchAnswer {
  SearchQuestion question = SearchQuestion::kNearest;
  std::vector<FoundFrames> found;
  std::optional<std::vector<std::int64_t>> distances;  ///< computed; nothing where the method does not tell
  std::optional<std::vector<std::int64_t>> boxes;      ///< looked at; nothing where there are none
};

/// What all queries of a world have in common.
struct SearchProblem {
  const SearchLibrary& library;
  FeatureWeights weights;
  double threshold = 0;
};

/// Through the index.
SearchAnswer FindByIndex(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question);

/// By looking at every frame, without looking longer than it must: `first` ends at the first match, and the sum of a
/// distance ends where it is too large already.
SearchAnswer FindByBruteForce(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question);

/// The right answers to each of the questions: every distance in full, then sorted.
std::map<SearchQuestion, std::vector<FoundFrames>> FindPlainly(const SearchProblem& problem,
                                                               std::span<const Grades> queries,
                                                               const std::set<SearchQuestion>& questions);

}  // namespace etude
