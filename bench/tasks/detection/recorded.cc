#include "bench/tasks/detection/recorded.h"

#include <algorithm>
#include <set>

#include "bench/streams/teach.h"

namespace etude {
namespace {

constexpr double kGrace = 0.5;  // seconds, as after a simulated performance

/// The world grows by one recording, of which `parts` are the labels.
class Joiner {
 public:
  explicit Joiner(DetectionWorld& world) : world_(world) {}

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
    event.told_fault = part.fault;
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

std::span<const LabelledPart> PartsOf(const LabelledStreams& set, std::size_t stream) {
  return {std::ranges::lower_bound(set.parts, stream, {}, &LabelledPart::stream),
          std::ranges::upper_bound(set.parts, stream, {}, &LabelledPart::stream)};
}

}  // namespace

DetectionWorld MakeRecordedWorld(const LabelledStreams& set, std::size_t person, const DetectionOptions& options,
                                 const WorldKey& key) {
  DetectionWorld world{.motion = {}, .events = {}, .stream = {}, .person = set.people[person].name};
  Joiner joiner(world);
  for (const std::size_t s : set.people[person].streams) {
    const NamedStream& recording = set.streams[s];
    if (recording.motion) {
      const std::string scenario = std::string(key.scenario) + "/" + recording.name;
      const WorldKey own{key.suite_seed, scenario, key.trial};
      joiner.Add(*recording.motion, Sense(*recording.motion, options, own), PartsOf(set, s));
    } else {
      joiner.Add(MotionOf(recording.stream), recording.stream, PartsOf(set, s));
    }
  }
  return world;
}

Result<void> CheckRecordings(const LabelledStreams& set, bool are_taught) {
  if (!are_taught && !set.nobody.empty()) {
    return Fail({set.file},
                "nobody says who {} is; needed: a column 'person', a known set's file names, or 'moves', "
                "what recognisers are taught",
                set.nobody);
  }
  if (!are_taught && set.people.size() < 2) {
    return Fail({set.file},
                "{} alone; leaving one person out needs two people, or 'moves', what recognisers are taught",
                set.people.front().name);
  }
  const LabelledPart* before = nullptr;
  for (const LabelledPart& part : set.parts) {
    if (part.is_action_point) continue;
    if (before != nullptr && before->stream == part.stream && before->begin == part.begin) {
      return Fail({set.file, part.line}, "two performances of {} begin at once", set.streams[part.stream].name);
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

}  // namespace etude
