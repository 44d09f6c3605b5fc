#pragma once

#include <string>
#include <string_view>

#include "bench/keys/field_table.h"

namespace etude {

/// A question about a frame: the first of those that match it, all of them, or those that are most like it.
enum class SearchQuestion { kFirst, kWithin, kNearest, kNearest10 };
/// "first", "within", "nearest", "nearest-10".
std::string_view QuestionName(SearchQuestion question);

/// The number of frames that `nearest` and `nearest-10` ask for; needs one of these two.
int FramesAskedFor(SearchQuestion question);

/// One condition of a search scenario.
struct SearchOptions {
  int frames = 10'000;  ///< of the library
  int queries = 200;    ///< of a world
  double threshold = 0.4;
  SearchQuestion question = SearchQuestion::kNearest;  ///< of methods that do not say otherwise, and of those outside
};
constexpr int kMaxLibraryFrames = 1'000'000;

/// The way in which frames are found.
enum class SearchWay { kIndex, kBruteForce };

struct SearchMethod {
  std::string name;
  SearchWay way = SearchWay::kIndex;
  SearchQuestion question = SearchQuestion::kNearest;
};

const FieldTable<SearchOptions>& SearchConditionFields();
const FieldTable<SearchMethod>& SearchMethodFields();

}  // namespace etude
