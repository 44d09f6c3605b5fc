#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/tasks/detection/label_scores.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/stream_reading.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recognisers.h"
#include "engine/streams/live_stream.h"
#include "engine/teaching/equal_streams.h"
#include "engine/teaching/moves_file.h"
#include "io/files/files.h"

namespace etude {
namespace {

struct RecogniseCommandOptions {
  std::vector<std::string> streams;  ///< a single "-" = standard input, live
  std::string moves;
  std::string labels;
  std::string recogniser;  ///< a name of RecogniserNames(); "" = the recommended recogniser
  std::string filter = "none", weights = "fixed";
  std::optional<double> threshold;
  std::vector<std::string> settings;  ///< entries like "tolerance_scale=1.2"
  bool leave_one_person_out = false;
  bool as_json = false;
  StreamArguments reading;
};

constexpr const char* kRecogniseText =
    "\n"
    "Prints a line of JSON as soon as a move is recognised. With --labels, the command also scores the recogniser: "
    "for\n"
    "performances, whether it judges them right or wrong as the labels do; for action points, whether it finds a move\n"
    "within 333 ms. With --leave-one-person-out, each person's moves are recognised by a recogniser that learnt from "
    "all\n"
    "other people. Formats of recordings: rows of Kinect v1 and v2, MSRC-12, UTKinect, NTU, Azure Kinect, CSV, TRC. "
    "Rows\n"
    "and CSV can also be read live from standard input (docs/streams.md).\n";

/// Reads settings such as "tolerance_scale=1.2"; all other settings keep their defaults. Fails for unknown settings and
/// values out of range.
Result<std::vector<double>> ReadSettings(const RecogniserKind& kind, const std::vector<std::string>& given) {
  std::vector<double> values;
  std::vector<std::string> names;
  for (const NumberSetting& setting : kind.settings) {
    values.push_back(setting.fallback);
    names.push_back(setting.key);
  }
  for (const std::string& text : given) {
    const std::size_t at = std::min(text.find('='), text.size());
    const auto found = std::ranges::find(names, text.substr(0, at));
    if (found == names.end()) {
      return Fail({"--set"}, "{}", UnknownName("setting of " + kind.name, text.substr(0, at), names));
    }
    const auto i = static_cast<std::size_t>(found - names.begin());
    const auto value = ParseNumber<double>(std::string_view(text).substr(std::min(at + 1, text.size())));
    const NumberSetting& setting = kind.settings[i];
    if (!value || !(*value >= setting.lowest && *value <= setting.largest)) {
      return Fail({"--set"}, "{}; allowed: {} to {}", Quote(text), setting.lowest, setting.largest);
    }
    values[i] = *value;
  }
  return values;
}

/// Returns the options for recognition, with the requested recogniser. If none is requested, takes `recommended` and
/// prints a note about this choice.
Result<WatchOptions> OptionsOf(const RecogniseCommandOptions& options, const RecogniserKind& recommended) {
  WatchOptions watch;
  watch.recogniser.kind = options.recogniser.empty() ? &recommended : FindRecogniser(options.recogniser);
  if (options.recogniser.empty()) {
    fmt::print(
        stderr,
        "using the recogniser {}, which is recommended for these moves; --recogniser selects another recogniser\n",
        recommended.name);
  }
  ASSIGN_OR_RETURN(watch.recogniser.settings, ReadSettings(*watch.recogniser.kind, options.settings));
  if (options.weights == "adaptive") watch.recogniser.weights.weighting = Weighting::kAdaptive;
  watch.filter.kind = FilterOf(options.filter);
  watch.decision.threshold = options.threshold.value_or(watch.recogniser.kind->threshold);
  return watch;
}

/// The taught moves, a recogniser for these moves, and the recogniser's options.
struct Taught {
  std::vector<TaughtMove> moves;
  WatchOptions watch;
  std::unique_ptr<Recogniser> recogniser;
};

Result<Taught> LoadTaught(const RecogniseCommandOptions& options) {
  ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(options.moves));
  Taught taught;
  ASSIGN_OR_RETURN(taught.moves, ReadMoves(text, options.moves));
  ASSIGN_OR_RETURN(taught.watch, OptionsOf(options, RecommendedRecogniser(taught.moves)));
  auto made = MakeRecogniser(taught.watch.recogniser, taught.moves);
  if (!made) return Fail({options.moves}, "{}", made.error().message);
  taught.recogniser = *std::move(made);
  return taught;
}

void PrintSpotting(const Spotting& spotting, const Taught& taught, double rate_hz, const std::string& stream) {
  fmt::print("{}\n", SpottingLine(spotting, taught.moves[spotting.move].name, rate_hz, stream));
  std::fflush(stdout);
}

void TellNothing() { fmt::print(stderr, "no move was recognised\n"); }

/// Recognises moves in the skeletons that standard input delivers line by line, until the input ends.
Result<int> RecogniseLive(const RecogniseCommandOptions& options, const Taught& taught) {
  // Set up the reader of lines, and the watcher that recognises moves.
  const StreamOptions making = options.reading.Options();
  LiveStream live("standard input", options.reading.Reading(), making);
  StreamWatcher watcher(*taught.recogniser, taught.moves.size(), taught.watch, making.rate_hz);
  std::size_t spotted = 0;
  // Report the reader's remarks, and every move that is spotted.
  const auto take = [&](const std::vector<SensedFrame>& frames) {
    for (const std::string& remark : live.TakeRemarks()) fmt::print(stderr, "standard input: {}\n", remark);
    for (const SensedFrame& frame : frames) {
      for (const Spotting& spotting : watcher.Take(frame)) {
        ++spotted;
        PrintSpotting(spotting, taught, making.rate_hz, "");
      }
    }
  };
  // Handle the input line by line, then the frames that the reader has buffered.
  for (std::string line; std::getline(std::cin, line);) {
    std::vector<SensedFrame> frames;
    const auto taken = live.Take(line, frames);
    take(frames);
    RETURN_IF_ERROR(taken);
  }
  std::vector<SensedFrame> frames;
  const auto finished = live.Finish(frames);
  take(frames);
  RETURN_IF_ERROR(finished);
  if (spotted == 0) TellNothing();
  return kSuccess;
}

std::string Percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100 * *share) : std::string("none");
}

