#pragma once

#include <string>
#include <string_view>

#include "bench/keys/field_table.h"

namespace etude {

/// What a query asks for: the first frame that matches it, all that match, or the nearest one or ten.
enum class SearchQuestion { kFirst, kWithin, kNearest, kNearest10 };
/// "first", "within", "nearest", "nearest-10".
std::string_view QuestionName(SearchQuestion question);

/// Returns the number of frames that `nearest` or `nearest-10` asks for; the question must be one of these two.
int FramesAskedFor(SearchQuestion question);

/// One condition of a search scenario.
struct SearchOptions {
  int frames = 10'000;  ///< in the library
  int queries = 200;    ///< per world
  double threshold = 0.4;
  SearchQuestion question = SearchQuestion::kNearest;  ///< for methods that set none, and for outside methods
};
constexpr int kMaxLibraryFrames = 1'000'000;

/// How frames are found.
enum class SearchWay { kIndex, kBruteForce };

struct SearchMethod {
  std::string name;
  SearchWay way = SearchWay::kIndex;
  SearchQuestion question = SearchQuestion::kNearest;
};

const FieldTable<SearchOptions>& SearchConditionFields();
const FieldTable<SearchMethod>& SearchMethodFields();

}  // namespace etude
