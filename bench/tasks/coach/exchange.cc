#include "bench/tasks/coach/exchange.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/recordings/task_extras.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/detection/exchange.h"

namespace etude {
namespace {

constexpr Range kShares{0, 1};

Json NameOf(const CoachStage& stage, int move) {
  return move < 0 ? Json(nullptr) : Json(stage.dance().moves[static_cast<std::size_t>(move)].name);
}

/// Describes the content of the screen as JSON, for programs that receive no picture.
Json DescribeShown(const CoachStage& stage, const CoachOutput& shown) {
  const int move =
      shown.repetition < 0 ? -1 : stage.dance().repetitions[static_cast<std::size_t>(shown.repetition)].move;
  return {{"mode", ModeName(shown.mode)}, {"move", NameOf(stage, move)}, {"repetition", shown.repetition}};
}

bool IsVerdict(CoachEvent event) {
  return event == CoachEvent::kRight || event == CoachEvent::kWrong || event == CoachEvent::kUnjudged;
}

PerformanceTruth TruthIn(AnswerFields& fields) {
  const Json* right = fields.Raw("right");
  if (right == nullptr || right->is_null()) return PerformanceTruth::kGrey;
  return fields.Boolean("right", false) ? PerformanceTruth::kRight : PerformanceTruth::kWrong;
}

class SeatedFollower final : public MoveFollower {
 public:
  explicit SeatedFollower(SeatedCoachProgram& program) : program_(program), spotted_(program.stage().moves.size()) {}

  void Ask(std::optional<std::size_t> move) override {
    ask_ = Json{{"move", move ? NameOf(program_.stage(), static_cast<int>(*move)) : Json(nullptr)}};
    asked_ = 0;
  }

  Evidence Update(const SeenFrame& frame) override {
    Json step = {{"pose", EncodePose(PoseOf(frame.skeleton))},
                 {"states", StateLetters(frame.skeleton)},
                 {"body_seen", frame.skeleton.body_seen}};
    if (ask_) step["ask"] = *std::exchange(ask_, std::nullopt);
    if (program_.error()) return {0, spotted_};
    if (const JsonPtr answer = program_.Step(std::move(step))) program_.Note(Read(*answer));
    return {asked_, spotted_};
  }

 private:
  Result<void> Read(const Json& answer) {
    AnswerFields fields(answer);
    asked_ = std::max(asked_, fields.Number("asked", kShares));
    if (fields.Has("spotted")) {
      ASSIGN_OR_RETURN(spotted_, ReadNumbers(*fields.Raw("spotted"), "spotted", spotted_.size(), kShares));
    }
    return fields.Finish();
  }

  SeatedCoachProgram& program_;
  std::optional<Json> ask_;
  double asked_ = 0;
  std::vector<double> spotted_;
};

class SeatedPolicy final : public MomentSource {
 public:
  explicit SeatedPolicy(SeatedCoachProgram& program) : program_(program) {}

  bool Now(int /*frame*/, const CoachOutput& before) override {
    Json step = DescribeShown(program_.stage(), before);
    step["verdicts"] = Json::array();
    for (const CoachRecord& record : before.records) {
      if (!IsVerdict(record.event)) continue;
      step["verdicts"].push_back({{"move", NameOf(program_.stage(), record.move)},
                                  {"repetition", record.repetition},
                                  {"verdict", EventName(record.event)},
                                  {"mistake", MistakeName(record.mistake)},
                                  {"evidence", record.evidence}});
    }
    const JsonPtr answer = program_.Step(std::move(step));
    if (answer == nullptr) return false;
    AnswerFields fields(*answer);
    const bool corrects = fields.Boolean("correct", false);
    program_.Note(fields.Finish());
    return corrects;
  }

 private:
  SeatedCoachProgram& program_;
};

class SeatedLearner final : public Player {
 public:
  explicit SeatedLearner(SeatedCoachProgram& program)
      : program_(program),
        pose_(program.stage().dance().motion.poses.front()),
        truths_(program.stage().dance().repetitions.size()) {}

  BodyPose Next(const CoachOutput& shown) override {
    Json step = DescribeShown(program_.stage(), shown);
    step["pose"] = EncodePose(shown.body);
    step["clip"] = shown.clip;
    step["clip_frame"] = shown.clip_frame;
    step["say"] = shown.say;
    step["hint"] = shown.hint;
    step["events"] = Json::array();
    for (const CoachRecord& record : shown.records) step["events"].push_back(EventName(record.event));
    if (const JsonPtr answer = program_.Step(std::move(step))) program_.Note(Read(*answer, shown.repetition));
    return pose_;
  }

  std::optional<PlayedPerformance> PerformanceOf(int repetition) const override {
    const auto& truth = truths_[static_cast<std::size_t>(repetition)];
    if (!truth) return std::nullopt;
    return PlayedPerformance{*truth, *truth == PerformanceTruth::kRight ? "none" : "its own"};
  }
  bool HasGivenUp() const override { return given_up_; }

