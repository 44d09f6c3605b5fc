#include "bench/tasks/search/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "engine/base/digest.h"

namespace etude {
namespace {

bool IsBefore(const Neighbour& a, const Neighbour& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.frame < b.frame;
}

using Counts = std::vector<std::int64_t>;

FoundFrames FramesOf(std::span<const Neighbour> neighbours) {
  FoundFrames frames;
  for (const Neighbour& neighbour : neighbours) frames.push_back(neighbour.frame);
  return frames;
}

FoundFrames AskIndex(const SearchProblem& problem, const Grades& query, SearchQuestion question, SearchWork& work) {
  const GradeIndex& index = problem.library.index;
  switch (question) {
    case SearchQuestion::kFirst: {
      const auto first = index.First(query, problem.threshold, &work);
      return first ? FoundFrames{first->frame} : FoundFrames{};
    }
    case SearchQuestion::kWithin:
      return FramesOf(index.Within(query, problem.threshold, &work));
    case SearchQuestion::kNearest:
    case SearchQuestion::kNearest10:
      break;
  }
  return FramesOf(index.Nearest(query, FramesAskedFor(question), &work));
}

/// Returns the distance to a frame if it is below `limit`.
std::optional<double> DistanceBelow(const SearchProblem& problem, const Grades& query, const Grades& frame,
                                    double limit) {
  if (!IsCloser(query, frame, problem.weights, limit)) return std::nullopt;
  return ComputeDistance(query, frame, problem.weights).value;
}

FoundFrames ScanForMatches(const SearchProblem& problem, const Grades& query, bool only_first, std::int64_t& seen) {
  FoundFrames found;
  const std::vector<Grades>& frames = problem.library.frames;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    ++seen;
    if (!IsCloser(query, frames[f], problem.weights, problem.threshold)) continue;
    found.push_back(static_cast<int>(f));
    if (only_first) break;
  }
  return found;
}

FoundFrames ScanForNearest(const SearchProblem& problem, const Grades& query, std::size_t wanted, std::int64_t& seen) {
  std::vector<Neighbour> best;  // the best so far, nearest first
  double limit = std::numeric_limits<double>::max();
  const std::vector<Grades>& frames = problem.library.frames;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    ++seen;
    const auto distance = DistanceBelow(problem, query, frames[f], limit);
    if (!distance) continue;  // if two distances are equal, the earlier frame stays
    const Neighbour neighbour{static_cast<int>(f), *distance};
    best.insert(std::upper_bound(best.begin(), best.end(), neighbour, IsBefore), neighbour);
    if (best.size() > wanted) best.pop_back();
    if (best.size() == wanted) limit = best.back().distance;
  }
  return FramesOf(best);
}

FoundFrames Scan(const SearchProblem& problem, const Grades& query, SearchQuestion question, std::int64_t& seen) {
  switch (question) {
    case SearchQuestion::kFirst:
      return ScanForMatches(problem, query, true, seen);
    case SearchQuestion::kWithin:
      return ScanForMatches(problem, query, false, seen);
    case SearchQuestion::kNearest:
    case SearchQuestion::kNearest10:
      break;
  }
  return ScanForNearest(problem, query, static_cast<std::size_t>(FramesAskedFor(question)), seen);
}

/// Returns the answer, given all frames with their distances.
FoundFrames Choose(const std::vector<Neighbour>& all, SearchQuestion question, double threshold) {
  std::vector<Neighbour> chosen;
  if (question == SearchQuestion::kNearest || question == SearchQuestion::kNearest10) {
    chosen.resize(std::min(static_cast<std::size_t>(FramesAskedFor(question)), all.size()));
    std::partial_sort_copy(all.begin(), all.end(), chosen.begin(), chosen.end(), IsBefore);
    return FramesOf(chosen);
  }
  std::ranges::copy_if(all, std::back_inserter(chosen), [&](const Neighbour& n) { return n.distance < threshold; });
  if (question == SearchQuestion::kFirst && !chosen.empty()) chosen.resize(1);
  return FramesOf(chosen);
}

}  // namespace

SearchAnswer FindByIndex(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question) {
  SearchAnswer answer{.question = question, .found = {}, .distances = Counts(), .boxes = Counts()};
  for (const Grades& query : queries) {
    SearchWork work;
    answer.found.push_back(AskIndex(problem, query, question, work));
    answer.distances->push_back(work.distances);
    answer.boxes->push_back(work.boxes);
  }
  return answer;
}

SearchAnswer FindByBruteForce(const SearchProblem& problem, std::span<const Grades> queries, SearchQuestion question) {
  SearchAnswer answer{.question = question, .found = {}, .distances = Counts(), .boxes = {}};
  for (const Grades& query : queries) {
    std::int64_t seen = 0;
    answer.found.push_back(Scan(problem, query, question, seen));
    answer.distances->push_back(seen);
  }
  return answer;
}

std::map<SearchQuestion, std::vector<FoundFrames>> FindPlainly(const SearchProblem& problem,
                                                               std::span<const Grades> queries,
                                                               const std::set<SearchQuestion>& questions) {
  std::map<SearchQuestion, std::vector<FoundFrames>> answers;
  std::vector<Neighbour> all;
  for (const Grades& query : queries) {
    all.clear();
    for (const Grades& frame : problem.library.frames) {
      all.push_back({static_cast<int>(all.size()), ComputeDistance(query, frame, problem.weights).value});
    }
    for (const SearchQuestion question : questions)
      answers[question].push_back(Choose(all, question, problem.threshold));
  }
  return answers;
}

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

/// Returns a sentence with the number of wrong answers and the first of them; "" if all are right.
std::string DescribeMistakes(const std::vector<FoundFrames>& found, const std::vector<FoundFrames>& truth) {
  const auto first = std::mismatch(found.begin(), found.end(), truth.begin());
  if (first.first == found.end()) return "";
  std::ptrdiff_t wrong = 0;
  for (std::size_t query = 0; query < truth.size(); ++query) wrong += found[query] != truth[query];
  return fmt::format("{} of {} queries have another answer than a loop over all frames, the first of them query {}",
                     wrong, truth.size(), first.first - found.begin());
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
  const char* const untold = "the method does not report it";
  if (answer.distances) {
    cell.MeasureOr("distances_per_query", MeanPerQuery(*answer.distances), "there is no query");
  } else {
    cell.Missing("distances_per_query", untold);
  }
  if (answer.boxes) {
    cell.MeasureOr("boxes_per_query", MeanPerQuery(*answer.boxes), "there is no query");
  } else {
    cell.Missing("boxes_per_query", answer.distances ? "brute force uses no boxes" : untold);
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