Result<void> Print(const LabelScores& scores, bool as_json) {
  const std::vector<JudgedEvent>& performances = scores.Performances();
  const Confusion confusion = CountConfusion(performances);
  if (scores.Untaught() > 0)
    fmt::print(stderr, "{} labels have moves that were not taught; these labels were not scored\n", scores.Untaught());
  const auto right = std::ranges::count_if(performances, &JudgedEvent::is_right);
  const auto called = std::ranges::count_if(performances, &JudgedEvent::called_right);
  if (right == 0 || right == std::ssize(performances)) {
    // Without right or without wrong performances, F1, precision and AUC are meaningless.
    fmt::print(stderr, "{} performances; according to the labels, {} are right; the recogniser judged {} right\n",
               performances.size(), right == 0 ? "none" : "all", called);
  } else {
    fmt::print(stderr, "{} performances: F1 {}, precision {}, recall {}, AUC {}\n", performances.size(),
               Percent(F1(confusion)), Percent(PrecisionOf(confusion)), Percent(RecallOf(confusion)),
               Percent(RocAuc(performances)));
  }
  if (!scores.Points().empty()) {
    fmt::print(stderr, "{} action points: mean F-score over moves {}, with a tolerance of {:.0f} ms\n",
               scores.Points().size(), Percent(scores.PointFScore()), 1000 * kActionPointTolerance);
  }
  fmt::print(stderr, "{:.2f} false alarms per minute\n", scores.FalseAlarmsAMinute());
  return as_json ? PrintFacts("recognise", FactsOf(scores)) : Result<void>();
}

