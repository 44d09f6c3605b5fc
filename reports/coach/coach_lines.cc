#include "reports/coach/coach_lines.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/files/json.h"

namespace etude {
namespace {

/// Never -0, which JSON would show.
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

}  // namespace etude
