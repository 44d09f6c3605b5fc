#include <fmt/core.h>
#include <fnmatch.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/tasks/coach/train_coached.h"
#include "bench/tasks/detection/train_recogniser.h"
#include "bench/training/tuning.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/motion/equal_motions.h"
#include "io/clips/clip_library.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "sim/choreography/canonical_body.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

struct TrainOptions {
  std::vector<std::string> clips;
  std::string output;              ///< a fuzzy system file
  std::string method = "genetic";  ///< the method of learning: "genetic" or "adaptive"
  bool memberships = false;        ///< true: the membership functions are also tuned
  std::uint64_t seed = 1;
  int population = 40, generations = 60;
  /// Learn the recogniser `learnt` instead of a fuzzy system, from simulated people who dance the clips.
  bool recogniser = false;
  bool coached = false;  ///< learn the recogniser `coached` instead of a fuzzy system; the `clips` are then songs
  /// Number of simulated sessions for `recogniser` or `coached`; default: the number that the built-in model was learnt
  /// from.
  std::optional<int> sessions;
  std::string hold_out = "0.3";  ///< a share of the clips, or a pattern of the clips' names
  bool overwrite = false, as_json = false;
  ClipReading reading;
};

constexpr const char* kTrainText =
    "\n"
    "In paper A, two frames match if their fuzzy distance d is below 0.4. The authors chose the weights of the ten "
    "features\n"
    "and the corners of the membership functions by hand. This command learns these numbers from pairs of frames of "
    "two\n"
    "different clips. A pair is close if every joint differs by less than 15 cm, after one pose was aligned with the "
    "other\n"
    "on the floor. The command searches for the fuzzy system with which the rule d < 0.4 finds the close pairs best. "
    "Clips\n"
    "that are held out are only used to test the result.\n\n"
    "To use the file in a scenario, write `fuzzy: tuned.yaml`; docs/fuzzy-system.md explains fuzzy systems.\n\n"
    "With --recogniser, the command learns the model of the recogniser `learnt` (docs/detection.md): simulated people\n"
    "perform the labelled clips, right and wrong, and the model learns to distinguish right from wrong performances. "
    "With\n"
    "--coached, it learns the model of the recogniser `coached`: simulated people dance songs with a coach "
    "(docs/coach.md).";

constexpr std::size_t kMaxTrainingClips = 150;

/// Clips for learning, and clips for testing.
struct Split {
  std::vector<std::string> learnt_names, held_out_names;
  std::vector<std::vector<TrainingFrame>> learnt, held_out;
};

/// Chooses the held-out clips: the clips whose names match the pattern, or a randomly drawn share.
Result<std::vector<bool>> ChooseHeldOut(const std::vector<std::string>& names, const TrainOptions& options) {
  std::vector<bool> held_out(names.size(), false);
  const auto share = ParseNumber<double>(options.hold_out);
  if (!share) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      held_out[i] = fnmatch(options.hold_out.c_str(), names[i].c_str(), 0) == 0;
    }
    if (std::find(held_out.begin(), held_out.end(), true) != held_out.end()) return held_out;
    return Fail({"--hold-out", 0, 0}, "no clip has the name {}; allowed: {}", Quote(options.hold_out), Join(names));
  }
  if (!(*share >= 0 && *share < 1)) {
    return Fail({"--hold-out", 0, 0}, "found {}; allowed: a pattern of clip names, or a share from 0 to below 1",
                options.hold_out);
  }
  RandomStream dice({.suite_seed = options.seed, .scenario = "training"}, "hold-out");
  std::vector<std::size_t> left(names.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  for (long count = std::lround(*share * static_cast<double>(names.size())); count > 0; --count) {
    const auto drawn = left.begin() + static_cast<std::ptrdiff_t>(dice.IndexBelow(left.size()));
    held_out[*drawn] = true;
    left.erase(drawn);
  }
  return held_out;
}

/// Leaves out each clip that shows the same motion as an earlier clip, and prints it. Fails if one of the two is held
/// out and the other is not.
Result<void> LeaveOutCopies(std::vector<LibraryClip>& clips, std::vector<bool>& held_out) {
  std::vector<Places> places;
  for (const LibraryClip& clip : clips) places.push_back(PlacesOf(clip.motion));
  const auto equals = FindEqual(places);
  for (std::size_t i = 0; i < clips.size(); ++i) {
    if (!equals[i]) continue;
    const std::string& first = clips[*equals[i]].source;
    if (held_out[i] != held_out[*equals[i]]) {
      return Fail({clips[i].source}, "shows the same motion as {}, but only one of the two is held out", first);
    }
    fmt::print(stderr, "left out: {}\n", ToString(Error{{clips[i].source}, "shows the same motion as " + first}));
  }
  EraseEqual(clips, equals);
  EraseEqual(held_out, equals);
  return {};
}

