#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/transitions/tags_file/tags_file.h"
#include "io/files/files.h"
#include "tools/clips/bridge_summary.h"

namespace etude {
namespace {

struct BridgeCommandOptions {
  std::vector<std::string> clips;
  std::vector<std::string> to;  ///< clips into which every other clip must lead; empty = the coach's own ones
  std::string output;           ///< a tags file, "" = only the summary
  std::string check;            ///< a tags file to check; "" = none
  /// "builtin:NAME" or a file; "" = paper A's system, or the system that the checked tags file names.
  std::string fuzzy;
  double threshold = 0.4, wait_s = 1;
  int min_clips = 2, most_per_class = 0;
  bool within_class = false, with_pairs = false, as_json = false, overwrite = false;
  ClipReading reading;
};

constexpr const char* kBridgeText =
    "\n"
    "A bridge frame is a frame that suits a transition: its pose occurs in several clips, and the head is still. Two\n"
    "bridge frames match if their fuzzy distance is below the threshold. `etude clip --help` explains how to specify\n"
    "clips; docs/bridge-frames.md explains bridge frames.";

Result<BridgeLibrary> LoadLibrary(const BridgeCommandOptions& options) {
  BridgeLibraryOptions bridge{.clips = options.clips,
                       .to = options.to,
                       .system = {},
                       .threshold = options.threshold,
                       .min_clips = options.min_clips,
                       .most_per_class = options.most_per_class,
                       .within_class = options.within_class,
                       .reading = {},
                       .on_progress = ProgressOf("clips read")};
  ASSIGN_OR_RETURN(bridge.system, ReadFuzzy(options.fuzzy));
  ASSIGN_OR_RETURN(bridge.reading, ReadOptionsTellingDoubts(options.reading));
  ASSIGN_OR_RETURN(auto loaded, LoadBridgeLibrary(bridge));
  for (const Error& copy : loaded.copies) fmt::print(stderr, "left out: {}\n", ToString(copy));
  return loaded;
}

/// Copies the rules of a tags file into the options, so that the clips are tagged by the rules of the file.
BridgeCommandOptions OptionsOf(const BridgeTags& tags, BridgeCommandOptions options) {
  options.threshold = tags.threshold;
  options.within_class = tags.within_class;
  options.min_clips = tags.min_clips;
  options.most_per_class = tags.most_per_class;
  if (!options.fuzzy.empty()) return options;
  for (const std::string& name : BuiltinFuzzySystemNames()) {
    if (name == tags.system) options.fuzzy = "builtin:" + name;
  }
  return options;
}

Result<int> CheckTags(const BridgeCommandOptions& options) {
  if (options.clips.empty() && !options.fuzzy.empty()) {
    return Fail({"--fuzzy"},
                "has no effect on --check if there are no clips; add the clips that the tags file describes");
  }
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(options.check));
  ASSIGN_OR_RETURN(const auto tags, ReadTagsFile(text, options.check));
  std::size_t bridge_frames = 0;
  for (const ClipTags& clip : tags.clips) bridge_frames += clip.bridge_frames.size();
  if (options.clips.empty()) {
    fmt::print("{}: {} clips, {} bridge frames, {} key poses; valid\n", options.check, tags.clips.size(), bridge_frames,
               tags.keys.size());
    return kSuccess;
  }
  ASSIGN_OR_RETURN(const auto loaded, LoadLibrary(OptionsOf(tags, options)));
  const TagsComparison comparison = CompareTags(tags, TagsOf(loaded));
  if (!comparison.differences.empty()) {
    const std::size_t count = comparison.differences.size();
    const std::string rest = count == 1 ? "" : fmt::format("; {} differences in all", count);
    return Fail({options.check}, "does not match the clips: {}{}", comparison.differences.front(), rest);
  }
  fmt::print("{}: {} clips, {} bridge frames, {} key poses; valid, and matches the clips\n", options.check,
             comparison.clips, comparison.bridge_frames, tags.keys.size());
  return kSuccess;
}

Result<int> BridgeCommand(const BridgeCommandOptions& options) {
  if (!options.check.empty()) return CheckTags(options);
  if (options.clips.empty()) return Fail({}, "`etude bridge` needs clips, or the option --check with a tags file");
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  ASSIGN_OR_RETURN(const auto loaded, LoadLibrary(options));
  if (!options.output.empty()) RETURN_IF_ERROR(WriteTags(loaded, options.output));
  const bool with_pairs = options.with_pairs || loaded.library.names.size() <= kMaxClipsWithPairs;
  const Coverage coverage(loaded.library.tagged, loaded.match_rules,
                          {.budget_s = options.wait_s,
                           .with_pairs = with_pairs,
                           .wanted = loaded.corrective,
                           .on_progress = ProgressOf("comparisons of a clip")});
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("bridge", BridgeSummaryAsJson(loaded, coverage, options.wait_s)));
  } else {
    fmt::print("{}", BridgeSummaryAsText(loaded, coverage, options.wait_s));
  }
  if (!options.output.empty()) TellWritten(options.output, options.as_json ? stderr : stdout);
  return kSuccess;
}

}  // namespace

void DefineBridge(CLI::App& app, Action& action) {
  auto options = std::make_shared<BridgeCommandOptions>();
  CLI::App* command = app.add_subcommand(
      "bridge", "Find and tag the frames at which a transition from one clip to another is possible");
  // Define the inputs and outputs.
  command->add_option("clips", options->clips, "The clips of the library to analyse");
  CLI::Option* output = command->add_option("-o,--output", options->output, "The tags file to write (XML)");
  // --check excludes most other options, because the tags file states the rules.
  CLI::Option* check =
      command->add_option("--check", options->check,
                          "Check this tags file; if clips are given, also check that the file matches the clips");
  check->excludes(output);
  const auto add = [&](CLI::Option* option) { check->excludes(option); };
  add(command->add_option(
      "--to", options->to,
      "Clips that must be reachable from every other clip; they are added to the library (default: head_shake,\n"
      "wave, puzzled and slow demonstrations, if they are among the clips)"));
  // Define the rules of matching and tagging.
  add(command
          ->add_option("--threshold", options->threshold,
                       "Two frames match if their fuzzy distance is below this value")
          ->check(NumberWithin(1e-6, 6, "threshold")));
  add(command->add_flag("--within-class", options->within_class, "Match only frames whose ten tags are all equal"));
  add(command
          ->add_option("--min-clips", options->min_clips,
                       "Minimum number of clips in which the tags of a bridge frame must occur")
          ->check(CLI::Range(1, 1000)));
  add(command
          ->add_option("--most-per-class", options->most_per_class,
                       "Maximum number of bridge frames per clip and pose; the frames most similar to frames of other "
                       "clips are kept (0: all)")
          ->check(CLI::Range(0, 1000000)));
  add(command->add_option("--wait", options->wait_s, "Longest wait for a transition, in seconds")
          ->check(NumberWithin(0, 3600, "time in seconds")));
  command->add_option("--fuzzy", options->fuzzy, "Fuzzy system: builtin:NAME or a file (default: builtin:paper)");
  add(command->add_flag(
      "--pairs", options->with_pairs,
      fmt::format("Compare every pair of clips, even if there are more than {} clips", kMaxClipsWithPairs)));
  add(command->add_flag("--json", options->as_json, "Print JSON (docs/schemas/bridge-summary.schema.json)"));
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->footer(kBridgeText);
  command->callback([=, &action] { action = [=] { return Finish(BridgeCommand(*options)); }; });
}

}  // namespace etude
