#include "cli/coach_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <vector>

#include "bench/files/files.h"
#include "bench/process/clock.h"
#include "bench/tasks/detection/world.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "engine/coaching/session.h"
#include "engine/formats/wav.h"
#include "engine/recognition/recognisers.h"
#include "engine/streams/live_stream.h"
#include "engine/teaching/moves_file.h"
#include "reports/coach/coach_lines.h"
#include "sim/choreography/dance_of.h"
#include "sim/music/music.h"

namespace etude {
namespace {

/// The dance, and the moves that recognisers are taught, in its order.
struct Lesson {
  Dance dance;
  std::vector<TaughtMove> taught;
};

Result<Song> LoadSong(const std::string& name, std::optional<double> tempo_bpm) {
  if (!name.ends_with(".yaml")) return LoadBuiltinSong(name, tempo_bpm);
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(name));
  return ParseSong(text, name, tempo_bpm);
}

/// Has a moves file say what those of the dance's moves look like that it teaches.
Result<void> TeachMoves(const std::string& path, std::vector<TaughtMove>& taught) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  ASSIGN_OR_RETURN(auto moves, ReadMoves(text, path));
  for (TaughtMove& move : moves) {
    const auto danced = std::ranges::find(taught, move.name, &TaughtMove::name);
    if (danced == taught.end()) {
      std::string names;
      for (const TaughtMove& known : taught) names += (names.empty() ? "" : ", ") + known.name;
      return Fail({path}, "teaches '{}', which this song does not dance; it dances: {}", move.name, names);
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
  RETURN_IF_ERROR(CheckOutput(options.click, options.overwrite));
  constexpr int kRate = 44100;
  const std::vector<double>& beats = dance.beats_s;
  RETURN_IF_ERROR(WriteFileAtomically(options.click, WriteWav(ClickTrack(beats, beats.back() + 1, kRate), kRate)));
  TellWritten(options.click, stderr);
  return {};
}

/// Where the music is: as a line '#music 12.34' of the stream tells, else as it was told to play.
class MusicHeard {
 public:
  void Follow(const MusicCommand& command) {
    if (command.kind == MusicCommand::Kind::kPause) now_s_.reset();
    if (command.kind == MusicCommand::Kind::kPlayFrom) now_s_ = command.music_s;
  }
  void Tick() {
    if (now_s_) *now_s_ += 1 / kJudgedRateHz;
  }
  std::optional<double> Now() const { return now_s_; }

  /// True when the line is about music.
  Result<bool> Take(std::string_view line, int number) {
    constexpr std::string_view kWord = "#music";
    if (!line.starts_with(kWord)) return false;
    line.remove_prefix(std::min(line.find_first_not_of(" \t", kWord.size()), line.size()));
    double seconds = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), seconds);
    if (error != std::errc() || !(seconds >= 0 && seconds < 1e6)) {
      return Fail({"the stream", number, 1}, "'#music' tells seconds into the song, as '#music 12.34'");
    }
    if (now_s_) now_s_ = seconds;
    return true;
  }

 private:
  std::optional<double> now_s_;  // nothing while it is silent
};

/// A session fed frame by frame: begins with the first one, when it is known where its sensor stands.
class LiveCoach {
 public:
  LiveCoach(const CoachCommandOptions& options, const DanceTransitions& transitions, const Recogniser& recogniser,
            const CoachOptions& coach_options)
      : options_(options), transitions_(transitions), recogniser_(recogniser), coach_options_(coach_options) {}

