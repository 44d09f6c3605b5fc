#include "bench/tasks/search/score.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/digest.h"

namespace etude {
namespace {

std::string FoundDigest(const std::vector<FoundFrames>& found) {
  Digest digest;
  for (const FoundFrames& frames : found) {
    digest.Add(static_cast<std::int64_t>(frames.size()));
    for (const int frame : frames) digest.Add(std::int64_t{frame});
  }
  return digest.Hex();
}

template <typename T>
Series AlongQueries(std::string name, const std::vector<T>& counts) {
  return {std::move(name), "query", {counts.begin(), counts.end()}};
}

std::vector<std::size_t> SizesOf(const std::vector<FoundFrames>& found) {
  std::vector<std::size_t> sizes;
  for (const FoundFrames& frames : found) sizes.push_back(frames.size());
  return sizes;
}

/// "" when all are right.
std::string DescribeMistakes(const std::vector<FoundFrames>& found, const std::vector<FoundFrames>& truth) {
  const auto first = std::mismatch(found.begin(), found.end(), truth.begin());
  if (first.first == found.end()) return "";
  std::ptrdiff_t wrong = 0;
  for (std::size_t query = 0; query < truth.size(); ++query) wrong += found[query] != truth[query];
  return fmt::format("{} of {} queries not answered as by a loop over all frames, the first of them query {}", wrong,
                     truth.size(), first.first - found.begin());
}

}  // namespace

std::vector<std::string> SearchMetrics() {
  return {"search_agreement", "matches_per_query", "distances_per_query", "boxes_per_query"};
}

CellResult ScoreSearch(const SearchLibrary& library, std::span<const Grades> queries, const SearchAnswer& answer,
                       const std::vector<FoundFrames>& truth) {
  CellResult cell;
  cell.digests = {{"library", library.digest}, {"queries", DigestOf(queries)}, {"answers", FoundDigest(answer.found)}};
  cell.MeasureOr("search_agreement", SearchAgreement(answer.found, truth), "there is no query");
  cell.MeasureOr("matches_per_query", MatchesPerQuery(answer.found), "there is no query");
  const char* const untold = "the method does not tell";
  if (answer.distances) {
    cell.MeasureOr("distances_per_query", MeanPerQuery(*answer.distances), "there is no query");
  } else {
    cell.Missing("distances_per_query", untold);
  }
  if (answer.boxes) {
    cell.MeasureOr("boxes_per_query", MeanPerQuery(*answer.boxes), "there is no query");
  } else {
    cell.Missing("boxes_per_query", answer.distances ? "brute force has no boxes" : untold);
  }
  cell.series.push_back(AlongQueries("matches_per_query", SizesOf(answer.found)));
  if (answer.distances) cell.series.push_back(AlongQueries("distances_per_query", *answer.distances));
  cell.reason = DescribeMistakes(answer.found, truth);
  cell.status = cell.reason.empty() ? Status::kOk : Status::kUnsolved;
  return cell;
}

std::optional<double> SearchFailureValue(std::string_view metric) {
  return metric == "search_agreement" ? std::optional(0.0) : std::nullopt;
}

}  // namespace etude
