#include "sim/choreography/move.h"

#include <algorithm>
#include <cmath>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/document/fields.h"
#include "sim/choreography/builtin_files.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/pose_reader.h"
#include "sim/choreography/slow_demonstration.h"

namespace etude {
namespace {

constexpr Range kTempoRange = {40, 240};

/// Appends the first half's mirror image as the second half.
void AppendMirrorImage(std::vector<PoseKey>& keys, double half) {
  const std::size_t count = keys.size();
  for (std::size_t i = 0; i < count; ++i) {
    keys.push_back({keys[i].beat + half, Mirrored(keys[i].controls), keys[i].ease});
  }
}

/// `tempo_range_bpm: [slowest, fastest]`, which holds the move's own tempo.
void ReadTempoRange(Fields& fields, Move& move) {
  const std::vector<double> range = fields.Numbers("tempo_range_bpm", kTempoRange);
  move.slowest_bpm = range.empty() ? move.tempo_bpm : range.front();
  move.fastest_bpm = range.empty() ? move.tempo_bpm : range.back();
  if (range.empty()) return;
  if (range.size() != 2 || move.tempo_bpm < range[0] || move.tempo_bpm > range[1]) {
    fields.Complain(
        fields.Raw("tempo_range_bpm")->place,
        fmt::format("'tempo_range_bpm' must be [slowest, fastest] with the move's {} between them", move.tempo_bpm));
  }
}

/// The move with its curves made of its poses, at its tempo.
Result<Move> WithCurves(Move move, MoveCurves::Style style, const Place& place) {
  style.beat_seconds = 60 / move.tempo_bpm;
  RETURN_IF_ERROR(CheckJumps(move.poses, move.beats, style.beat_seconds, place));
  move.curves = MoveCurves(move.poses, move.beats, style);
  return move;
}

Result<Move> WithMotion(Result<Move> move) {
  if (move) move->motion = MotionOf(*move);
  return move;
}

/// The move of a choreography file, without its motion.
Result<Move> ParseCurves(std::string_view yaml, const std::string& file) {
  ASSIGN_OR_RETURN(const auto document, ParseYaml(yaml, file));

  Fields fields(document, "a choreography file");
  const bool is_act = document.Find("act") != nullptr;
  Move move;
  move.name = fields.RequiredText(is_act ? "act" : "move");
  move.tempo_bpm = fields.Number("tempo_bpm", 120, kTempoRange);
  ReadTempoRange(fields, move);
  move.beats = fields.Number("beats", 8, {1, 64});
  const bool mirrored = fields.Boolean("second_half_mirrored", false);
  // Nobody is asked to do an act right, so acts have no key poses.
  if (is_act) move.loops = fields.Boolean("loops", true);
  const MoveCurves::Style style = {.overlap_beats = fields.Number("overlap_beats", 0.1, {0, 0.5}),
                                   .bounce = 0.01 * fields.Number("bounce_cm", 0, {0, 20}),
                                   .loops = move.loops};
  Node nothing;
  nothing.place = document.place;
  const Node* poses = fields.Raw("poses");
  const Node* key_poses = is_act ? nullptr : fields.Raw("key_poses");
  RETURN_IF_ERROR(fields.Finish());

  const double authored_beats = mirrored ? 0.5 * move.beats : move.beats;
  ASSIGN_OR_RETURN(auto keys, ReadPoses(poses ? *poses : nothing, authored_beats));
  if (mirrored) AppendMirrorImage(keys, authored_beats);
  if (!is_act) {
    ASSIGN_OR_RETURN(auto targets, ReadKeyPoses(key_poses ? *key_poses : nothing, move.beats));
    move.key_poses = std::move(targets);
  }
  move.poses = std::move(keys);
  return WithCurves(std::move(move), style, document.place);
}

}  // namespace

Result<Move> ParseMove(std::string_view yaml, const std::string& file) { return WithMotion(ParseCurves(yaml, file)); }

Result<Move> CurvesAtTempo(const Move& move, double tempo_bpm, const Place& place) {
  Move other = move;
  other.tempo_bpm = tempo_bpm;
  return WithCurves(std::move(other), move.curves.style(), place);
}

Result<Move> AtTempo(const Move& move, double tempo_bpm, const Place& place) {
  return WithMotion(CurvesAtTempo(move, tempo_bpm, place));
}

BodyMotion MotionOf(const Move& move) {
  const double seconds = move.beats * 60.0 / move.tempo_bpm;
  const auto steps = static_cast<int>(std::lround(seconds * kJudgedRateHz));
  // The frame after a loop's last one is its first; what does not loop ends in its last pose.
  const int frames = move.loops ? steps : steps + 1;
  BodyMotion motion;
  motion.poses.reserve(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) motion.poses.push_back(PoseOf(move.curves.At(move.beats * i / steps)));
  return motion;
}

std::vector<std::string> BuiltinMoveNames() { return NamesOf(BuiltinMoveFiles(), StemOf); }
std::vector<std::string> BuiltinActNames() { return NamesOf(BuiltinActFiles(), StemOf); }

Result<Move> LoadBuiltinMove(const std::string& name) {
  const bool is_slow = name.starts_with(kSlowDemonstrationPrefix);
  const std::string authored = name.substr(is_slow ? kSlowDemonstrationPrefix.size() : 0);
  if (!is_slow || FindByName(BuiltinMoveFiles(), authored, StemOf) == nullptr) return WithMotion(LoadBuiltinCurves(name));
  const Result<Move> move = WithMotion(LoadBuiltinCurves(authored));
  return move ? SlowDemonstration(*move) : move;
}

Result<Move> LoadBuiltinCurves(const std::string& name) {
  if (const EmbeddedText* file = FindByName(BuiltinMoveFiles(), name, StemOf)) {
    return ParseCurves(file->text, "scenarios/choreography/moves/" + std::string(file->name));
  }
  if (const EmbeddedText* file = FindByName(BuiltinActFiles(), name, StemOf)) {
    return ParseCurves(file->text, "scenarios/choreography/acts/" + std::string(file->name));
  }
  std::vector<std::string> known = BuiltinMoveNames();
  std::ranges::copy(BuiltinActNames(), std::back_inserter(known));
  return Fail({}, "{}", UnknownName("move", name, known));
}

}  // namespace etude