Result<Split> LoadSplit(const TrainOptions& options) {
  // Load the clips.
  ASSIGN_OR_RETURN(const auto reading, ReadOptionsTellingDoubts(options.reading));
  ASSIGN_OR_RETURN(const auto references, ExpandReferences(options.clips));
  ASSIGN_OR_RETURN(auto library, LoadClips(references, {}, reading, ProgressOf("clips read")));
  // A pattern can hold out a copy of a clip that is learnt from; a share is drawn from clips without copies.
  const bool is_share = ParseNumber<double>(options.hold_out).has_value();
  std::vector<bool> held_out(library.clips.size(), false);
  if (!is_share) {
    ASSIGN_OR_RETURN(held_out, ChooseHeldOut(NamesOf(library.clips), options));
  }
  RETURN_IF_ERROR(LeaveOutCopies(library.clips, held_out));
  const std::vector<std::string> names = NamesOf(library.clips);
  std::vector<BodyMotion> motions;
  for (LibraryClip& clip : library.clips) motions.push_back(std::move(clip.motion));
  if (names.size() > kMaxTrainingClips) {
    return Fail(
        {},
        "found {} clips; allowed: at most {}, because the number of pairs grows with the square of the number of clips",
        names.size(), kMaxTrainingClips);
  }
  if (is_share) {
    ASSIGN_OR_RETURN(held_out, ChooseHeldOut(names, options));
  }

  // Sample the frames of all clips on one body, and divide the clips into clips for learning and clips for testing.
  const BodyPose standing = PoseOf(Controls{});
  TrainingClips all = SampleClips(names, motions, MakeBodyProportions(standing, StandingHipHeight(standing)));
  Split split;
  for (std::size_t i = 0; i < names.size(); ++i) {
    (held_out[i] ? split.held_out_names : split.learnt_names).push_back(names[i]);
    (held_out[i] ? split.held_out : split.learnt).push_back(std::move(all.frames[i]));
  }
  if (split.learnt.size() >= 2) return split;
  return Fail({},
              "{} left for learning, and {} are held out; learning needs two clips or more, because each pair of "
              "frames comes from two clips",
              split.learnt.size() == 1 ? "one clip is" : "no clip is", split.held_out.size());
}

std::string ScoreLine(const char* what, ClipFrames clips, const FuzzySystem& system) {
  if (clips.size() < 2) return fmt::format("{:<9} (needs two clips)", what);
  const SystemScore score = ScoreSystem(clips, system);
  const MatchScore& matches = score.at_threshold;
  return fmt::format("{:<9} F1 {:.3f}, AUC {}; {} pairs match, {} pairs are close, {} pairs match and are close", what,
                     matches.F1(), score.auc ? fmt::format("{:.3f}", *score.auc) : "none", matches.matched,
                     matches.close, matches.close_matched);
}

/// Scores paper A's system and the tuned system: for each, one line for the learnt clips and one for the held-out
/// clips.
std::vector<std::string> CompareSystems(const Split& split, const FuzzySystem& tuned) {
  const FuzzySystem paper;
  return {
      "paper's:", "  " + ScoreLine("learnt", split.learnt, paper), "  " + ScoreLine("held out", split.held_out, paper),
      "tuned:",   "  " + ScoreLine("learnt", split.learnt, tuned), "  " + ScoreLine("held out", split.held_out, tuned)};
}

/// Returns the scores of CompareSystems as JSON; a set of fewer than two clips has no score.
Json ScoresOf(const Split& split, const FuzzySystem& tuned) {
  Json scores = Json::array();
  for (const auto& [name, system] : {std::pair("paper", FuzzySystem()), {"tuned", tuned}}) {
    for (const auto& [clips, frames] : {std::pair("learnt", &split.learnt), {"held out", &split.held_out}}) {
      if (frames->size() < 2) continue;
      const SystemScore score = ScoreSystem(*frames, system);
      scores.push_back({{"system", name},
                        {"clips", clips},
                        {"f1", score.at_threshold.F1()},
                        {"auc", OrNull(score.auc)},
                        {"matched", score.at_threshold.matched},
                        {"close", score.at_threshold.close},
                        {"close_matched", score.at_threshold.close_matched}});
    }
  }
  return scores;
}

