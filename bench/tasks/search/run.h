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
  std::optional<std::vector<std::int64_t>> distances;  ///< computed; nothing where the method does not tell
  std::optional<std::vector<std::int64_t>> boxes;      ///< looked at; nothing where there are none
};

/// The data that all queries of a world share.
struct SearchProblem {
  const SearchLibrary& library;
  FeatureWeights weights;
  double threshold = 0;
};

/// Through the index.
SearchAnswer FindByIndex(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question);

/// Looks at every frame, without looking longer than it must: `first` ends at the first match, and the sum of a
/// distance ends where it is too large already.
SearchAnswer FindByBruteForce(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question);

/// The right answers to each of the questions: every distance in full, then sorted.
std::map<SearchQuestion, std::vector<FoundFrames>> FindPlainly(const SearchProblem& problem,
                                                               std::span<const Grades> queries,
                                                               const std::set<SearchQuestion>& questions);

/// Measures an answer, whoever gave it: `ok` when every query is answered right, else `unsolved` with how many are not
/// and the first of them. Series along the queries: how many frames were found and, where it is told, looked at.
CellResult ScoreSearch(const SearchLibrary& library, std::span<const Grades> queries, const SearchAnswer& answer,
                       const std::vector<FoundFrames>& truth);

/// The ids of all metrics that a cell reports, a value or a reason for each.
std::vector<std::string> SearchMetrics();

/// The value of a metric for a cell without an answer: no right answer.
std::optional<double> SearchFailureValue(std::string_view metric);

}  // namespace etude
