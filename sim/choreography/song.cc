#include "sim/choreography/song.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "engine/base/angles.h"
#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/base/smoothstep.h"
#include "engine/document/fields.h"
#include "sim/choreography/builtin_files.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

Controls Waiting(double beat) {
  constexpr double kGive = 0.015;  // how far the hips sink, because the knees bend on every beat; metres
  Controls waiting = ReadyStance();
  waiting[MiddleControl::kHipsDrop] += kGive * 0.5 * (1 - std::cos(2 * kPi * beat));
  return waiting;
}

/// Returns the time of a clock that stands still until -`lead`, accelerates, and runs with the music from 0 on.
double StartingClock(double time, double lead) {
  if (time >= 0) return time;
  const double t = std::max(time, -lead) + lead;
  return 0.5 * (t * t / lead - lead);
}

/// Returns the time of a turn (the beats in which one dancer performs a move) on the turn's own clock, beats. It runs
/// with the music within the turn, accelerates in the blend before it, and stops in the blend after it. Therefore
/// blends cut off no gesture.
double ClockOf(const Turn& turn, double beat) {
  const double since = beat - turn.start_beat;
  if (since > turn.beats) return turn.beats - StartingClock(turn.beats - since, kBlendBeatsAfter);
  return StartingClock(since, kBlendBeatsBefore);
}

Controls TurnAt(const Turn& turn, double beat) {
  const double clock = ClockOf(turn, beat);
  return turn.move ? turn.move->curves.At(turn.pace * clock) : Waiting(clock);
}

/// Returns true if the control changes the place of a foot on the floor. Raising the heel does not, because the toes
/// stay in place.
bool MovesAFoot(SideControl control) { return control >= SideControl::kLegFree && control != SideControl::kFootHeel; }

constexpr std::size_t kMinMoves = 8, kMaxMoves = 12;
constexpr double kMaxSeconds = 600;
/// The number of beats for which the dancer waits before the first part and stands after the last part.
constexpr double kLeadBeats = 4;
constexpr double kHalfTimePace = 0.5;

double PaceOf(const SongPart& part) { return part.half_time ? kHalfTimePace : 1; }

/// Returns the curves of the part's move at the music's tempo. Fails if the tempo does not suit the move.
Result<Move> MoveOf(const SongPart& part, double tempo_bpm, const Place& place) {
  if (FindByName(BuiltinMoveFiles(), part.move, StemOf) == nullptr) {
    return Fail(place, "{}", UnknownName("move", part.move, BuiltinMoveNames()));
  }
  auto move = LoadBuiltinCurves(part.move);
  if (!move) return move;
  const double danced_bpm = PaceOf(part) * tempo_bpm;
  if (danced_bpm < move->slowest_bpm || danced_bpm > move->fastest_bpm) {
    return Fail(place, "'{}' would be danced at {} beats per minute; allowed: {} to {}{}", part.move, danced_bpm,
                move->slowest_bpm, move->fastest_bpm, part.half_time ? "" : " ('half_time: true' halves the tempo)");
  }
  return CurvesAtTempo(*move, danced_bpm, place);
}

Result<SongPart> ReadPart(const Node& item) {
  Fields fields(item, "a part of a song");
  SongPart part;
  part.move = fields.RequiredText("move");
  part.times = fields.Integer("times", 2, {2, 32});
  part.half_time = fields.Boolean("half_time", false);
  RETURN_IF_ERROR(fields.Finish());
  return part;
}

/// Reads the parts and places them one after the other, from beat `kLeadBeats` of the music on. `moves` receives each
/// part's move.
Result<std::vector<SongPart>> ReadParts(const Node& parts, double tempo_bpm, std::vector<Move>& moves) {
  std::vector<SongPart> read;
  std::set<std::string> names;
  double beat = kLeadBeats;
  for (const Node& item : parts.items) {
    // Read the part, and place it after the previous part.
    ASSIGN_OR_RETURN(auto part, ReadPart(item));
    ASSIGN_OR_RETURN(auto move, MoveOf(part, tempo_bpm, item.Find("move")->place));
    part.start_beat = beat;
    part.beats = part.times * move.beats / PaceOf(part);
    beat += part.beats;
    // Check that the song up to this part is not too long.
    const double seconds = (beat + kLeadBeats) * 60 / tempo_bpm;
    if (seconds > kMaxSeconds) {
      return Fail(item.place, "with this part, the song lasts {:.0f} s; allowed: at most {} s", seconds, kMaxSeconds);
    }
    names.insert(part.move);
    read.push_back(std::move(part));
    moves.push_back(std::move(move));
  }
  // Check the number of different moves.
  if (names.size() < kMinMoves || names.size() > kMaxMoves) {
    return Fail(parts.place, "found {} different moves; allowed: {} to {}", names.size(), kMinMoves, kMaxMoves);
  }
  return read;
}

std::vector<Turn> TurnsOf(std::span<const SongPart> parts, std::span<const Move> moves) {
  std::vector<Turn> turns = {{.start_beat = 0, .beats = kLeadBeats}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    turns.push_back({parts[i].start_beat, parts[i].beats, &moves[i], PaceOf(parts[i])});
  }
  turns.push_back({.start_beat = turns.back().start_beat + turns.back().beats, .beats = kLeadBeats});
  return turns;
}

double BeatsPerFrame(const Song& song) { return song.tempo_bpm / 60 / kJudgedRateHz; }

