#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/metrics/matching.h"
#include "bench/tasks/base/task.h"
#include "bench/tasks/search/options.h"
#include "bench/tasks/search/world.h"

namespace etude {

/// The frames that a method found, one entry per query.
struct SearchAnswer {
  SearchQuestion question = SearchQuestion::kNearest;
  std::vector<FoundFrames> found;
  /// Number of distances computed; nullopt if the method does not report it.
  std::optional<std::vector<std::int64_t>> distances;
  std::optional<std::vector<std::int64_t>> boxes;  ///< number of boxes examined; nullopt without an index
};

/// The data that all queries of a world share.
struct SearchProblem {
  const SearchLibrary& library;
  FeatureWeights weights;
  double threshold = 0;
};

/// Finds the frames by the index.
SearchAnswer FindByIndex(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question);

/// Examines every frame, but stops early: `first` stops at the first match, and the sum of a distance stops when it is
/// too large.
SearchAnswer FindByBruteForce(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question);

/// Returns the right answers to each question: computes every distance in full, and sorts.
std::map<SearchQuestion, std::vector<FoundFrames>> FindPlainly(const SearchProblem& problem,
                                                               std::span<const Grades> queries,
                                                               const std::set<SearchQuestion>& questions);

/// Measures an answer. The cell is `ok` if every query is answered right, else `unsolved`, with the number of wrong
/// answers and the first of them. Its series have one value per query: how many frames were found and, if known,
/// examined.
CellResult ScoreSearch(const SearchLibrary& library, std::span<const Grades> queries, const SearchAnswer& answer,
                       const std::vector<FoundFrames>& truth);

/// Returns the ids of all metrics that a cell reports, each by a value or a reason.
std::vector<std::string> SearchMetrics();

/// Returns the value of a metric for a cell without an answer: no query is answered right.
std::optional<double> SearchFailureValue(std::string_view metric);

}  // namespace etude
