#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "engine/coaching/policy.h"
#include "engine/formats/wav.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recognisers.h"
#include "engine/streams/recording.h"
#include "engine/teaching/moves_file.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"
#include "io/files/files.h"
#include "sim/choreography/dance_of.h"
#include "sim/music/music.h"
#include "tools/live_coach.h"

namespace etude {
namespace {

struct CoachCommandOptions {
  std::string song;    ///< the name of a built-in song, or a song file
  std::string stream;  ///< a file of skeleton rows; "-": standard input
  /// A moves file from which the recogniser learns the song's moves, "" = the built-in moves.
  std::string moves;
  /// A file with the times of the music's beats, "" = evenly spaced beats at the song's tempo.
  std::string beats;
  std::string click;              ///< a WAV to write, "" = none
  std::string format;             ///< the stream's format, "" = recognised by content
  std::optional<double> rate_hz;  ///< frame rate of streams without a clock
  std::string recogniser;         ///< a name of RecogniserNames(); "" = the recommended recogniser
  /// Minimum evidence for the verdict "right"; default: the recogniser's own threshold.
  std::optional<double> right_from;
  std::string policy = "at-first-mistake";
  std::string choice = "played";
  std::string join = "planted-feet";
  std::string filter = "none";
  std::string up;        ///< the axis of the stream that points up: "y", "z" or "" (not stated)
  bool mirror = false;   ///< true: players mirror the coach
  bool reflect = false;  ///< true: the stream is mirrored, so X is negated
  bool now = false;      ///< true: the coach begins to dance without waiting for a clap
  bool brief = false;    ///< true: frames without a decision are left out
  bool timing = false;   ///< true: processing times of frames are printed at the end
  bool overwrite = false;
};

constexpr const char* kCoachText =
    "\n"
    "Reads a device's skeletons line by line, and writes, as one JSON object per line, what a screen should show. The "
    "first\n"
    "object describes the song, its moves and their key poses; then each frame has an object (docs/coach.md explains "
    "all\n"
    "keys). The coach waits for a clap, dances, and judges every performance. The option --policy sets when the coach\n"
    "interrupts the dance: it shakes its head, waves or is puzzled, shows the move slowly, and returns to the dance.\n"
    "Scenarios with `task: coach` test this coach.\n\n"
    "The input rows have the CSV format that `etude clip convert` writes, or a Kinect's format (docs/streams.md). Your "
    "own\n"
    "program plays the music: the key \"music\" of a frame states from which time to play it, and when to stop. A "
    "line\n"
    "'#music 12.34' in the input tells the coach the current time of the music, in seconds. The coach then dances "
    "slower or\n"
    "faster to stay with the music.";

/// A dance, and its moves in the form in which recognisers learn them, in the order of the dance.
struct Lesson {
  Dance dance;
  std::vector<TaughtMove> taught;
};

Result<Song> LoadSong(const std::string& name, std::optional<double> tempo_bpm) {
  if (!name.ends_with(".yaml")) return LoadBuiltinSong(name, tempo_bpm);
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(name));
  return ParseSong(text, name, tempo_bpm);
}

/// Replaces the built-in definitions of moves by the definitions in a moves file. Fails if the file defines a move that
/// the dance does not have.
Result<void> TeachMoves(const std::string& path, std::vector<TaughtMove>& taught) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  ASSIGN_OR_RETURN(auto moves, ReadMoves(text, path));
  for (TaughtMove& move : moves) {
    const auto danced = std::ranges::find(taught, move.name, &TaughtMove::name);
    if (danced == taught.end()) {
      std::string names;
      for (const TaughtMove& known : taught) names += (names.empty() ? "" : ", ") + known.name;
      return Fail({path}, "found the move '{}', which is not in this song; allowed: {}", move.name, names);
    }
    *danced = std::move(move);
  }
  return {};
}

Result<Lesson> LoadLesson(const CoachCommandOptions& options) {
  std::vector<double> beats;
  std::optional<double> tempo_bpm;
  if (!options.beats.empty()) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(options.beats));
    ASSIGN_OR_RETURN(beats, ReadBeats(text, options.beats));
    tempo_bpm = TempoOf(beats);
  }
  ASSIGN_OR_RETURN(const auto song, LoadSong(options.song, tempo_bpm));
  Lesson lesson;
  ASSIGN_OR_RETURN(lesson.dance, DanceOf(song));
  if (tempo_bpm) {
    ASSIGN_OR_RETURN(lesson.dance, ToBeats(std::move(lesson.dance), beats));
  }
  ASSIGN_OR_RETURN(const auto moves, MovesOf(song));
  for (const Move& move : moves) lesson.taught.push_back(TaughtOf(move));
  if (!options.moves.empty()) RETURN_IF_ERROR(TeachMoves(options.moves, lesson.taught));
  return lesson;
}

Result<void> WriteClicks(const CoachCommandOptions& options, const Dance& dance) {
  if (options.click.empty()) return {};
  RETURN_IF_ERROR(CheckOutput(options.click, options.overwrite, ".wav"));
  constexpr int kRate = 44100;
  const std::vector<double>& beats = dance.beats_s;
  RETURN_IF_ERROR(WriteFileAtomically(options.click, WriteWav(ClickTrack(beats, beats.back() + 1, kRate), kRate)));
  TellWritten(options.click, stderr);
  return {};
}

