#include "bench/tasks/detection/recorded_task.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "bench/tasks/detection/exchange.h"
#include "bench/tasks/detection/recorded_faults.h"
#include "bench/tasks/detection/session_world.h"
#include "engine/teaching/moves_file.h"
#include "engine/teaching/teach_moves.h"

namespace etude {
namespace {

constexpr double kGrace = 0.5;  // seconds that a window lasts after its performance, as for a simulated performance

/// Appends recordings, with their labels, to a world.
class RecordingAppender {
 public:
  explicit RecordingAppender(DetectionWorld& world) : world_(world) {}

  void Add(const BodyMotion& motion, const SkeletonStream& stream, std::span<const LabelledPart> parts) {
    const auto begin = static_cast<int>(world_.stream.frames.size());
    if (begin > 0) world_.starts.push_back(begin);
    std::vector<BodyPose>& poses = world_.motion.poses;
    poses.insert(poses.end(), motion.poses.begin(), motion.poses.end());
    std::vector<SensedFrame>& frames = world_.stream.frames;
    frames.insert(frames.end(), stream.frames.begin(), stream.frames.end());
    const auto end = static_cast<int>(frames.size());
    const std::size_t first = world_.events.size();
    for (const LabelledPart& part : parts) {
      if (part.is_action_point) {
        world_.points.push_back({part.move, begin + part.begin});
      } else {
        world_.events.push_back(EventOf(part, begin));
      }
    }
    // A window ends half a second after its performance, or at the beginning of the next performance if that is
    // earlier.
    for (std::size_t i = first; i < world_.events.size(); ++i) {
      const int next = i + 1 < world_.events.size() ? world_.events[i + 1].window.begin : end;
      FrameInterval& window = world_.events[i].window;
      window.end = std::min(window.end + static_cast<int>(kGrace * world_.stream.rate_hz), next);
    }
  }

 private:
  DetectionEvent EventOf(const LabelledPart& part, int begin) const {
    const double rate = world_.stream.rate_hz;
    DetectionEvent event;
    event.move = part.move;
    event.labelled_fault = part.fault;
    if (part.IsRight()) event.danced = part.move;
    event.performed = event.window = {begin + part.begin, begin + part.end};
    event.start_s = event.performed.begin / rate;
    event.end_s = event.performed.end / rate;
    event.truth = part.IsRight() ? Truth::kRight : Truth::kWrong;
    if (part.IsRight()) event.first_right_s = (event.performed.end - 1) / rate;
    return event;
  }