std::string HeaderOf(const TrainOptions& options, const Split& split, const TunedSystem& tuned,
                     const std::vector<std::string>& comparison) {
  std::string text = fmt::format("# Learnt by `etude train --method {}{} --seed {}`", options.method,
                                 options.memberships ? " --memberships" : "", options.seed);
  if (options.method == "genetic") {
    text += fmt::format(": {} generations of {} genomes", tuned.generations, options.population);
  }
  text += fmt::format("\n# from {} pairs of frames, {} of them close, of\n#   {}\n# held out:\n#   {}\n", tuned.pairs,
                      tuned.close_pairs, Join(split.learnt_names),
                      split.held_out_names.empty() ? "none" : Join(split.held_out_names));
  text += "# How well the rule d < 0.4 finds the close pairs:\n";
  for (const std::string& line : comparison) text += "#   " + line + "\n";
  return text;
}

Tuning TuningOf(const TrainOptions& options) {
  if (options.method == "adaptive") return Tuning::kAdaptive;
  return options.memberships ? Tuning::kGeneticMemberships : Tuning::kGenetic;
}

/// Returns the options of the genetic algorithm; progress is printed at every tenth of the generations.
GeneticOptions GeneticOptionsOf(const TrainOptions& options) {
  const int tenth = std::max(1, options.generations / 10);
  return {.population = options.population,
          .generations = options.generations,
          .seed = options.seed,
          .progress = [=](int generation, double best) {
            if (generation % tenth != 0) return;
            fmt::print(stderr, "generation {} of {}: {:.4f}\n", generation, options.generations, best);
          }};
}

Result<void> CheckOptions(const TrainOptions& options) {
  if (options.memberships && options.method != "genetic") {
    return Fail({"--memberships", 0, 0},
                "cannot be combined with --method {}, which learns only weights; allowed: --method genetic",
                options.method);
  }
  if (options.method == "genetic") RETURN_IF_ERROR(LoadGeneticSearch());
  return CheckOutput(options.output, options.overwrite);
}

std::string WhyNothing(WeightFitStatus status) {
  switch (status) {
    case WeightFitStatus::kOneClassOnly:
      return "all pairs of frames of two clips are close, or no pair is, so there is nothing to distinguish";
    case WeightFitStatus::kNothingCounts:
      return "no feature distinguishes the close pairs";
    default:
      return "the regression did not converge";
  }
}

Result<int> TrainCommand(const TrainOptions& options) {
  RETURN_IF_ERROR(CheckOptions(options));
  ASSIGN_OR_RETURN(const auto split, LoadSplit(options));
  TunedSystem tuned = TuneSystem(split.learnt, TuningOf(options), GeneticOptionsOf(options));
  if (tuned.status != WeightFitStatus::kFitted) return Fail({}, "nothing was learnt: {}", WhyNothing(tuned.status));
  tuned.system.name = options.method;
  const std::vector<std::string> comparison = CompareSystems(split, tuned.system);
  const std::string text = HeaderOf(options, split, tuned, comparison) + WriteFuzzySystem(tuned.system);
  RETURN_IF_ERROR(ReadFuzzySystem(text, options.output));  // write the file only if it can be read back
  RETURN_IF_ERROR(WriteFileAtomically(options.output, text));
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("train", {{"learnt_from", split.learnt_names},
                                         {"held_out", split.held_out_names},
                                         {"scores", ScoresOf(split, tuned.system)},
                                         {"output", options.output}}));
    return kSuccess;
  }
  fmt::print(
      "{} clips were used for learning, {} were held out; how well the rule d < 0.4 finds close pairs of frames:\n",
      split.learnt.size(), split.held_out.size());
  for (const std::string& line : comparison) fmt::print("{}\n", line);
  TellWritten(options.output);
  return kSuccess;
}

/// A learnt model, and notes on how the model was learnt.
struct Trained {
  LearntModel model;
  std::vector<std::string> learnt_from;
  std::string header;
};

constexpr const char* kHeader =
    "# The model of the recogniser `{}`, made by `etude train --{} --sessions {} --seed {}` of\n"
    "#   {}\n"
    "# Trees: measure and limit of each question, then what the answers add to the log-odds of \"right\".\n";

