#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "engine/transitions/choices/choice.h"
#include "engine/transitions/joins/join.h"
#include "tools/clips/transition_file.h"

namespace etude {
namespace {

constexpr const char* kTransitionNotes =
    "\n"
    "The written motion is FROM from its start until a frame at or after --at, then the transition, then TO until its "
    "end.\n"
    "TO is moved to the position where FROM ends. The default --choice and --join are the recommended method; `etude "
    "list\n"
    "methods` describes all methods. The written motion has Etude's twenty joints with the proportions of FROM, at 30 "
    "Hz. It\n"
    "does not have the skeleton of FROM. If the body lies, sits or kneels, a transition needs a clip in which a body "
    "stands\n"
    "up: give such clips with --library.";

struct TransitionCommandOptions {
  TransitionFileOptions transition;
  ClipReading reading;
  bool overwrite = false, as_json = false;
  bool has_join = false;  ///< true if the user stated a join
};

Result<int> TransitionCommand(TransitionCommandOptions asked) {
  TransitionFileOptions& options = asked.transition;
  // Make the transition; WriteTransition writes nothing if there is none.
  RETURN_IF_ERROR(CheckOutput(options.output, asked.overwrite));
  ASSIGN_OR_RETURN(options.reading, ReadOptionsTellingDoubts(asked.reading));
  ASSIGN_OR_RETURN(const TransitionFile made, WriteTransition(options));
  if (made.branch == Branch::kNone) {
    Complain({{},
              fmt::format("found no transition from {} to {} within {:g} s: {}; Etude wrote no file", options.from,
                          options.to, options.budget_s, made.why)});
    return kNothingWorked;
  }
  // Report the transition. The choice "unbroken" joins nothing, and never plays the second clip.
  const bool is_unbroken = made.branch == Branch::kUnbroken;
  if (is_unbroken && asked.has_join) {
    fmt::print(stderr, "--join {} has no effect, because --choice {} joins no clips\n", options.join, options.choice);
  }
  if (asked.as_json) {
    RETURN_IF_ERROR(PrintFacts("transition", {{"from", options.from},
                                              {"to", options.to},
                                              {"choice", options.choice},
                                              {"join", is_unbroken ? Json() : Json(options.join)},
                                              {"branch", BranchName(made.branch)},
                                              {"left_s", made.left_s},
                                              {"entered_s", made.entered_s},
                                              {"through", made.through.empty() ? Json() : Json(made.through)},
                                              {"wait_s", made.wait_s},
                                              {"points_s", made.points_s},
                                              {"duration_s", made.duration_s},
                                              {"why", made.why},
                                              {"from_changes", made.from_changes},
                                              {"to_changes", made.to_changes},
                                              {"output", options.output}}));
  } else if (is_unbroken) {
    fmt::print("{}; {} is not played\n  written as a body of twenty joints at 30 Hz, {:.2f} s long\n", made.why,
               options.to, made.duration_s);
  } else {
    fmt::print("{} plays until {:.2f} s, {:.2f} s after the request{}; then {} plays, starting at its time {:.2f} s\n",
               options.from, made.left_s, made.wait_s,
               made.through.empty() ? "" : fmt::format("; {} plays in between", made.through), options.to,
               made.entered_s);
    fmt::print("  {}\n  written as a body of twenty joints at 30 Hz, {:.2f} s long, joined at", made.why,
               made.duration_s);
    for (const double point : made.points_s) fmt::print(" {:.2f} s", point);
    fmt::print("\n");
    for (const std::string& change : made.from_changes) fmt::print("  {}: {}\n", options.from, change);
    for (const std::string& change : made.to_changes) fmt::print("  {}: {}\n", options.to, change);
  }
  TellWritten(options.output, asked.as_json ? stderr : stdout);
  return kSuccess;
}

}  // namespace

void DefineTransition(CLI::App& app, Action& action) {
  auto asked = std::make_shared<TransitionCommandOptions>();
  TransitionFileOptions* options = &asked->transition;
  CLI::App* command =
      app.add_subcommand("transition", "Write a motion file with a transition from one clip to another");
  // Define the clips, the time of the request, and the output.
  command->add_option("from", options->from, "The clip that plays first")->required();
  command->add_option("to", options->to, "The clip that plays afterwards")->required();
  command
      ->add_option("--at", options->at_s,
                   "Seconds after the first frame of the first clip at which the transition is requested")
      ->check(NumberWithin(0, 36000, "time in s"))
      ->required();
  command->add_option("-o,--output", options->output, "The motion to write: .bvh, .glb, .trc, .csv, .c3d, .npz or .mot")
      ->required();
  // Define how the transition is chosen and made.
  command->add_option("--wait", options->budget_s, "Longest wait before the transition, in s; not for wait-for-end")
      ->check(NumberWithin(0, 3600, "time in s"));
  command
      ->add_option("--choice", options->choice,
                   "The rule that chooses the frame at which the transition leaves the first clip, and the frame at "
                   "which it enters the second clip")
      ->check(OneOf(ChoiceNames()));
  command->add_option("--join", options->join, "The method that joins the two clips at these frames")
      ->check(OneOf(JoinNames()));
  command->add_option("--library", options->library,
                      "Additional clips; the transition may play one of these clips in between");
  AddOverwrite(*command, asked->overwrite);
  AddJson(*command, asked->as_json);
  AddClipReading(*command, asked->reading);
  command->footer(kTransitionNotes);
  command->callback([=, &action] {
    asked->has_join = command->count("--join") > 0;
    action = [=] { return Finish(TransitionCommand(*asked)); };
  });
}

}  // namespace etude
