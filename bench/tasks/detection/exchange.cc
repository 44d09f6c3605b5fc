#include "bench/tasks/detection/exchange.h"

#include <nlohmann/json.hpp>
#include <set>

#include "bench/recordings/task_extras.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"
#include "engine/base/named.h"
#include "engine/formats/bvh.h"
#include "engine/formats/trc.h"
#include "engine/motion/clip.h"
#include "engine/teaching/labelled_streams.h"

namespace etude {
namespace {

constexpr Range kScores{-1e9, 1e9};

Json DescribeKeyPose(const KeyPose& key_pose) {
  Json targets = Json::array();
  for (const KeyPose::Target& target : key_pose.targets) {
    targets.push_back(
        {{"feature", target.feature}, {"degrees", target.degrees}, {"tolerance_deg", target.tolerance_deg}});
  }
  return {{"beat", key_pose.beat}, {"targets", std::move(targets)}};
}

Json DescribeTaughtPose(const TaughtPose& pose) {
  Json targets = Json::array();
  for (const PoseTarget& target : pose.targets) {
    targets.push_back({{"feature", FeatureName(target.feature)},
                       {"degrees", target.degrees},
                       {"tolerance_deg", target.tolerance_deg}});
  }
  return {{"targets", std::move(targets)}};
}

Json DescribeFrame(const SensedFrame& frame) {
  return {{"pose", EncodePose(PoseOf(frame))}, {"states", StateLetters(frame)}, {"body_seen", frame.body_seen}};
}

Json DescribeExample(const ToldExample& example) {
  Json frames = Json::array();
  for (int i = example.begin; i < example.end; ++i) {
    frames.push_back(DescribeFrame(example.stream->frames[static_cast<std::size_t>(i)]));
  }
  return {{"person", example.person},
          {"is_right", example.fault.empty()},
          {"fault", example.fault},
          {"rate_hz", example.stream->rate_hz},
          {"frames", std::move(frames)}};
}

std::string FileOf(const Move& move) { return move.name + ".bvh"; }

Json DescribeMove(const Move& move) {
  Json key_poses = Json::array();
  for (const KeyPose& key_pose : move.key_poses) key_poses.push_back(DescribeKeyPose(key_pose));
  return {{"name", move.name},
          {"tempo_bpm", move.tempo_bpm},
          {"beats", move.beats},
          {"rate_hz", move.motion.rate_hz},
          {"poses", EncodePoses(move.motion.poses)},
          {"key_poses", std::move(key_poses)},
          {"file", FileOf(move)}};
}

Judgement ReadEvent(AnswerFields& fields, const FrameInterval& window) {
  Judgement judgement;
  const auto right_at = fields.NullableInteger("right_at_frame", window.begin, window.end - 1);
  if (right_at) judgement.recognised_at = *right_at - window.begin;
  judgement.score = fields.Number("score", kScores);
  judgement.running_score.assign(static_cast<std::size_t>(window.end - window.begin), judgement.score);
  return judgement;
}

}  // namespace

Payload TaughtPayload(std::span<const std::string> names, std::span<const TaughtMove> taught,
                      std::span<const ToldExample> examples) {
  Payload setting = PayloadOf(DescribeBody());
  Json& told = (*setting.json)["moves"] = Json::array();
  for (const std::string& name : names) {
    Json move = {{"name", name},
                 {"rate_hz", kJudgedRateHz},
                 {"poses", Json::array()},
                 {"key_poses", Json::array()},
                 {"examples", Json::array()}};
    if (const TaughtMove* known = FindByName(taught, name)) {
      move["span_s"] = known->span_s;
      for (const TaughtPose& pose : known->poses) move["key_poses"].push_back(DescribeTaughtPose(pose));
      const ToldExample* first_right = nullptr;
      for (const ToldExample& example : examples) {
        if (example.move != name) continue;
        move["examples"].push_back(DescribeExample(example));
        if (first_right == nullptr && example.fault.empty()) first_right = &example;
      }
      if (first_right != nullptr) {
        const BodyMotion motion = MotionOf(PartOf(*first_right->stream, first_right->begin, first_right->end));
        move["rate_hz"] = motion.rate_hz;
        move["poses"] = EncodePoses(motion.poses);
        move["file"] = fmt::format("{}.bvh", told.size());  // a label need not be a valid file name
        setting.files.push_back({move["file"].get<std::string>(), WriteBvh(ToClip(motion, name))});
      }
    }
    told.push_back(std::move(move));
  }
  return setting;
}

std::vector<ToldExample> ExamplesOf(std::span<const TaughtMove> taught) {
  std::vector<ToldExample> examples;
  for (const TaughtMove& move : taught) {
    for (const auto& [streams, fault] : {std::pair(&move.examples, ""), {&move.counter_examples, "wrong"}}) {
      for (const SkeletonStream& stream : *streams) {
        examples.push_back({move.name, "", fault, &stream, 0, static_cast<int>(stream.frames.size())});
      }
    }
  }
  return examples;
}

Payload MovesPayload(std::span<const Move> moves) {
  Payload setting = PayloadOf(DescribeBody());
  Json& told = (*setting.json)["moves"] = Json::array();
  for (const Move& move : moves) {
    told.push_back(DescribeMove(move));
    setting.files.push_back({FileOf(move), WriteBvh(ToClip(move.motion, move.name))});
  }
  return setting;
}

Payload SessionPayload(const DetectionWorld& world) {
  Json frames = Json::array(), events = Json::array();
  for (const SensedFrame& frame : world.stream.frames) frames.push_back(DescribeFrame(frame));
  for (const DetectionEvent& event : world.events) {
    const FrameInterval& window = event.window;
    events.push_back({{"move", event.move}, {"begin_frame", window.begin}, {"end_frame", window.end}});
  }
  const char* file = "stream.trc";
  Json json = {
      {"rate_hz", world.stream.rate_hz}, {"frames", std::move(frames)}, {"events", std::move(events)}, {"file", file}};
  if (world.IsRecorded()) {
    json["person"] = world.person;
    json["starts"] = world.starts;
  }
  return PayloadOf(std::move(json), {{file, WriteTrc(MotionOf(world.stream), file)}});
}

Payload TruthPayload(const DetectionWorld& world) {
  Json events = Json::array();
  for (const DetectionEvent& event : world.events) {
    const FrameInterval& window = event.window;
    Json told = {{"move", event.move},     {"is_right", event.IsRight()}, {"fault", event.FaultText()},
                 {"danced", event.danced}, {"begin_frame", window.begin}, {"end_frame", window.end}};
    if (event.first_right_s) told["first_right_s"] = *event.first_right_s;
    events.push_back(std::move(told));
  }
  const BodyMotion& motion = world.motion;
  const char* file = "truth.trc";
  Json json = {
      {"rate_hz", motion.rate_hz}, {"poses", EncodePoses(motion.poses)}, {"events", std::move(events)}, {"file", file}};
  for (const ActionPoint& point : world.points) {
    json["action_points"].push_back({{"move", point.move}, {"frame", point.frame}});
  }
  return PayloadOf(std::move(json), {{file, WriteTrc(motion, file)}});
}

Result<SessionVerdict> ReadSessionAnswer(const Json& answer, const DetectionWorld& world,
                                         const Repertoire& repertoire) {
  AnswerFields fields(answer);
  SessionVerdict verdict;
  verdict.filtered = world.stream;

  // Read one judgement per requested performance.
  const std::vector<DetectionEvent>& asked = world.events;
  const Json& events = fields.List("events", asked.size(), asked.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    AnswerFields event(events[i], fields.PathOf("events", i));
    verdict.events.push_back(ReadEvent(event, asked[i].window));
    if (auto done = event.Finish(); !done) fields.Note(done.error());
  }

  // Read all detections, each once.
  const std::vector<std::string> moves = NamesOf(repertoire.taught);
  const int frames = static_cast<int>(world.stream.frames.size());
  std::set<std::pair<std::size_t, int>> calls;  // (index of the move, frame) of each detection
  const Json& said = fields.List("alarms", 0, moves.size() * world.stream.frames.size());
  for (std::size_t i = 0; i < said.size(); ++i) {
    AnswerFields alarm(said[i], fields.PathOf("alarms", i));
    const std::string move = alarm.RequiredChoice("move", moves);
    const int frame = alarm.Integer("frame", 0, frames - 1);
    if (auto done = alarm.Finish(); !done) fields.Note(done.error());
    // RequiredChoice has already reported an unknown move.
    if (const auto taught = repertoire.TaughtIndexOf(move)) calls.emplace(*taught, frame);
  }
  // False alarms are the detections outside every performance of their move.
  for (const auto& [move, frame] : calls) {
    verdict.spotted.push_back({move, frame});
    if (!IsPerformance(moves[move], frame, world)) verdict.alarms.push_back({move, frame});
  }

  RETURN_IF_ERROR(fields.Finish());
  return verdict;
}

std::string StateLetters(const SensedFrame& frame) {
  std::string letters;
  for (const SensedJoint& joint : frame.joints) {
    const bool tracked = joint.state == TrackingState::kTracked, inferred = joint.state == TrackingState::kInferred;
    letters += tracked ? 't' : inferred ? 'i' : 'n';
  }
  return letters;
}

Recording RecordSession(const DetectionWorld& world, const SessionVerdict& verdict, const Repertoire& repertoire) {
  DetectionExtras extras;
  extras.threshold = verdict.threshold;
  // Add the moves with their key poses.
  for (const TaughtMove& move : repertoire.taught) {
    DetectionExtras::Move& told = extras.moves.emplace_back();
    told.name = move.name;
    for (const TaughtPose& pose : move.poses) {
      auto& targets = told.key_poses.emplace_back();
      for (const PoseTarget& target : pose.targets) {
        targets.push_back({std::string(FeatureName(target.feature)), target.degrees, target.tolerance_deg});
      }
    }
  }
  // Add the performances with their judgements, and then the alarms.
  for (std::size_t i = 0; i < verdict.events.size(); ++i) {
    const DetectionEvent& event = world.events[i];
    const Judgement& judgement = verdict.events[i];
    const FrameInterval& window = event.window;
    DetectionExtras::Event& told = extras.events.emplace_back();
    told = {.move = event.move,
            .truth = std::string(TruthName(event.truth)),
            .fault = event.FaultText(),
            .danced = event.danced,
            .begin_frame = window.begin,
            .end_frame = window.end,
            .called_right = judgement.recognised_at.has_value(),
            .score = judgement.score};
    if (judgement.recognised_at) told.called_frame = window.begin + *judgement.recognised_at;
  }
  for (const Detection& alarm : verdict.alarms) {
    extras.alarms.push_back({repertoire.taught[alarm.move].name, alarm.frame});
  }
  for (const SensedFrame& frame : world.stream.frames) extras.joint_states.push_back(StateLetters(frame));
  return {{{"truth", world.motion}, {"sensed", MotionOf(verdict.filtered)}}, WriteExtras(extras)};
}

}  // namespace etude