/// Returns the beat at which the song ends: the dancer stands for `kLeadBeats` after the last part.
double LastBeatOf(const Song& song) { return song.parts.back().start_beat + song.parts.back().beats + kLeadBeats; }

BodyMotion MotionOf(const Song& song, std::span<const Turn> turns) {
  const double last_beat = LastBeatOf(song);
  const double beats_per_frame = BeatsPerFrame(song);
  const std::size_t frames = song.CountFrames();
  BodyMotion motion;
  motion.poses.reserve(frames);
  for (std::size_t i = 0; i < frames; ++i) {
    const double beat = std::min(static_cast<double>(i) * beats_per_frame, last_beat);
    motion.poses.push_back(PoseOf(SequenceAt(turns, beat)));
  }
  return motion;
}

std::vector<MusicTag> TagsOf(const Song& song) {
  std::vector<MusicTag> tags;
  for (const SongPart& part : song.parts) {
    for (int i = 0; i < part.times; ++i) {
      const double music_s = (part.start_beat + i * part.beats / part.times) * 60 / song.tempo_bpm;
      tags.push_back({static_cast<std::size_t>(std::lround(music_s * kJudgedRateHz)), music_s});
    }
  }
  return tags;
}

/// Reads a song without its tags and motion; `moves` receives the move of each part.
Result<Song> ParseOutline(std::string_view yaml, const std::string& file, std::optional<double> tempo_bpm,
                          std::vector<Move>& moves) {
  ASSIGN_OR_RETURN(const auto document, ParseYaml(yaml, file));

  Fields fields(document, "a song");
  Song song;
  song.name = fields.RequiredText("song");
  song.tempo_bpm = fields.Number("tempo_bpm", 120, {40, 240});
  if (tempo_bpm) song.tempo_bpm = *tempo_bpm;
  const Node* parts = fields.Raw("parts");
  RETURN_IF_ERROR(fields.Finish());
  if (parts == nullptr || parts->kind != Node::Kind::kSequence) {
    return Fail(parts ? parts->place : document.place, "'parts' must be a list of moves, found {}",
                parts ? Describe(*parts) : "nothing");
  }

  ASSIGN_OR_RETURN(auto read, ReadParts(*parts, song.tempo_bpm, moves));
  song.parts = std::move(read);
  return song;
}

std::string PathOf(const EmbeddedText& file) { return "scenarios/choreography/songs/" + std::string(file.name); }

Result<const EmbeddedText*> FindSongFile(const std::string& name) {
  const EmbeddedText* file = FindByName(BuiltinSongFiles(), name, StemOf);
  if (file == nullptr) return Fail({}, "{}", UnknownName("song", name, BuiltinSongNames()));
  return file;
}

}  // namespace

Controls SequenceAt(std::span<const Turn> turns, double beat) {
  assert(!turns.empty());
  // Find the turn that contains the beat. Outside the blends, only this turn is danced.
  const auto after = std::ranges::upper_bound(turns.begin() + 1, turns.end(), beat, {}, &Turn::start_beat);
  const Turn& now = *(after - 1);
  const Controls dancing = TurnAt(now, beat);
  const bool is_leaving = after != turns.end() && beat > after->start_beat - kBlendBeatsBefore;
  const bool is_arriving = &now != &turns.front() && beat < now.start_beat + kBlendBeatsAfter;
  if (!is_leaving && !is_arriving) return dancing;

  // Blend the two turns.
  const Turn& next = is_leaving ? *after : now;
  const double since = beat - (next.start_beat - kBlendBeatsBefore);
  const double share = Smootherstep(since / (kBlendBeatsBefore + kBlendBeatsAfter));
  Controls mixed = Mix(TurnAt(*(&next - 1), beat), TurnAt(next, beat), share);
  // Take the feet from the current turn.
  for (Side side : {Side::kLeft, Side::kRight}) {
    for (std::size_t i = 0; i < kSideControlCount; ++i) {
      const auto control = static_cast<SideControl>(i);
      if (MovesAFoot(control)) mixed.Of(side, control) = dancing.Of(side, control);
    }
  }
  return mixed;
}

std::size_t Song::CountFrames() const {
  return static_cast<std::size_t>(std::ceil(LastBeatOf(*this) / BeatsPerFrame(*this) - 1e-9)) + 1;
}

Result<Song> ParseSong(std::string_view yaml, const std::string& file, std::optional<double> tempo_bpm) {
  std::vector<Move> moves;
  ASSIGN_OR_RETURN(Song song, ParseOutline(yaml, file, tempo_bpm, moves));
  song.motion = MotionOf(song, TurnsOf(song.parts, moves));
  song.tags = TagsOf(song);
  return song;
}

std::vector<std::string> BuiltinSongNames() { return NamesOf(BuiltinSongFiles(), StemOf); }

Result<Song> LoadBuiltinSong(const std::string& name, std::optional<double> tempo_bpm) {
  ASSIGN_OR_RETURN(const EmbeddedText* file, FindSongFile(name));
  return ParseSong(file->text, PathOf(*file), tempo_bpm);
}

Result<Song> LoadBuiltinSongOutline(const std::string& name) {
  ASSIGN_OR_RETURN(const EmbeddedText* file, FindSongFile(name));
  std::vector<Move> moves;
  return ParseOutline(file->text, PathOf(*file), {}, moves);
}

}  // namespace etude
