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
                   "How many frames are searched: the clips, performed again and again with other tempo and "
                   "amplitude."),
       Key::Number("queries", &Options::queries, {1, 10'000},
                   "How many frames are asked about in a world; none is in the library."),
       Key::Number("threshold", &Options::threshold, {0, 6},
                   "Frames of a smaller fuzzy distance match: what `first` and `within` ask for."),
       Key::Name("query", &Options::question, Questions(),
                 "The first matching frame, all of them, or the one or ten of smallest distance; for all methods."),
       FuzzyField<Options>()}};
  return table;
}

const FieldTable<SearchMethod>& SearchMethodFields() {
  using Key = Field<SearchMethod>;
  static const FieldTable<SearchMethod> table{
      {Key::Name("search", &SearchMethod::way, {{"index", SearchWay::kIndex}, {"brute-force", SearchWay::kBruteForce}},
                 "Through the exact index, or by looking at every frame."),
       Key::Name("query", &SearchMethod::question, Questions(), "What is asked about every frame.")
           .WhenAbsent("(the scenario's)")}};
  return table;
}

}  // namespace etude