  DetectionWorld& world_;
};

/// Returns another move, which then counts as requested while the person performed `move`. The other moves are taken
/// in turn: `turn` = 0 gives the move after `move` in the list, 1 the one after that, and so on, cyclically and
/// without `move`. Returns `move` itself if there is no other.
const std::string& OtherMove(const std::vector<std::string>& moves, const std::string& move, std::size_t turn) {
  const auto at = static_cast<std::size_t>(std::ranges::find(moves, move) - moves.begin());
  const std::size_t others = std::max<std::size_t>(moves.size() - 1, 1);
  return moves[(at + 1 + turn % others) % moves.size()];
}

std::span<const LabelledPart> PartsOf(const LabelledStreams& set, std::size_t stream) {
  return {std::ranges::lower_bound(set.parts, stream, {}, &LabelledPart::stream),
          std::ranges::upper_bound(set.parts, stream, {}, &LabelledPart::stream)};
}

}  // namespace

DetectionWorld MakeRecordedWorld(const LabelledStreams& set, std::size_t person, const DetectionOptions& options,
                                 const WorldKey& key) {
  DetectionWorld world{.motion = {}, .events = {}, .stream = {}, .person = set.people[person].name};
  RecordingAppender appender(world);
  const auto add = [&](const NamedStream& recording, std::size_t s, std::string_view fault) {
    if (!recording.motion) return appender.Add(MotionOf(recording.stream), recording.stream, PartsOf(set, s));
    const std::string scenario = fmt::format("{}/{}{}", key.scenario, recording.name, fault);
    appender.Add(*recording.motion, Sense(*recording.motion, options, {key.suite_seed, scenario, key.trial}),
               PartsOf(set, s));
  };
  std::size_t turn = 0;
  // Append each recording, and then one faulty copy of it for each fault.
  for (const std::size_t s : set.people[person].streams) {
    add(set.streams[s], s, "");
    if (std::ranges::none_of(PartsOf(set, s), &LabelledPart::IsRight)) continue;
    for (const Fault fault : options.session.faults) {
      const NamedStream faulty = WithFault(set.streams[s], fault);
      auto event = static_cast<std::ptrdiff_t>(world.events.size());
      add(faulty, s, fmt::format("/{}", FaultName(fault)));
      for (const LabelledPart& part : PartsOf(set, s)) {
        DetectionEvent& changed = world.events[static_cast<std::size_t>(event++)];
        changed.first_right_s.reset();
        changed.truth = part.IsRight() ? TruthOfFault(set.streams[s], faulty, part, fault) : Truth::kGrey;
        changed.labelled_fault = changed.truth == Truth::kWrong ? FaultName(fault) : "";
        if (fault == Fault::kWrongMove) {
          changed.move = OtherMove(set.moves, part.move, turn++);
        } else {
          changed.danced.clear();
        }
      }
    }
  }
  return world;
}

Result<void> CheckRecordings(const LabelledStreams& set, bool are_taught) {
  if (!are_taught && !set.nobody.empty()) {
    return Fail({set.file},
                "the person in the recording {} is unknown; needed: a column 'person', file names of a known data set, "
                "or the key 'moves'",
                set.nobody);
  }
  if (!are_taught && set.people.size() < 2) {
    return Fail({set.file}, "{} is the only recorded person; needed: at least two people, or the key 'moves'",
                set.people.front().name);
  }
  const LabelledPart* before = nullptr;
  for (const LabelledPart& part : set.parts) {
    if (part.is_action_point) continue;
    if (before != nullptr && before->stream == part.stream && before->begin == part.begin) {
      return Fail({set.file, part.line}, "two performances in the recording {} begin at the same time",
                  set.streams[part.stream].name);
    }
    before = &part;
  }
  return {};
}

Result<Fold> MakeFold(const LabelledStreams& set, const std::optional<std::vector<TaughtMove>>& taught,
                      const std::set<std::string>& left_out, const std::vector<DetectionMethod>& methods) {
  Fold fold;
  if (taught) {
    fold.repertoire.taught = *taught;
    std::ranges::sort(fold.repertoire.taught, {}, &TaughtMove::name);
  } else {
    const auto by_others = [&](const LabelledPart& part) { return !left_out.contains(part.person); };
    ASSIGN_OR_RETURN(fold.repertoire.taught, TeachMoves(set.streams, set.parts, by_others, false));
  }
  std::set<std::string> names(set.moves.begin(), set.moves.end());
  for (const TaughtMove& move : fold.repertoire.taught) names.insert(move.name);
  fold.repertoire.names.assign(names.begin(), names.end());
  for (const DetectionMethod& method : methods) {
    auto recogniser = MakeRecogniser(method.recogniser, fold.repertoire.taught);
    if (!recogniser) return Fail({set.file}, "method {}: {}", method.name, recogniser.error().message);
    fold.methods.push_back({method, *std::move(recogniser)});
  }
  return fold;
}

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
      return std::make_unique<SkippedWorld>(fmt::format("only {} people were recorded", set_.people.size()));
    }
    const Result<Fold>& fold = FoldOf(person);
    if (!fold) return std::make_unique<SkippedWorld>(fold.error().message);
    return std::make_unique<SessionWorld>(
        fold->methods,
        [this, key, scenario = std::string(key.scenario)]() -> const std::vector<MethodDecision>& {
          return DecisionsFor({key.suite_seed, scenario, key.trial});
        },
        fold->repertoire, MakeRecordedWorld(set_, person, options_, key), keeps_motion,
        HasOwnSettings() ? SessionWorld::Set([this, person] { return SettingOf(person); }) : SessionWorld::Set());
  }

  std::vector<std::string> ClipsOf(const WorldKey& key) const override {
    const auto person = static_cast<std::size_t>(key.trial);
    if (person >= set_.people.size()) return {};
    return {set_.people[person].name};
  }

  bool HasOwnSettings() const override { return !taught_; }

  Result<Payload> Setting() const override {
    const std::vector<TaughtMove> taught = taught_.value_or(std::vector<TaughtMove>{});
    std::set<std::string> names(set_.moves.begin(), set_.moves.end());
    for (const TaughtMove& move : taught) names.insert(move.name);
    return TaughtPayload(std::vector<std::string>(names.begin(), names.end()), taught, ExamplesOf(taught));
  }

  std::optional<double> ValueOfFailure(std::string_view metric) const override {
    return DetectionFailureValue(metric, std::ranges::any_of(set_.parts, &LabelledPart::IsRight));
  }

 private:
  const std::string& NameOf(std::size_t person) const { return set_.people[person].name; }

  /// Returns the setting for an outside method that judges this person: the moves that all other people taught.
  /// `FoldOf(person)` must have succeeded.
  Payload SettingOf(std::size_t person) const {
    const auto by_others = [&](const LabelledPart& part) { return part.person != NameOf(person); };
    std::vector<ToldExample> examples;
    for (const LabelledPart& part : PerformancesToLearn(set_.streams, set_.parts, by_others, false)) {
      examples.push_back({part.move, part.person, part.fault, &set_.streams[part.stream].stream, part.begin, part.end});
    }
    const Repertoire& repertoire = FoldOf(person)->repertoire;
    return TaughtPayload(repertoire.names, repertoire.taught, examples);
  }

  /// Returns the fold in which this person is judged. Its recognisers were taught the moves in the condition's file or,
  /// without such a file, by all other people.
  const Result<Fold>& FoldOf(std::size_t person) const {
    const std::size_t index = taught_ ? 0 : person;  // moves taught beforehand are the same for all
    const auto known = folds_.find(index);
    if (known != folds_.end()) return known->second;
    return folds_.emplace(index, MakeFold(set_, taught_, {NameOf(person)}, methods_)).first->second;
  }

  /// Returns the thresholds of the methods. With an operating point, recordings of other people determine thresholds.
  /// If no moves were taught beforehand, each of these people is seen by recognisers of a fold of their own, which
  /// leaves out that person and the judged person.
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
  // Caches: folds by fold index, and decisions by trial. These keys suffice, because a task has one scenario and one
  // seed.
  mutable std::map<std::size_t, Result<Fold>> folds_;
  mutable std::map<int, std::vector<MethodDecision>> decisions_;
};

