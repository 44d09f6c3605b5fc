#include "cli/train_arguments.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/clip_arguments.h"
#include "cli/common_arguments.h"
#include "cli/train_command.h"

namespace etude {
namespace {

constexpr const char* kTrainExamples =
    "\nPaper A's distance says that two frames match when d < 0.4. How much each of its ten features\n"
    "counts (S), and where its membership functions bend, were chosen by hand. This command learns them: it takes\n"
    "frames of every clip, two clips at a time, calls a pair close when its worst joint is less than 15 cm off\n"
    "(after turning and moving one onto the other on the floor), and looks for the system by which d < 0.4 tells\n"
    "the close pairs best. Clips held out are never learnt from: only what is known about them counts.\n\n"
    "A scenario uses the file by `fuzzy: tuned.yaml`; docs/fuzzy-system.md tells what is in it.\n\n"
    "With --recogniser it makes the model of the recogniser `learnt` anew (docs/detection.md): simulated people dance\n"
    "the labelled clips, right and wrong, and the model learns to tell which. With --coached that of `coached`: they\n"
    "dance songs along with a coach (docs/coach.md).\n\n"
    "Try:\n"
    "  etude train 'builtin:*' -o tuned.yaml                           S, by a genetic algorithm\n"
    "  etude train 'builtin:*' -o tuned.yaml --memberships             the membership functions, too\n"
    "  etude train 'builtin:*' -o tuned.yaml --method adaptive         S, by logistic regression\n"
    "  etude train 'builtin:*' 'mocap/*.bvh' -o tuned.yaml --hold-out 'mass_*'    judge by these\n"
    "  etude train 'builtin:*' -o learnt.yaml --recogniser             what recogniser learnt knows\n"
    "  etude train groove sprint warm_up -o coached.yaml --coached     what recogniser coached knows";

}  // namespace

void DefineTrain(CLI::App& app, Action& action) {
  auto options = std::make_shared<TrainOptions>();
  CLI::App* command = app.add_subcommand("train", "Learn a fuzzy system or a recogniser from clips");
  command->add_option("clips", options->clips, "Clips to learn from, and to judge by")->required();
  command->add_option("-o,--output", options->output, "The file to write (YAML)")->required();
  command->add_option("--method", options->method, "How to learn")
      ->check(CLI::IsMember({"adaptive", "genetic"}))
      ->capture_default_str();
  command->add_flag("--memberships", options->memberships, "Tune the membership functions, too (genetic)");
  command
      ->add_option("--hold-out", options->hold_out,
                   "Clips to judge by: a share of them (0: none), drawn by the seed, or a pattern of names")
      ->capture_default_str();
  AddSeed(*command, options->seed, "Seed of all dice");
  command->add_option("--population", options->population, "Genomes of a generation")
      ->check(CLI::Range(5, 1000))
      ->capture_default_str();
  command->add_option("--generations", options->generations, "How long the genetic algorithm searches")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_flag("--recogniser", options->recogniser, "Learn the recogniser `learnt`");
  command->add_flag("--coached", options->coached, "Learn the recogniser `coached`: CLIPS are built-in songs")
      ->excludes("--recogniser");
  command
      ->add_option(
          "--sessions", options->sessions,
          "Of simulated people: 16 performances each (recogniser, 400), three minutes before a coach (coached, "
          "300)")
      ->check(CLI::Range(10, 10000));
  for (const char* other : {"--method", "--memberships", "--hold-out", "--population", "--generations"}) {
    command->get_option(other)->excludes("--recogniser")->excludes("--coached");
  }
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->footer(kTrainExamples);
  command->callback([=, &action] {
    action = [=] {
      return options->recogniser || options->coached ? TrainRecogniserCommand(*options) : TrainCommand(*options);
    };
  });
}

}  // namespace etude