void TellTiming(std::vector<double> times_ms) {
  if (times_ms.empty()) return;
  std::ranges::sort(times_ms);
  const auto at = [&](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  fmt::print(stderr, "{} frames; ms per frame: median {:.3f}, p99 {:.3f}, largest {:.3f}\n", times_ms.size(), at(0.5),
             at(0.99), times_ms.back());
}

void PrintLine(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

Result<int> CoachCommand(const CoachCommandOptions& options) {
  // Load the song, and teach the recogniser the song's moves.
  ASSIGN_OR_RETURN(auto lesson, LoadLesson(options));
  RETURN_IF_ERROR(WriteClicks(options, lesson.dance));
  const RecogniserKind* kind = options.recogniser.empty() ? &RecommendedRecogniser(lesson.taught, /*by_a_coach=*/true)
                                                          : FindRecogniser(options.recogniser);
  ASSIGN_OR_RETURN(const auto recogniser, MakeRecogniser({.kind = kind}, lesson.taught));
  // Plan the transitions between all clips of the dance.
  ASSIGN_OR_RETURN(const auto library, DanceLibrary::Make(std::move(lesson.dance)));
  const DanceTransitions transitions(library, {.choice = FindChoice(options.choice), .join = FindJoin(options.join)});
  const bool is_live = options.stream == "-";
  LiveCoachOptions coach{.policy = options.policy,
                         .filter = options.filter,
                         .dances_at_once = options.now,
                         .plans_ahead = is_live,
                         .brief = options.brief};
  coach.coach.right_from = options.right_from.value_or(kind->threshold);
  coach.coach.player_mirrors = options.mirror;
  // Open the stream.
  std::ifstream file;
  if (!is_live) {
    file.open(options.stream);
    if (!file || std::filesystem::is_directory(options.stream)) return Fail({options.stream}, "cannot be read");
  }
  // Print the head (the song, its moves and their key poses), then one line for each frame.
  ASSIGN_OR_RETURN(const auto head, CoachHead(library.dance()));
  fmt::print("{}\n", head);
  StreamReading reading{.rate_hz = options.rate_hz};
  if (!options.format.empty()) reading.format = FindStreamFormat(options.format);
  LiveStream stream(is_live ? "the stream" : options.stream, reading,
                    {.reflects = options.reflect, .up = UpAxisOf(options.up)});
  coach.on_remark = [&](const std::string& remark) { fmt::print(stderr, "{}\n", remark); };
  LiveCoach live(transitions, *recogniser, coach, PrintLine);
  RETURN_IF_ERROR(live.Follow(is_live ? std::cin : file, stream));
  if (options.timing) TellTiming(live.times_ms());
  return kSuccess;
}

}  // namespace

void DefineCoach(CLI::App& app, Action& action) {
  auto options = std::make_shared<CoachCommandOptions>();
  CLI::App* command = app.add_subcommand("coach", "Coach a dancing person live, from a stream of skeletons");
  // Define the song, the stream, and the facts about the music.
  command->add_option("song", options->song, "A built-in song (see `etude list clips`), or a song file (.yaml)")
      ->required();
  command->add_option("--stream", options->stream, "A file of skeleton rows; -: live from standard input")->required();
  command->add_option("--moves", options->moves,
                      "A moves file with correct performances of the song's moves (`etude teach` writes such a file)");
  command->add_option("--beats", options->beats,
                      "A text file with the times of the music's beats, in seconds, one per line");
  command->add_option("--click", options->click, "Also write an audio file with a click for every beat (.wav)");
  // Define how performances are judged, and how the coach reacts.
  command
      ->add_option("--recogniser", options->recogniser,
                   "The recogniser that judges performances (default: coached; key-pose if a move has no example)")
      ->check(OneOf(RecogniserNames()));
  command
      ->add_option("--right-from", options->right_from,
                   "Lowest evidence at which a performance counts as right (default: the recogniser's value)")
      ->check(NumberWithin(0.001, 1, "level of evidence"));
  command->add_option("--policy", options->policy, "When the coach interrupts")->check(OneOf(LivePolicyNames()));
  command->add_option("--choice", options->choice, "The rule that chooses the frames of a transition")
      ->check(OneOf(ChoiceNames()));
  command->add_option("--join", options->join, "The method that joins the two clips at these frames")
      ->check(OneOf(JoinNames()));
  command->add_option("--filter", options->filter, "Filter that smooths the skeletons")->check(OneOf(FilterNames()));
  // Define how players dance, and how frames are read and printed.
  command->add_flag("--mirror", options->mirror,
                    "Expect people to mirror the coach: they move their right side when the coach moves its left side");
  command->add_flag("--now", options->now, "Start the dance at once, without waiting for a clap");
  command->add_flag("--brief", options->brief, "Write no body poses, and no frames without a decision");
  command->add_flag("--timing", options->timing, "Print the processing times of frames at the end");
  command->add_option("--format", options->format, "Format of the stream (default: detected from the content)")
      ->check(OneOf(StreamFormatNames()));
  command->add_option("--rate", options->rate_hz, "Frame rate of a stream without times, in Hz (default: 30)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command->add_flag("--reflect", options->reflect, "Negate X, for a mirrored stream");
  command->add_option("--up", options->up, "Axis of a CSV stream that points up: y or z (default: y)")
      ->check(OneOf({"y", "z"}));
  AddOverwrite(*command, options->overwrite);
  command->footer(kCoachText);
  command->callback([=, &action] { action = [=] { return Finish(CoachCommand(*options)); }; });
}

}  // namespace etude
