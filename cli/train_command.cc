#include "cli/train_command.h"

#include <fmt/core.h>
#include <fnmatch.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "bench/clips/clip_library.h"
#include "bench/files/files.h"
#include "bench/training/tuning.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/base/names.h"
#include "sim/choreography/canonical_body.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr std::size_t kMostClipsToTrainOn = 150;

/// Clips to learn from, and clips to judge by.
struct Split {
  std::vector<std::string> learnt_names, held_out_names;
  std::vector<std::vector<TrainingFrame>> learnt, held_out;
};

std::optional<double> ReadShare(const std::string& text) {
  double share = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), share);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return share;
}

/// Which of the clips to hold out.
Result<std::vector<bool>> ChooseHeldOut(const std::vector<std::string>& names, const TrainOptions& options) {
  std::vector<bool> held_out(names.size(), false);
  const auto share = ReadShare(options.hold_out);
  if (!share) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      held_out[i] = fnmatch(options.hold_out.c_str(), names[i].c_str(), 0) == 0;
    }
    if (std::find(held_out.begin(), held_out.end(), true) != held_out.end()) return held_out;
    return Fail({"--hold-out", 0, 0}, "no clip is called {}; the clips: {}", Quote(options.hold_out), Join(names));
  }
  if (!(*share >= 0 && *share < 1)) {
    return Fail({"--hold-out", 0, 0}, "{} is neither a pattern of names nor a share; allowed: 0 up to below 1",
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

Result<Split> LoadSplit(const TrainOptions& options) {
  ASSIGN_OR_RETURN(const auto reading, ReadOptions(options.reading));
  ASSIGN_OR_RETURN(const auto references, ExpandAll(options.clips));
  ASSIGN_OR_RETURN(auto library, LoadClips(references, {}, reading, TellOf("clips read")));
  std::vector<std::string> names;
  std::vector<BodyMotion> motions;
  for (LibraryClip& clip : library.clips) {
    names.push_back(clip.name);
    motions.push_back(std::move(clip.motion));
  }
  if (names.size() > kMostClipsToTrainOn) {
    return Fail({}, "{} clips; allowed: at most {}, since their pairs grow with the square", names.size(),
                kMostClipsToTrainOn);
  }
  ASSIGN_OR_RETURN(const auto held_out, ChooseHeldOut(names, options));

  const BodyPose standing = PoseOf(Controls{});
  TrainingClips all = SampleClips(names, motions, MakeBodyProportions(standing, StandingHipHeight(standing)));
  Split split;
  for (std::size_t i = 0; i < names.size(); ++i) {
    (held_out[i] ? split.held_out_names : split.learnt_names).push_back(names[i]);
    (held_out[i] ? split.held_out : split.learnt).push_back(std::move(all.frames[i]));
  }
  if (split.learnt.size() >= 2) return split;
  return Fail({}, "{} left to learn from, {} held out; pairs need two clips at least",
              split.learnt.size() == 1 ? "one clip is" : "no clip is", split.held_out.size());
}

std::string ScoreLine(const char* what, ClipFrames clips, const FuzzySystem& system) {
  if (clips.size() < 2) return fmt::format("{:<9} (needs two clips)", what);
  const SystemScore score = ScoreSystem(clips, system);
  const MatchScore& matches = score.at_threshold;
  return fmt::format("{:<9} F1 {:.3f}, AUC {}; {} pairs matched, {} close, {} both", what, matches.F1(),
                     score.auc ? fmt::format("{:.3f}", *score.auc) : "none", matches.matched, matches.close,
                     matches.close_matched);
}

/// How the two systems do, a line each.
std::vector<std::string> CompareSystems(const Split& split, const FuzzySystem& tuned) {
  const FuzzySystem paper;
  return {
      "paper's:", "  " + ScoreLine("learnt", split.learnt, paper), "  " + ScoreLine("held out", split.held_out, paper),
      "tuned:",   "  " + ScoreLine("learnt", split.learnt, tuned), "  " + ScoreLine("held out", split.held_out, tuned)};
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
  text += "# How well d < 0.4 tells the close pairs:\n";
  for (const std::string& line : comparison) text += "#   " + line + "\n";
  return text;
}

Tuning TuningOf(const TrainOptions& options) {
  if (options.method == "adaptive") return Tuning::kAdaptive;
  return options.memberships ? Tuning::kGeneticMemberships : Tuning::kGenetic;
}

/// Every tenth of the way, as a run's progress bar does off a terminal.
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
    return Fail({"--memberships", 0, 0}, "the method '{}' learns weights only; allowed with: --method genetic",
                options.method);
  }
  if (options.method == "genetic") RETURN_IF_ERROR(LoadGeneticSearch());
  return CheckOutput(options.output, options.overwrite);
}

std::string WhyNothing(WeightFitStatus status) {
  switch (status) {
    case WeightFitStatus::kOneClassOnly:
      return "no pair of frames of two different clips is close, or all are: there is nothing to tell apart";
    case WeightFitStatus::kNothingCounts:
      return "no feature tells the close pairs";
    default:
      return "the regression did not settle";
  }
}

}  // namespace

int TrainCommand(const TrainOptions& options) {
  if (auto checked = CheckOptions(options); !checked) return Complain(checked.error());
  const auto split = LoadSplit(options);
  if (!split) return Complain(split.error());
  TunedSystem tuned = TuneSystem(split->learnt, TuningOf(options), GeneticOptionsOf(options));
  if (tuned.status != WeightFitStatus::kFitted) {
    return Complain({{}, "nothing was learnt: " + WhyNothing(tuned.status)});
  }
  tuned.system.name = options.method;
  const std::vector<std::string> comparison = CompareSystems(*split, tuned.system);
  const std::string text = HeaderOf(options, *split, tuned, comparison) + WriteFuzzySystem(tuned.system);
  if (auto read_back = ReadFuzzySystem(text, options.output); !read_back) return Complain(read_back.error());
  if (auto written = WriteFileAtomically(options.output, text); !written) return Complain(written.error());
  fmt::print("{} clips learnt from, {} held out; how well d < 0.4 tells pairs of frames that look alike:\n",
             split->learnt.size(), split->held_out.size());
  for (const std::string& line : comparison) fmt::print("{}\n", line);
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace etude
