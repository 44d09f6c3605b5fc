#include "cli/stream_arguments.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common_arguments.h"
#include "cli/stream_commands.h"
#include "cli/validators.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recognisers.h"

namespace etude {
namespace {

constexpr const char* kTeachExamples =
    "\nFinds what recognisers are told of a move: key poses with tolerances, and the performances themselves.\n"
    "Without labels one file is one move, called by the file's name. Labels are a CSV (clip,from_s,to_s,move,truth "
    "and,\n"
    "where it matters, person), MSRC-12's tag streams or UTKinect's action labels: docs/streams.md.\n\n"
    "Try:\n"
    "  etude teach wave.csv clap.csv -o moves.yaml\n"
    "  etude teach kinect/*.txt --labels labels.csv -o moves.yaml\n"
    "  etude recognise new.txt --moves moves.yaml";

constexpr const char* kRecogniseExamples =
    "\nPrints what is spotted as it comes, a line of JSON each. With labels also how well: performances called right "
    "or\n"
    "wrong, action points within 333 ms. With --leave-one-person-out each person is recognised by what the others\n"
    "taught. Recordings and devices: Kinect v1 and v2 rows, MSRC-12, UTKinect, NTU, Azure Kinect, CSV, TRC; rows and "
    "CSV\n"
    "also live (docs/streams.md).\n\n"
    "Try:\n"
    "  etude recognise take.txt --moves moves.yaml\n"
    "  my-kinect-reader | etude recognise - --moves moves.yaml\n"
    "  etude recognise take.txt --moves moves.yaml --labels labels.csv\n"
    "  etude recognise joints/ --labels actionLabel.txt --leave-one-person-out --recogniser dtw";

void AddStreamReading(CLI::App& command, StreamArguments& reading) {
  command.add_option("--format", reading.format, "Of the recordings (default: told by content)")
      ->check(CLI::IsMember(StreamFormatNames()));
  command.add_option("--rate", reading.rate_hz, "Of recordings without a clock, Hz (default: 30)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command.add_option("--body", reading.body, "Which of several bodies, by first appearance, from 0")
      ->check(CLI::Range(0, 1000));
  command
      .add_option("--level", reading.level,
                  "Where up and the floor are: estimated from the body, or as the file has it")
      ->check(CLI::IsMember({"auto", "none"}))
      ->capture_default_str();
  command.add_flag("--reflect", reading.reflect, "Negate X: the recording is mirrored");
}

}  // namespace

StreamReading StreamArguments::Reading() const {
  StreamReading reading{.rate_hz = rate_hz, .body = body};
  if (!format.empty()) reading.format = FindStreamFormat(format);
  return reading;
}

StreamOptions StreamArguments::Options() const { return {.levels = level == "auto", .reflects = reflect}; }

void DefineTeach(CLI::App& app, Action& action) {
  auto options = std::make_shared<TeachCommandOptions>();
  CLI::App* command = app.add_subcommand("teach", "Learn moves from recordings and clips");
  command->add_option("streams", options->streams, "Recordings, clips, patterns, folders")->required();
  command->add_option("--labels", options->labels, "Who did what when: a file, or a folder of tag streams");
  command->add_option("-o,--output", options->output, "The moves file to write (YAML)")->required();
  AddOverwrite(*command, options->overwrite);
  AddStreamReading(*command, options->reading);
  command->footer(kTeachExamples);
  command->callback([=, &action] { action = [=] { return TeachCommand(*options); }; });
}

void DefineRecognise(CLI::App& app, Action& action) {
  auto options = std::make_shared<RecogniseCommandOptions>();
  CLI::App* command = app.add_subcommand("recognise", "Which moves a recording or a live stream shows");
  command->add_option("streams", options->streams, "Recordings, patterns, folders; - is standard input, live")
      ->required();
  auto* moves = command->add_option("--moves", options->moves, "What was taught (etude teach)");
  auto* labels = command->add_option("--labels", options->labels, "Score by these: a file, or a folder of tag streams");
  command
      ->add_flag("--leave-one-person-out", options->leave_one_person_out,
                 "Teach from the labels of all other people, person by person")
      ->excludes(moves);
  command->add_option("--recogniser", options->recogniser, "How (default: key-pose)")
      ->check(CLI::IsMember(RecogniserNames()));
  command->add_option("--filter", options->filter, "How joints are smoothed first")
      ->check(CLI::IsMember(FilterNames()))
      ->capture_default_str();
  command->add_option("--weights", options->weights, "How much an angle counts: all alike, or by how well it is seen")
      ->check(CLI::IsMember({"fixed", "adaptive"}))
      ->capture_default_str();
  command
      ->add_option("--threshold", options->threshold,
                   "Evidence from which on a move is called (default: the recogniser's)")
      ->check(NumberWithin(0.001, 1, "threshold"));
  command->add_option("--set", options->settings, "A setting of the recogniser: tolerance_scale=1.2")
      ->allow_extra_args(false);
  command->add_flag("--json", options->as_json, "Scores as JSON, too")->needs(labels);
  AddStreamReading(*command, options->reading);
  command->footer(kRecogniseExamples);
  command->callback([=, &action] { action = [=] { return RecogniseCommand(*options); }; });
}

}  // namespace etude