Result<LoadedStreams> Load(const RecogniseCommandOptions& options) {
  ASSIGN_OR_RETURN(auto loaded, options.reading.Load(options.streams));
  for (const Error& refused : loaded.refused) fmt::print(stderr, "left out: {}\n", ToString(refused));
  constexpr std::size_t kFew = 20;
  if (loaded.streams.size() <= kFew) {
    for (const NamedStream& stream : loaded.streams)
      fmt::print(stderr, "{}\n", ToString(Error{{stream.source}, stream.description}));
  }
  return loaded;
}

Result<int> RecogniseFiles(const RecogniseCommandOptions& options, const Taught& taught) {
  ASSIGN_OR_RETURN(LoadedStreams loaded, Load(options));
  std::vector<LabelledPart> parts;
  if (!options.labels.empty()) {
    ASSIGN_OR_RETURN(parts, LoadParts(options.labels, loaded.streams));
    if (const std::size_t taught_with = CountTaught(loaded.streams, parts, taught.moves); taught_with > 0) {
      fmt::print(stderr,
                 "these moves were taught with {} of the {} performances, so the scores do not show how well Etude "
                 "recognises other performances\n",
                 taught_with, parts.size());
    }
  }
  std::map<std::string, int> named;
  for (const NamedStream& one : loaded.streams) ++named[one.name];
  std::size_t spotted = 0;
  LabelScores scores(taught.moves, *taught.recogniser, taught.watch);
  for (std::size_t s = 0; s < loaded.streams.size(); ++s) {
    const NamedStream& stream = loaded.streams[s];
    const auto spottings = Watch(stream.stream, *taught.recogniser, taught.moves.size(), taught.watch);
    spotted += spottings.size();
    const std::string name = loaded.streams.size() == 1 ? "" : named[stream.name] == 1 ? stream.name : stream.source;
    for (const Spotting& spotting : spottings) PrintSpotting(spotting, taught, stream.stream.rate_hz, name);
    std::vector<LabelledPart> own;
    std::ranges::copy_if(parts, std::back_inserter(own), [&](const LabelledPart& p) { return p.stream == s; });
    scores.Add(stream, own, spottings);
  }
  if (spotted == 0) TellNothing();
  if (!options.labels.empty()) RETURN_IF_ERROR(Print(scores, options.as_json));
  return kSuccess;
}

/// Prints the confusions between moves, the most frequent first.
void PrintMistakes(std::span<const Classified> verdicts) {
  std::map<std::pair<std::string, std::string>, int> mistakes;
  for (const Classified& verdict : verdicts) {
    if (verdict.truth != verdict.taken_for) ++mistakes[{verdict.truth, verdict.taken_for}];
  }
  std::vector<std::pair<std::pair<std::string, std::string>, int>> sorted(mistakes.begin(), mistakes.end());
  std::ranges::stable_sort(sorted, [](const auto& a, const auto& b) { return a.second > b.second; });
  constexpr std::size_t kShown = 8;
  for (std::size_t i = 0; i < std::min(kShown, sorted.size()); ++i) {
    const auto& [pair, count] = sorted[i];
    fmt::print("  {:4} {} recognised as {}\n", count, pair.first, pair.second.empty() ? "nothing" : pair.second);
  }
}

