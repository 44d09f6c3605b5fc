#include <map>
#include <set>

#include "bench/tasks/base/fuzzy_key.h"
#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/search/exchange.h"
#include "bench/tasks/search/options.h"
#include "bench/tasks/search/run.h"
#include "bench/tasks/search/world.h"

namespace etude {
namespace {

/// The data that all worlds of one condition share.
struct SearchStudy {
  SearchOptions options;
  std::vector<SearchMethod> methods;
  FuzzySystem fuzzy;
};

SearchProblem ProblemOf(const SearchStudy& study, const SearchLibrary& library) {
  return {library, study.fuzzy.weights, study.options.threshold};
}

class SearchWorld final : public TaskWorld {
 public:
  SearchWorld(const SearchStudy& study, const SearchLibrary& library, const WorldKey& key)
      : study_(study),
        problem_(ProblemOf(study, library)),
        queries_(DrawQueries(library, study.options.queries, key)) {}

  void PrepareShared() override {
    std::set<SearchQuestion> questions;
    for (const SearchMethod& method : study_.methods) questions.insert(method.question);
    truth_ = FindPlainly(problem_, queries_, questions);
  }

  CellResult Run(std::size_t index) override {
    const SearchMethod& method = study_.methods[index];
    const auto find = method.way == SearchWay::kIndex ? FindByIndex : FindByBruteForce;
    return Score(find(problem_, queries_, method.question));
  }

  Result<Payload> MakeProblem() override { return DescribeQueries(queries_); }

  Result<Payload> MakeTruth() override { return DescribeFound(TruthOf(study_.options.question)); }

  Result<CellResult> Judge(const Json& json) override {
    ASSIGN_OR_RETURN(const auto answer, ReadSearchAnswer(json, problem_, queries_.size(), study_.options.question));
    return Score(answer);
  }

 private:
  const std::vector<FoundFrames>& TruthOf(SearchQuestion question) {
    if (!truth_.contains(question)) truth_.merge(FindPlainly(problem_, queries_, {question}));
    return truth_.at(question);
  }

  CellResult Score(const SearchAnswer& answer) {
    return ScoreSearch(problem_.library, queries_, answer, TruthOf(answer.question));
  }

  const SearchStudy& study_;
  const SearchProblem problem_;
  const std::vector<Grades> queries_;
  std::map<SearchQuestion, std::vector<FoundFrames>> truth_;
};

class SearchTask final : public Task {
 public:
  SearchTask(SearchStudy study, ClipLibrary clips)
      : study_(std::move(study)), library_(std::move(clips), study_.fuzzy, study_.options.frames) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool /*keeps_motion*/) const override {
    return std::make_unique<SearchWorld>(study_, library_.Get(), key);
  }

  std::vector<std::string> ClipsOf(const WorldKey&) const override { return {}; }

  Result<Payload> Setting() const override {
    return LibraryPayload(ProblemOf(study_, library_.Get()), study_.options.question);
  }

  std::optional<double> ValueOfFailure(std::string_view metric) const override { return SearchFailureValue(metric); }

 private:
  const SearchStudy study_;
  mutable SharedLibrary library_;
};

/// Refuses clips that cannot make a library.
Result<void> CheckClips(const ClipLibrary& clips, const Place& place) {
  if (clips.clips.empty()) return Fail(place, "a search scenario needs clips, e.g. clips: ['builtin:*']");
  for (const LibraryClip& clip : clips.clips) {
    if (clip.motion.poses.size() < 2) return Fail(place, "clip {} has one frame; at least 2 are needed", clip.name);
  }
  return {};
}

Result<std::unique_ptr<Task>> MakeSearchTask(TaskInput& input) {
  ASSIGN_OR_RETURN(auto fuzzy, FuzzySystemOf(input));
  SearchStudy study{.options = {}, .methods = {}, .fuzzy = std::move(fuzzy)};
  SearchConditionFields().Read(input.condition, study.options);
  SearchMethod start;
  start.question = study.options.question;
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "search", SearchMethodFields(), start));
  RETURN_IF_ERROR(CheckClips(input.clips, input.condition.node().place));
  study.methods = std::move(methods);
  return std::make_unique<SearchTask>(std::move(study), input.clips);
}

}  // namespace

TaskKind MakeSearchTaskKind() {
  return {.name = "search",
          .question = "How does finding matching frames grow with the library?",
          .default_metrics = {"distances_per_query", "search_agreement", "boxes_per_query", "matches_per_query"},
          .success = "search_agreement",
          .metrics = SearchMetrics(),
          .make = MakeSearchTask,
          .condition_keys = SearchConditionFields().Describe(),
          .method_keys = SearchMethodFields().Describe(),
          .units = {SamplingUnit::kLibrary, SamplingUnit::kWorld}};
}

}  // namespace etude
