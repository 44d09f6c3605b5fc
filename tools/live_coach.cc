#include "tools/live_coach.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/base/text.h"
#include "engine/coaching/policy.h"
#include "io/files/json.h"
#include "io/process/clock.h"

namespace etude {
namespace {

/// Rounds to multiples of 1 / `per_unit`; returns 0 instead of −0, because JSON would show the sign.
double Rounded(double value, double per_unit) { return std::round(value * per_unit) / per_unit + 0.0; }

Json NumbersOf(const BodyPose& pose) {
  Json numbers = Json::array();
  for (const glm::dvec3& joint : pose.joints) {
    for (int axis = 0; axis < 3; ++axis) numbers.push_back(Rounded(joint[axis], 1000));
  }
  return numbers;
}

Json EventOf(const CoachRecord& record, const Dance& dance) {
  Json event = {{"event", EventName(record.event)}};
  if (record.repetition >= 0) {
    event["repetition"] = record.repetition;
    event["move"] = dance.moves[dance.repetitions[record.repetition].move].name;
  }
  if (record.mistake != Mistake::kNone) event["mistake"] = MistakeName(record.mistake);
  if (record.event == CoachEvent::kTag) {
    event["beat_error_ms"] = Rounded(1000 * record.beat_error_s, 10);
    event["rate"] = Rounded(record.rate, 10000);
  }
  event["why"] = record.why;
  return event;
}

Json MusicOf(const MusicCommand& music) {
  if (music.kind == MusicCommand::Kind::kPause) return {{"pause", true}};
  return {{"play_from_s", Rounded(music.music_s, 1000)}};
}

}  // namespace

Result<std::string> CoachHead(const Dance& dance) {
  Json head = {{"schema_version", 1}, {"song", dance.title}, {"tempo_bpm", dance.tempo_bpm}};
  head["rate_hz"] = kJudgedRateHz;
  head["repetitions"] = dance.repetitions.size();
  for (Role role : AllRoles()) head["joints"].push_back(RoleName(role));
  for (const DanceMove& move : dance.moves) {
    head["moves"].push_back({{"name", move.name}, {"hint", move.hint}, {"key_pose", NumbersOf(move.key_pose)}});
  }
  return WriteJson(head);
}

Result<std::string> CoachLine(const CoachOutput& output, std::int64_t frame, const Dance& dance, bool brief) {
  Json line = {{"frame", frame},
               {"t_s", Rounded(static_cast<double>(frame) / kJudgedRateHz, 1000)},
               {"mode", ModeName(output.mode)},
               {"clip", output.clip},
               {"clip_frame", Rounded(output.clip_frame, 100)}};
  if (output.in_transition) line["in_transition"] = true;
  if (output.open) {
    line["asked"] = {{"repetition", output.open->repetition}, {"move", dance.moves[output.open->move].name}};
  }
  if (!output.say.empty()) line["say"] = output.say;
  if (!output.hint.empty()) line["hint"] = output.hint;
  if (output.stand != PlayerHint::kNone) line["stand"] = HintText(output.stand);
  if (output.music.kind != MusicCommand::Kind::kNone) line["music"] = MusicOf(output.music);
  if (output.beat_error_s) line["beat_error_ms"] = Rounded(1000 * *output.beat_error_s, 10);
  for (const CoachRecord& record : output.records) line["events"].push_back(EventOf(record, dance));
  if (!brief) line["body"] = NumbersOf(output.body);
  return WriteJson(line);
}

void MusicPosition::Follow(const MusicCommand& command) {
  if (command.kind == MusicCommand::Kind::kPause) now_s_.reset();
  if (command.kind == MusicCommand::Kind::kPlayFrom) now_s_ = command.music_s;
}

void MusicPosition::Tick() {
  if (now_s_) *now_s_ += 1 / kJudgedRateHz;
}

Result<void> MusicPosition::Take(std::string_view line, int number) {
  constexpr std::string_view kWord = "#music";
  if (!line.starts_with(kWord)) return {};
  line.remove_prefix(std::min(line.find_first_not_of(" \t", kWord.size()), line.size()));
  const auto seconds = TakeNumber(line);
  if (!seconds || !(*seconds >= 0 && *seconds < 1e6)) {
    return Fail(
        {"the stream", number, 1},
        "'#music' has no valid time; allowed: the time since the start of the song, in s, such as '#music 12.34'");
  }
  if (now_s_) now_s_ = *seconds;
  return {};
}

LiveCoach::LiveCoach(const DanceTransitions& transitions, const Recogniser& recogniser, LiveCoachOptions options,
                     OnLine on_line)
    : transitions_(transitions), recogniser_(recogniser), options_(std::move(options)), on_line_(std::move(on_line)) {}

Result<void> LiveCoach::Follow(std::istream& stream, LiveStream& live) {
  std::vector<SensedFrame> frames;
  std::string line;
  const auto pass_on = [&]() -> Result<void> {
    for (const std::string& remark : live.TakeRemarks()) {
      if (options_.on_remark) options_.on_remark(remark);
    }
    for (const SensedFrame& frame : frames) RETURN_IF_ERROR(Take(frame, *live.Meaning()));
    frames.clear();
    return {};
  };
  for (int number = 1; std::getline(stream, line); ++number) {
    RETURN_IF_ERROR(music_.Take(line, number));
    RETURN_IF_ERROR(live.Take(line, frames));
    RETURN_IF_ERROR(pass_on());
  }
  RETURN_IF_ERROR(live.Finish(frames));
  return pass_on();
}

Result<void> LiveCoach::Take(const SensedFrame& frame, const StreamRecording& meaning) {
  if (!session_) Begin(meaning);
  const auto begin = Clock::now();
  music_.Tick();
  const CoachOutput output = session_->Next(frame, {.music_s = music_.Seconds()});
  music_.Follow(output.music);
  const bool is_news = !output.records.empty() || output.music.kind != MusicCommand::Kind::kNone;
  if (!options_.brief || is_news) {
    ASSIGN_OR_RETURN(const auto line, CoachLine(output, frame_, transitions_.dance(), options_.brief));
    on_line_(line);
  }
  ++frame_;
  times_ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
  return {};
}

void LiveCoach::Begin(const StreamRecording& meaning) {
  // In recordings of a device, the origin is the device, so the sensor is at the origin. In Etude's own format, the
  // sensor's position is unknown.
  if (!meaning.is_level) options_.coach.sensor = {0, 0, 0};
  coach_ = std::make_unique<Coach>(transitions_, options_.coach, Coach::PolicyChoice{FindPolicy(options_.policy), {}});
  if (options_.plans_ahead) coach_->PlanAhead();
  session_.emplace(
      CoachSession::Parts{
          .coach = coach_.get(), .recogniser = &recogniser_, .filter = {.kind = FilterOf(options_.filter)}},
      options_.dances_at_once ? coach_->BeginDancing() : coach_->Begin());
}

}  // namespace etude
