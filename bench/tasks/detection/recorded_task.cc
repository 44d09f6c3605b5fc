#include "bench/tasks/detection/recorded_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/tasks/detection/exchange.h"
#include "bench/tasks/detection/recorded.h"
#include "bench/tasks/detection/session_world.h"
#include "engine/teaching/moves_file.h"

namespace etude {
namespace {

using Taught = std::optional<std::vector<TaughtMove>>;

class RecordedTask final : public Task {
 public:
  RecordedTask(const DetectionOptions& options, std::vector<DetectionMethod> methods, const LabelledStreams& set,
               Taught taught)
      : options_(options), methods_(std::move(methods)), set_(set), taught_(std::move(taught)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    const auto person = static_cast<std::size_t>(key.trial);
    if (person >= set_.people.size()) {
      return std::make_unique<SkippedWorld>(fmt::format("{} people were recorded", set_.people.size()));
    }
    const Result<Fold>& fold = FoldOf(person);
    if (!fold) return std::make_unique<SkippedWorld>(fold.error().message);
    return std::make_unique<SessionWorld>(
        fold->methods,
        [this, key, scenario = std::string(key.scenario)]() -> const std::vector<MethodDecision>& {
          return DecisionsFor({key.suite_seed, scenario, key.trial});
        },
        fold->repertoire, MakeRecordedWorld(set_, person, options_, key), keeps_motion);
  }

  std::vector<std::string> ClipsOf(const WorldKey& key) const override {
    const auto person = static_cast<std::size_t>(key.trial);
    if (person >= set_.people.size()) return {};
    return {set_.people[person].name};
  }

  Result<Payload> Setting() const override { return NamesPayload(set_.moves); }

  std::optional<double> ValueOfFailure(std::string_view metric) const override {
    return DetectionFailureValue(metric, std::ranges::any_of(set_.parts, &LabelledPart::IsRight));
  }

 private:
  const std::string& NameOf(std::size_t person) const { return set_.people[person].name; }

  /// What is known when this person is judged.
  const Result<Fold>& FoldOf(std::size_t person) const {
    const std::size_t index = taught_ ? 0 : person;  // what was taught beforehand is the same for all
    const auto known = folds_.find(index);
    if (known != folds_.end()) return known->second;
    return folds_.emplace(index, MakeFold(set_, taught_, {NameOf(person)}, methods_)).first->second;
  }

  /// Thresholds are set on other people, each seen by recognisers that neither they nor the person judged have taught.
  const std::vector<MethodDecision>& DecisionsFor(const WorldKey& key) const {
    const auto known = decisions_.find(key.trial);
    if (known != decisions_.end()) return known->second;
    const auto judged = static_cast<std::size_t>(key.trial);
    const std::size_t people = set_.people.size();
    TrialsOfMethods trials(methods_.size());
    if (options_.operating_point) {
      const auto asked = static_cast<std::size_t>(options_.operating_point->sessions);
      for (std::size_t i = 1; i <= std::min(asked, people - 1); ++i)
        AddOther((judged + i) % people, judged, key, trials);
    }
    return decisions_.emplace(key.trial, DecideBy(FoldOf(judged)->methods, trials, options_.operating_point))
        .first->second;
  }

  void AddOther(std::size_t other, std::size_t judged, const WorldKey& key, TrialsOfMethods& trials) const {
    const WorldKey own{key.suite_seed, key.scenario, static_cast<int>(other)};
    const auto world = std::make_shared<const DetectionWorld>(MakeRecordedWorld(set_, other, options_, own));
    if (taught_) {
      AddTrials(world, FoldOf(0)->methods, FoldOf(0)->repertoire, trials);
    } else if (const auto fold = MakeFold(set_, {}, {NameOf(other), NameOf(judged)}, methods_)) {
      AddTrials(world, fold->methods, fold->repertoire, trials);
    }
  }

  const DetectionOptions options_;
  const std::vector<DetectionMethod> methods_;
  const LabelledStreams& set_;
  const Taught taught_;
  // Memories of what depends on keys alone; a task meets one scenario and one seed.
  mutable std::map<std::size_t, Result<Fold>> folds_;
  mutable std::map<int, std::vector<MethodDecision>> decisions_;
};

/// Keys that nobody reads where people were recorded.
Result<void> RefuseKeys(const Node& condition, std::span<const std::string_view> keys, std::string_view why) {
  for (const std::string_view key : keys) {
    const Node* named = condition.Find(key);
    if (named != nullptr) return Fail(named->place, "'{}' has no use here: {}", key, why);
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<Task>> MakeRecordedTask(TaskInput& input, const DetectionOptions& options,
                                               std::vector<DetectionMethod> methods) {
  const LabelledStreams& set = *input.recordings;
  const Node& condition = input.condition.node();
  RETURN_IF_ERROR(RefuseKeys(condition, PeopleKeys(), "people were recorded, nobody is simulated"));
  const bool are_sensed = std::ranges::any_of(set.streams, [](const NamedStream& s) { return s.motion.has_value(); });
  if (!are_sensed) RETURN_IF_ERROR(RefuseKeys(condition, SensingKeys(), "a recording is what its sensor saw"));
  if (options.has_cameras) {
    return Fail(condition.Find("sensor")->place, "cameras film simulated people; allowed here: v1, v2, a sensor file");
  }
  for (const DetectionMethod& method : methods) {
    if (!method.sees_truth || are_sensed) continue;
    return Fail(condition.place, "method {}: 'oracle: [stream]' has no use here: what was danced nobody knows",
                method.name);
  }
  Taught taught;
  if (!options.moves.empty()) {
    ASSIGN_OR_RETURN(taught, ReadMoves(input.texts.at(kMovesKey), options.moves));
  }
  RETURN_IF_ERROR(CheckRecordings(set, taught.has_value()));
  const std::size_t needed = taught ? 2 : 3;  // one judged, one on whom thresholds are set, one who teaches both
  if (options.operating_point && set.people.size() < needed) {
    return Fail(condition.Find("operating_point")->place,
                "thresholds are set on people who neither teach nor are judged; recorded: {}, needed: {}",
                set.people.size(), needed);
  }
  // What no person's recogniser can do without is told before anything is run.
  if (auto all = MakeFold(set, taught, {}, methods); !all) return tl::unexpected(all.error());
  return std::make_unique<RecordedTask>(options, std::move(methods), set, std::move(taught));
}

}  // namespace etude