/// Fails if a fault cannot be imposed on these recordings.
Result<void> CheckFaults(const Node& condition, std::span<const Fault> faults, const LabelledStreams& set) {
  if (faults.empty()) return {};
  const Node& named = *condition.Find("faults");
  for (const Fault fault : faults) {
    if (std::ranges::find(MadeFaults(), fault) != MadeFaults().end()) continue;
    std::vector<std::string_view> allowed;
    for (const Fault made : MadeFaults()) allowed.push_back(FaultName(made));
    return Fail(named.place, "the fault '{}' cannot be made from a recording; allowed: {}", FaultName(fault),
                fmt::join(allowed, ", "));
  }
  if (std::ranges::any_of(set.parts, &LabelledPart::is_action_point)) {
    return Fail(named.place,
                "faults can be made only from performances with a begin and an end, but {} has action points; needed: "
                "from_s and to_s",
                set.file);
  }
  if (set.moves.size() > 1 || std::ranges::find(faults, Fault::kWrongMove) == faults.end()) return {};
  return Fail(named.place, "'{}' needs two moves, found: {}", FaultName(Fault::kWrongMove), fmt::join(set.moves, ", "));
}

/// Fails if the condition has a key that has no effect on recorded people.
Result<void> RefuseKeys(const Node& condition, std::span<const std::string_view> keys, std::string_view why) {
  for (const std::string_view key : keys) {
    const Node* named = condition.Find(key);
    if (named != nullptr) return Fail(named->place, "'{}' cannot be used here: {}", key, why);
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<Task>> MakeRecordedTask(TaskInput& input, const DetectionOptions& options,
                                               std::vector<DetectionMethod> methods) {
  const LabelledStreams& set = *input.recordings;
  const Node& condition = input.condition.node();
  RETURN_IF_ERROR(
      RefuseKeys(condition, PeopleKeys(), "it describes simulated people, but this scenario uses recordings"));
  // Refuse keys and oracles that have no effect on recordings.
  const bool are_sensed = std::ranges::any_of(set.streams, [](const NamedStream& s) { return s.motion.has_value(); });
  if (!are_sensed)
    RETURN_IF_ERROR(RefuseKeys(condition, SensingKeys(),
                               "it describes a simulated sensor, but this scenario uses recordings of a sensor"));
  if (options.has_cameras) {
    return Fail(condition.Find("sensor")->place,
                "'sensor: cameras' films only simulated people, but this scenario uses recordings; allowed: v1, v2, a "
                "sensor file");
  }
  for (const DetectionMethod& method : methods) {
    if (!method.sees_truth || are_sensed) continue;
    return Fail(condition.place,
                "method {}: 'oracle: [stream]' is not allowed, because the true motion of recorded people is unknown",
                method.name);
  }
  RETURN_IF_ERROR(CheckFaults(condition, options.session.faults, set));
  // Find the moves, the labels and the number of people.
  Taught taught;
  if (!options.moves.empty()) {
    ASSIGN_OR_RETURN(taught, ReadMoves(input.texts.at(kMovesKey), options.moves));
  }
  RETURN_IF_ERROR(CheckRecordings(set, taught.has_value()));
  const std::size_t needed = taught ? 2 : 3;  // one person is judged, one sets the thresholds, one teaches
  if (options.operating_point && set.people.size() < needed) {
    return Fail(
        condition.Find("operating_point")->place,
        "'operating_point' needs recordings of people who neither teach nor are judged; found {} people, needed: {}",
        set.people.size(), needed);
  }
  // Check once before the run that every method can be taught.
  if (auto all = MakeFold(set, taught, {}, methods); !all) return tl::unexpected(all.error());
  return std::make_unique<RecordedTask>(options, std::move(methods), set, std::move(taught));
}

}  // namespace etude
