#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task.h"

namespace etude {

/// What is asked about a frame: the first of those that match it, all of them, or those that are most like it.
enum class SearchQuestion { kFirst, kWithin, kNearest, kNearest10 };
/// "first", "within", "nearest", "nearest-10".
std::string_view QuestionName(SearchQuestion question);
std::vector<std::string> QuestionNames();
/// Null when there is no such question.
const SearchQuestion* FindQuestion(std::string_view name);

/// How many frames `nearest` and `nearest-10` ask for; needs one of these two.
int FramesAskedFor(SearchQuestion question);

/// One condition of a search scenario.
struct SearchOptions {
  int frames = 10'000;  ///< of the library
  int queries = 200;    ///< of a world
  double threshold = 0.4;
  SearchQuestion question = SearchQuestion::kNearest;  ///< of methods that do not say otherwise, and of those outside
};
constexpr int kMostLibraryFrames = 1'000'000;

/// How frames are found.
enum class SearchWay { kIndex, kBruteForce };

struct SearchMethod {
  std::string name;
  SearchWay way = SearchWay::kIndex;
  SearchQuestion question = SearchQuestion::kNearest;
};

SearchOptions ReadSearchOptions(Fields& condition);
Result<std::vector<SearchMethod>> ReadSearchMethods(std::span<const Node> methods, const SearchOptions& common);

std::vector<KeyInfo> SearchConditionKeys();
std::vector<KeyInfo> SearchMethodKeys();

}  // namespace etude
