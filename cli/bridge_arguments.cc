#include "cli/bridge_arguments.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/bridge_command.h"
#include "cli/clip_arguments.h"
#include "cli/common_arguments.h"
#include "cli/validators.h"

namespace etude {
namespace {

constexpr const char* kBridgeExamples =
    "\nA bridge frame is a frame fit for a transition: its pose occurs in several clips, its head is quiet. Two of\n"
    "them match when their fuzzy distance is below the threshold. Clips are named as in etude clip --help;\n"
    "docs/bridge-frames.md tells more.\n\n"
    "Try:\n"
    "  etude bridge 'builtin:*' builtin:acts -o tags.xml      the bear's moves and acts\n"
    "  etude bridge 'mocap/*.bvh' --to wave.bvh               from which clips is there a way into wave.bvh?\n"
    "  etude bridge 'mocap/*.bvh' --threshold 0.6 --json      everything, for another program\n"
    "  etude bridge --check tags.xml 'mocap/*.bvh'            is the file valid, and does it fit these clips?";

}  // namespace

void DefineBridge(CLI::App& app, Action& action) {
  auto options = std::make_shared<BridgeCommandOptions>();
  CLI::App* command =
      app.add_subcommand("bridge", "Find the frames at which one clip can lead into another, and tag them");
  command->add_option("clips", options->clips, "The clips of one library");
  CLI::Option* output = command->add_option("-o,--output", options->output, "The tags file to write (XML)");
  CLI::Option* check =
      command->add_option("--check", options->check, "A tags file to be checked, against clips if any");
  check->excludes(output);
  const auto add = [&](CLI::Option* option) { check->excludes(option); };
  add(command->add_option("--to", options->to,
                          "Clips that every other one must lead into; they join the library (default: head_shake,\n"
                          "wave, puzzled and slow demonstrations, where they are among the clips)"));
  add(command->add_option("--threshold", options->threshold, "Frames nearer than this match")
          ->check(NumberWithin(1e-6, 6, "threshold"))
          ->capture_default_str());
  add(command->add_flag("--within-class", options->within_class, "Compare only frames with the same ten tags"));
  add(command->add_option("--min-clips", options->min_clips, "In so many clips a bridge frame's tags occur at least")
          ->check(CLI::Range(1, 1000))
          ->capture_default_str());
  add(command
          ->add_option("--most-per-class", options->most_per_class,
                       "Keep so many bridge frames per clip and pose, those most like other clips' (0: all)")
          ->check(CLI::Range(0, 1000000))
          ->capture_default_str());
  add(command->add_option("--wait", options->wait_s, "How long a transition may wait, seconds")
          ->check(NumberWithin(0, 3600, "time in seconds"))
          ->capture_default_str());
  command->add_option("--fuzzy", options->fuzzy, "Fuzzy system: builtin:NAME or a file (default: builtin:paper)");
  add(command->add_flag("--json", options->as_json,
                        "The summary for programs (docs/schemas/bridge-summary.schema.json)"));
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->footer(kBridgeExamples);
  command->callback([=, &action] { action = [=] { return BridgeCommand(*options); }; });
}

}  // namespace etude