Result<Trained> TrainLearnt(const TrainOptions& options) {
  ASSIGN_OR_RETURN(const auto references, ExpandReferences(options.clips));
  ASSIGN_OR_RETURN(const auto reading, ReadOptionsTellingDoubts(options.reading));
  ASSIGN_OR_RETURN(const ClipLibrary library, LoadClips(references, {}, reading, ProgressOf("clips read")));
  const Repertoire repertoire = RepertoireOf(library);
  if (repertoire.taught.size() < 2) {
    return Fail({}, "found {} labelled clips; a recogniser needs at least two to learn", repertoire.taught.size());
  }
  RecogniserTraining training{.seed = options.seed, .progress = ProgressOf("sessions")};
  training.sessions = options.sessions.value_or(training.sessions);
  return Trained{
      TrainRecogniser(repertoire, training), NamesOf(repertoire.taught),
      fmt::format(kHeader, "learnt", "recogniser", training.sessions, training.seed, Join(NamesOf(repertoire.taught)))};
}

Result<Trained> TrainCoachedOf(const TrainOptions& options) {
  CoachedTraining training{.seed = options.seed, .progress = ProgressOf("sessions")};
  training.sessions = options.sessions.value_or(training.sessions);
  ASSIGN_OR_RETURN(LearntModel model, TrainCoached(options.clips, training));
  return Trained{std::move(model), options.clips,
                 fmt::format(kHeader, "coached", "coached", training.sessions, training.seed, Join(options.clips))};
}

Result<int> TrainRecogniserCommand(const TrainOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  ASSIGN_OR_RETURN(const Trained trained, options.coached ? TrainCoachedOf(options) : TrainLearnt(options));
  RETURN_IF_ERROR(WriteFileAtomically(options.output, trained.header + WriteLearntModel(trained.model)));
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("train", {{"learnt_from", trained.learnt_from},
                                         {"held_out", Json::array()},
                                         {"scores", Json::array()},
                                         {"output", options.output}}));
    return kSuccess;
  }
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace

void DefineTrain(CLI::App& app, Action& action) {
  auto options = std::make_shared<TrainOptions>();
  CLI::App* command = app.add_subcommand("train", "Learn a fuzzy system or a recogniser from clips");
  // Define the inputs and outputs; then the options of fuzzy systems.
  command->add_option("clips", options->clips, "Clips for learning and for testing the result")->required();
  command->add_option("-o,--output", options->output, "The file to write (YAML)")->required();
  command->add_option("--method", options->method, "Learning method")->check(OneOf({"adaptive", "genetic"}));
  command->add_flag("--memberships", options->memberships,
                    "Also learn the membership functions (only with --method genetic)");
  command->add_option("--hold-out", options->hold_out,
                      "Clips that are used only for testing the result: a share of all clips, drawn at random (0: "
                      "none), or a pattern of clip names");
  AddSeed(*command, options->seed, "Seed");
  command->add_option("--population", options->population, "Genomes per generation")->check(CLI::Range(5, 1000));
  command->add_option("--generations", options->generations, "Number of generations")->check(CLI::Range(1, 10000));
  // Define the options of recognisers.
  command->add_flag("--recogniser", options->recogniser, "Learn the model of the recogniser `learnt`");
  command
      ->add_flag("--coached", options->coached, "Learn the model of the recogniser `coached`; CLIPS are built-in songs")
      ->excludes("--recogniser");
  command
      ->add_option("--sessions", options->sessions,
                   "Number of sessions with simulated people. With --recogniser, a session has 16 performances "
                   "(default: 400 sessions); with --coached, three minutes with a coach (300 sessions)")
      ->check(CLI::Range(10, 10000));
  // Options of the fuzzy system do not apply to recognisers.
  for (const char* other : {"--method", "--memberships", "--hold-out", "--population", "--generations"}) {
    command->get_option(other)->excludes("--recogniser")->excludes("--coached");
  }
  AddOverwrite(*command, options->overwrite);
  AddJson(*command, options->as_json);
  AddClipReading(*command, options->reading);
  command->footer(kTrainText);
  command->callback([=, &action] {
    action = [=] {
      return Finish(options->recogniser || options->coached ? TrainRecogniserCommand(*options)
                                                            : TrainCommand(*options));
    };
  });
}

}  // namespace etude