Result<int> RecogniseLeavingOneOut(const RecogniseCommandOptions& options) {
  // Several people teach each move, so the recogniser whole-body is recommended.
  ASSIGN_OR_RETURN(const WatchOptions watch, OptionsOf(options, *FindRecogniser("whole-body")));
  // Load the recordings. Classify each person's recordings with the moves that the other people taught.
  ASSIGN_OR_RETURN(LoadedStreams loaded, Load(options));
  ASSIGN_OR_RETURN(const auto parts, LoadParts(options.labels, loaded.streams));
  ASSIGN_OR_RETURN(
      const LeaveOneOut out,
      LeaveOnePersonOut(loaded.streams, parts, options.labels.empty() ? "the recordings" : options.labels, watch));
  // Print accuracy, confusions and the F-score of action points.
  StdoutToStderr people(options.as_json);
  fmt::print("{} people, {} recordings\n", out.people.size(), loaded.streams.size());
  const auto accuracy = Accuracy(out.verdicts), nearest = Accuracy(out.nearest);
  const auto f_score = MeanFScore(out.points, out.detections, kActionPointTolerance);
  if (!out.verdicts.empty()) {
    fmt::print("accuracy over {} performances, leaving one person out at a time\n  {:<28} {}\n  {:<28} {}\n",
               out.verdicts.size(), watch.recogniser.kind->name, Percent(accuracy), "1-nearest-neighbour",
               Percent(nearest));
    if (accuracy <= nearest)
      fmt::print("  this recogniser is not more accurate than the nearest-neighbour classifier\n");
    PrintMistakes(out.verdicts);
  }
  if (out.untaught_performances > 0)
    fmt::print("  {} performances count as errors, because no other person performed the move\n",
               out.untaught_performances);
  if (!out.points.empty()) {
    fmt::print("mean F-score over moves, for {} action points with a tolerance of {:.0f} ms: {}\n", out.points.size(),
               1000 * kActionPointTolerance, Percent(f_score));
  }
  people.End();
  if (options.as_json) RETURN_IF_ERROR(PrintFacts("recognise", FactsOf(out)));
  return kSuccess;
}

Result<int> RecogniseCommand(const RecogniseCommandOptions& options) {
  if (options.leave_one_person_out) return RecogniseLeavingOneOut(options);
  if (options.moves.empty())
    return Fail({"--moves"}, "is missing; allowed: a moves file, such as `etude teach` writes");
  ASSIGN_OR_RETURN(const auto taught, LoadTaught(options));
  const bool is_live = std::ranges::find(options.streams, "-") != options.streams.end();
  if (is_live && (options.streams.size() > 1 || !options.labels.empty())) {
    return Fail({"-"}, "standard input cannot be combined with other recordings or with labels");
  }
  return is_live ? RecogniseLive(options, taught) : RecogniseFiles(options, taught);
}

}  // namespace

void DefineRecognise(CLI::App& app, Action& action) {
  auto options = std::make_shared<RecogniseCommandOptions>();
  CLI::App* command = app.add_subcommand("recognise", "Recognise moves in a recording or a live stream");
  // Define the inputs: recordings, taught moves, labels.
  command
      ->add_option("streams", options->streams,
                   "Recordings, patterns of file names, or folders; -: live from standard input")
      ->required();
  auto* moves = command->add_option("--moves", options->moves,
                                    "The moves file with the taught moves (`etude teach` writes such a file)");
  auto* labels = command->add_option("--labels", options->labels,
                                     "Labels with which the recogniser is scored: a file, or a folder of tag streams");
  command
      ->add_flag("--leave-one-person-out", options->leave_one_person_out,
                 "Recognise each person's moves with a recogniser that learnt from all other people")
      ->excludes(moves);
  // Define the recogniser and the recogniser's settings.
  command
      ->add_option("--recogniser", options->recogniser,
                   "The recogniser (default: key-pose if a move has no example; whole-body if each move has three "
                   "examples, or with --leave-one-person-out; otherwise learnt)")
      ->check(OneOf(RecogniserNames()));
  command->add_option("--filter", options->filter, "Filter that smooths the joints before recognition")
      ->check(OneOf(FilterNames()));
  command
      ->add_option(
          "--weights", options->weights,
          "Weights of the angles: fixed (all equal), or adaptive (higher for angles that the sensor sees better)")
      ->check(OneOf({"fixed", "adaptive"}));
  command
      ->add_option("--threshold", options->threshold,
                   "Lowest evidence at which a move counts as performed (default: the recogniser's value)")
      ->check(NumberWithin(0.001, 1, "threshold"));
  command->add_option("--set", options->settings, "A setting of the recogniser, such as tolerance_scale=1.2")
      ->allow_extra_args(false);
  command->add_flag("--json", options->as_json, "Also print the scores as JSON (docs/schemas/facts.schema.json)")
      ->needs(labels);
  AddStreamReading(*command, options->reading);
  command->footer(kRecogniseText);
  command->callback([=, &action] { action = [=] { return Finish(RecogniseCommand(*options)); }; });
}

}  // namespace etude