  std::vector<double> TakeTest(int performances_later) override {
    std::vector<double> right;
    for (const Move& move : program_.stage().moves) {
      const JsonPtr answer = program_.Step({{"test", {{"move", move.name}, {"after", performances_later}}}});
      if (answer == nullptr) break;
      AnswerFields fields(*answer);
      const PerformanceTruth truth = TruthIn(fields);
      if (truth != PerformanceTruth::kGrey) right.push_back(truth == PerformanceTruth::kRight ? 1 : 0);
      program_.Note(fields.Finish());
    }
    return right;
  }

 private:
  Result<void> Read(const Json& answer, int repetition) {
    AnswerFields fields(answer);
    const Json* pose = fields.Raw("pose");
    if (pose == nullptr) return Fail({}, "pose: is missing");
    ASSIGN_OR_RETURN(pose_, ReadPose(*pose, "pose"));
    given_up_ = fields.Boolean("given_up", given_up_);
    const PerformanceTruth truth = TruthIn(fields);
    if (repetition >= 0) truths_[static_cast<std::size_t>(repetition)] = truth;
    return fields.Finish();
  }

  SeatedCoachProgram& program_;
  BodyPose pose_;
  std::vector<std::optional<PerformanceTruth>> truths_;  ///< for each repetition, the truth of its latest performance
  bool given_up_ = false;
};

std::string_view TruthName(PerformanceTruth truth) {
  if (truth == PerformanceTruth::kGrey) return "grey";
  return truth == PerformanceTruth::kRight ? "right" : "wrong";
}

/// Returns the modes of the session, each with its first frame.
std::vector<CoachExtras::Mode> ModesOf(const SessionLog& log) {
  std::vector<CoachExtras::Mode> modes;
  for (int frame = 0; frame < log.Frames(); ++frame) {
    const CoachMode mode = log.modes[static_cast<std::size_t>(frame)];
    const bool begins = frame == 0 || log.modes[static_cast<std::size_t>(frame) - 1] != mode;
    if (begins) modes.push_back({std::string(ModeName(mode)), frame});
  }
  return modes;
}

}  // namespace

Payload DancePayload(const CoachStage& stage) {
  Payload setting = MovesPayload(stage.moves);
  const Dance& dance = stage.dance();
  Json repetitions = Json::array();
  for (const Repetition& repetition : dance.repetitions) {
    repetitions.push_back({{"move", NameOf(stage, repetition.move)}});
  }
  (*setting.json)["dance"] = {{"title", dance.title},
                              {"tempo_bpm", dance.tempo_bpm},
                              {"rate_hz", dance.motion.rate_hz},
                              {"repetitions", std::move(repetitions)}};
  return setting;
}

Payload SessionBeginPayload(Seat seat) {
  return PayloadOf({{"seat", SeatNames()[static_cast<std::size_t>(seat) - 1]}});
}

JsonPtr SeatedCoachProgram::Step(Json step) {
  return error_ ? nullptr : program_.Step(PayloadOf(std::move(step)));
}

std::unique_ptr<Recogniser> MakeSeatedRecogniser(SeatedCoachProgram& program) {
  return MakeRecogniser([&program](double /*rate_hz*/) { return std::make_unique<SeatedFollower>(program); });
}

std::unique_ptr<MomentSource> MakeSeatedPolicy(SeatedCoachProgram& program) {
  return std::make_unique<SeatedPolicy>(program);
}

std::unique_ptr<Player> MakeSeatedLearner(SeatedCoachProgram& program) {
  return std::make_unique<SeatedLearner>(program);
}

Recording RecordCoaching(const CoachStage& stage, const SessionLog& log) {
  CoachExtras extras;
  extras.song = stage.dance().title;
  extras.modes = ModesOf(log);
  // Add every performance: its truth, and the coach's judgement.
  for (const LoggedPerformance& performance : log.performances) {
    const CoachedPerformance& judged = performance.judged;
    extras.performances.push_back({.move = stage.moves[static_cast<std::size_t>(performance.move)].name,
                                   .truth = std::string(TruthName(judged.truth)),
                                   .called = judged.called_right   ? "right"
                                             : judged.called_wrong ? "wrong"
                                                                   : "unjudged",
                                   .begin_frame = judged.begin_frame,
                                   .end_frame = judged.end_frame,
                                   .faults = performance.faults});
  }
  // Add the coach's words, decisions, corrections and pictures.
  for (const LoggedWords& words : log.words) {
    extras.words.push_back({words.begin_frame, words.say, words.hint, words.picture});
  }
  for (const CoachRecord& record : log.records) {
    extras.decisions.push_back({static_cast<int>(record.frame), std::string(EventName(record.event)), record.why});
  }
  for (const GivenCorrection& correction : log.corrections) extras.corrections.push_back(correction.decided_frame);
  for (const LoggedTransition& transition : log.transitions) {
    extras.transitions.insert(extras.transitions.end(), transition.points.begin(), transition.points.end());
  }
  extras.beats_s = log.beats_s;
  for (const SensedFrame& frame : log.sensed.frames) extras.joint_states.push_back(StateLetters(frame));
  return {{{"coach", log.coach}, {"truth", log.learner}, {"sensed", MotionOf(log.sensed)}}, WriteExtras(extras)};
}

}  // namespace etude