  Result<void> Take(const SensedFrame& frame, const StreamRecording& meaning) {
    if (!session_) Begin(meaning);
    const auto begin = Clock::now();
    music_.Tick();
    const CoachOutput output = session_->Next(frame, {.music_s = music_.Now()});
    music_.Follow(output.music);
    const bool is_news = !output.records.empty() || output.music.kind != MusicCommand::Kind::kNone;
    if (!options_.brief || is_news) {
      ASSIGN_OR_RETURN(const auto line, CoachLine(output, frame_, transitions_.dance(), options_.brief));
      fmt::print("{}\n", line);
      std::fflush(stdout);
    }
    ++frame_;
    times_ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - begin).count());
    return {};
  }

  MusicHeard& music() { return music_; }

  void TellTiming() {
    if (times_ms_.empty()) return;
    std::ranges::sort(times_ms_);
    const auto at = [&](double share) {
      return times_ms_[static_cast<std::size_t>(share * static_cast<double>(times_ms_.size() - 1))];
    };
    fmt::print(stderr, "{} frames; ms a frame: median {:.3f}, p99 {:.3f}, largest {:.3f}\n", times_ms_.size(), at(0.5),
               at(0.99), times_ms_.back());
  }

 private:
  void Begin(const StreamRecording& meaning) {
    // A device's space begins where it stands; Etude's own does not tell.
    if (!meaning.is_level) coach_options_.sensor = {0, 0, 0};
    coach_ =
        std::make_unique<Coach>(transitions_, coach_options_, Coach::PolicyChoice{FindPolicy(options_.policy), {}});
    if (options_.stream == "-") coach_->PlanAhead();
    session_.emplace(
        CoachSession::Parts{
            .coach = coach_.get(), .recogniser = &recogniser_, .filter = {.kind = FilterOf(options_.filter)}},
        options_.now ? coach_->BeginDancing() : coach_->Begin());
  }

  const CoachCommandOptions& options_;
  const DanceTransitions& transitions_;
  const Recogniser& recogniser_;
  CoachOptions coach_options_;
  std::unique_ptr<Coach> coach_;
  std::optional<CoachSession> session_;
  MusicHeard music_;
  std::int64_t frame_ = 0;
  std::vector<double> times_ms_;
};

/// Reads the stream to its end.
Result<void> Follow(std::istream& stream, const CoachCommandOptions& options, LiveCoach& coach) {
  StreamReading reading;
  if (!options.format.empty()) reading.format = FindStreamFormat(options.format);
  reading.rate_hz = options.rate_hz;
  LiveStream live(options.stream == "-" ? "the stream" : options.stream, reading, {.reflects = options.reflect});
  std::vector<SensedFrame> frames;
  std::string line;
  const auto pass_on = [&]() -> Result<void> {
    for (const SensedFrame& frame : frames) RETURN_IF_ERROR(coach.Take(frame, *live.Meaning()));
    frames.clear();
    return {};
  };
  for (int number = 1; std::getline(stream, line); ++number) {
    RETURN_IF_ERROR(coach.music().Take(line, number));
    RETURN_IF_ERROR(live.Take(line, frames));
    RETURN_IF_ERROR(pass_on());
  }
  RETURN_IF_ERROR(live.Finish(frames));
  return pass_on();
}

Result<void> RunCoach(const CoachCommandOptions& options) {
  ASSIGN_OR_RETURN(auto lesson, LoadLesson(options));
  RETURN_IF_ERROR(WriteClicks(options, lesson.dance));
  const RecogniserKind* kind = FindRecogniser(options.recogniser);
  ASSIGN_OR_RETURN(const auto recogniser, MakeRecogniser({.kind = kind}, lesson.taught));
  ASSIGN_OR_RETURN(const auto library, DanceLibrary::Make(std::move(lesson.dance)));
  const DanceTransitions transitions(library, {.choice = FindChoice(options.choice), .join = FindJoin(options.join)});
  CoachOptions coach_options;
  coach_options.right_from = options.right_from.value_or(kind->threshold);
  coach_options.player_mirrors = options.mirror;
  std::ifstream file;
  if (options.stream != "-") {
    file.open(options.stream);
    if (!file || std::filesystem::is_directory(options.stream)) return Fail({options.stream}, "cannot be read");
  }
  ASSIGN_OR_RETURN(const auto head, CoachHead(library.dance()));
  fmt::print("{}\n", head);
  LiveCoach live(options, transitions, *recogniser, coach_options);
  RETURN_IF_ERROR(Follow(options.stream == "-" ? std::cin : file, options, live));
  if (options.timing) live.TellTiming();
  return {};
}

}  // namespace

int CoachCommand(const CoachCommandOptions& options) {
  const auto done = RunCoach(options);
  return done ? kSuccess : Complain(done.error());
}

}  // namespace etude
