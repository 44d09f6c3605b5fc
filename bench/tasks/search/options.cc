#include "bench/tasks/search/options.h"

#include <cassert>

#include "bench/tasks/base/fuzzy_key.h"

namespace etude {
namespace {

const NamedValues<SearchQuestion>& Questions() {
  static const NamedValues<SearchQuestion> questions = {{"first", SearchQuestion::kFirst},
                                                        {"within", SearchQuestion::kWithin},
                                                        {"nearest", SearchQuestion::kNearest},
                                                        {"nearest-10", SearchQuestion::kNearest10}};
  return questions;
}

}  // namespace

std::string_view QuestionName(SearchQuestion question) {
  for (const auto& [name, value] : Questions()) {
    if (value == question) return name;
  }
  assert(false && "a question without a name");
  return "";
}

int FramesAskedFor(SearchQuestion question) {
  assert(question == SearchQuestion::kNearest || question == SearchQuestion::kNearest10);
  return question == SearchQuestion::kNearest ? 1 : 10;
}

const FieldTable<SearchOptions>& SearchConditionFields() {
  using Options = SearchOptions;
  using Key = Field<Options>;
  static const FieldTable<Options> table{
      {Key::Number("frames", &Options::frames, {10, kMaxLibraryFrames},
                   "Number of frames searched: the clips, repeated with other tempos and amplitudes."),
       Key::Number("queries", &Options::queries, {1, 10'000},
                   "Number of query frames in a world; none is in the library."),
       Key::Number("threshold", &Options::threshold, {0, 6},
                   "Frames match if their fuzzy distance is smaller; for `first` and `within`."),
       Key::Name("query", &Options::question, Questions(),
                 "What a query returns: the first matching frame, all matching frames, or the one or ten frames of "
                 "smallest distance; for all methods."),
       FuzzyField<Options>()}};
  return table;
}

const FieldTable<SearchMethod>& SearchMethodFields() {
  using Key = Field<SearchMethod>;
  static const FieldTable<SearchMethod> table{
      {Key::Name("search", &SearchMethod::way, {{"index", SearchWay::kIndex}, {"brute-force", SearchWay::kBruteForce}},
                 "Use the exact index, or compare every frame."),
       Key::Name("query", &SearchMethod::question, Questions(), "What is asked for every query frame.")
           .WhenAbsent("(the scenario's)")}};
  return table;
}

}  // namespace etude
