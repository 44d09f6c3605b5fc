#include "bench/tasks/search/search_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "bench/tasks/base/fuzzy_key.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr std::array<std::pair<std::string_view, SearchQuestion>, 4> kQuestions = {
    {{"first", SearchQuestion::kFirst},
     {"within", SearchQuestion::kWithin},
     {"nearest", SearchQuestion::kNearest},
     {"nearest-10", SearchQuestion::kNearest10}}};

SearchQuestion ReadQuestion(Fields& fields, SearchQuestion fallback) {
  const SearchQuestion* asked = FindQuestion(fields.Choice("query", QuestionNames(), QuestionName(fallback)));
  return asked != nullptr ? *asked : fallback;  // a complaint is kept in `fields`
}

Result<SearchMethod> ReadMethod(const Node& node, const SearchOptions& common) {
  Fields fields(node, "a method of task search");
  SearchMethod method;
  method.name = fields.RequiredText("name");
  if (fields.Choice("search", {"index", "brute-force"}, "index") == "brute-force") method.way = SearchWay::kBruteForce;
  method.question = ReadQuestion(fields, common.question);
  RETURN_IF_ERROR(fields.Finish());
  return method;
}

}  // namespace

std::string_view QuestionName(SearchQuestion question) {
  for (const auto& [name, value] : kQuestions) {
    if (value == question) return name;
  }
  assert(false && "a question without a name");
  return "";
}

std::vector<std::string> QuestionNames() {
  std::vector<std::string> names;
  for (const auto& entry : kQuestions) names.emplace_back(entry.first);
  return names;
}

const SearchQuestion* FindQuestion(std::string_view name) {
  const auto* entry =
      std::find_if(kQuestions.begin(), kQuestions.end(), [&](const auto& known) { return known.first == name; });
  return entry == kQuestions.end() ? nullptr : &entry->second;
}

int FramesAskedFor(SearchQuestion question) {
  assert(question == SearchQuestion::kNearest || question == SearchQuestion::kNearest10);
  return question == SearchQuestion::kNearest ? 1 : 10;
}

SearchOptions ReadSearchOptions(Fields& condition) {
  SearchOptions options;
  options.frames = condition.Integer("frames", options.frames, {10, kMostLibraryFrames});
  options.queries = condition.Integer("queries", options.queries, {1, 10'000});
  options.threshold = condition.Number("threshold", options.threshold, {0, 6});
  options.question = ReadQuestion(condition, options.question);
  return options;
}

Result<std::vector<SearchMethod>> ReadSearchMethods(std::span<const Node> methods, const SearchOptions& common) {
  std::vector<SearchMethod> read;
  for (const Node& node : methods) {
    ASSIGN_OR_RETURN(auto method, ReadMethod(node, common));
    read.push_back(std::move(method));
  }
  return read;
}

std::vector<KeyInfo> SearchConditionKeys() {
  return {{"frames", fmt::format("10…{}", kMostLibraryFrames), "10000",
           "How many frames are searched: the clips, performed again and again with other tempo and amplitude."},
          {"queries", "1…10000", "200", "How many frames are asked about in a world; none is in the library."},
          {"threshold", "0…6", "0.4", "Frames of a smaller fuzzy distance match: what `first` and `within` ask for."},
          {"query", Join(QuestionNames()), "nearest",
           "The first matching frame, all of them, or the one or ten of smallest distance; for all methods."},
          FuzzyKey()};
}

std::vector<KeyInfo> SearchMethodKeys() {
  return {{"search", "index, brute-force", "index", "Through the exact index, or by looking at every frame."},
          {"query", Join(QuestionNames()), "(the scenario's)", "What is asked about every frame."}};
}

}  // namespace etude
