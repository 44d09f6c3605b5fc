#include "bench/tasks/search/exchange.h"

#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/tasks/base/answer_fields.h"

namespace etude {
namespace {

constexpr const char* kFile = "library.f64";

std::string BytesOf(const std::vector<Grades>& frames) {
  static_assert(std::endian::native == std::endian::little, "the file is little-endian");
  std::string bytes(frames.size() * sizeof(Grades), '\0');
  std::memcpy(bytes.data(), frames.data(), bytes.size());
  return bytes;
}

Json DescribeTerms(const FeatureWeights& weights) {
  Json terms = Json::array();
  for (const Term& term : AllTerms()) {
    terms.push_back({{"feature", FeatureName(term.feature)},
                     {"term", term.name},
                     {"weight", weights[static_cast<std::size_t>(term.feature)]}});
  }
  return terms;
}

Result<FoundFrames> ReadFrames(const Json& list, const std::string& path, std::size_t frames) {
  if (!list.is_array()) return Fail({}, "{}: {} is not a list", path, ShowJson(list));
  if (list.size() > frames) return Fail({}, "{}: {} frames; the library has {}", path, list.size(), frames);
  ASSIGN_OR_RETURN(auto numbers, ReadNumbers(list, path, list.size(), {0, static_cast<double>(frames) - 1}));
  FoundFrames found;
  std::set<int> seen;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const int frame = static_cast<int>(numbers[i]);
    if (frame != numbers[i]) return Fail({}, "{}[{}]: {} is not a whole number", path, i, numbers[i]);
    if (!seen.insert(frame).second) return Fail({}, "{}[{}]: frame {} appears twice", path, i, frame);
    found.push_back(frame);
  }
  return found;
}

}  // namespace

Payload LibraryPayload(const SearchProblem& problem, SearchQuestion question) {
  Json json{{"frames", problem.library.frames.size()},
            {"terms", DescribeTerms(problem.weights)},
            {"query", QuestionName(question)},
            {"threshold", problem.threshold},
            {"file", kFile}};
  return PayloadOf(std::move(json), {{kFile, BytesOf(problem.library.frames)}});
}

Payload DescribeQueries(std::span<const Grades> queries) {
  Json list = Json::array();
  for (const Grades& query : queries) list.push_back(query);
  return PayloadOf({{"queries", std::move(list)}});
}

Payload DescribeFound(const std::vector<FoundFrames>& found) { return PayloadOf({{"found", found}}); }

Result<SearchAnswer> ReadSearchAnswer(const Json& json, const SearchProblem& problem, std::size_t queries,
                                      SearchQuestion question) {
  AnswerFields fields(json);
  const Json& lists = fields.List("found", queries, queries);
  RETURN_IF_ERROR(fields.Finish());
  SearchAnswer answer{.question = question, .found = {}, .distances = {}, .boxes = {}};
  for (std::size_t i = 0; i < lists.size(); ++i) {
    ASSIGN_OR_RETURN(auto found, ReadFrames(lists[i], fields.PathOf("found", i), problem.library.frames.size()));
    answer.found.push_back(std::move(found));
  }
  return answer;
}

}  // namespace etude
