#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/stream_reading.h"
#include "engine/base/names.h"
#include "engine/teaching/moves_file.h"
#include "engine/teaching/teach_moves.h"
#include "io/files/files.h"

namespace etude {
namespace {

struct TeachCommandOptions {
  std::vector<std::string> streams;
  std::string labels;                ///< a file of labels; "" = each file is one move
  std::vector<std::string> without;  ///< moves to leave out
  std::string output;
  bool overwrite = false, as_json = false;
  StreamArguments reading;
};

constexpr const char* kTeachText =
    "\n"
    "Writes a moves file, which a recogniser needs: for each move, key poses with tolerances, and the recorded\n"
    "performances. Without labels, each file is one performance of a move, and the file's name is the move's name. "
    "Labels\n"
    "are a CSV (clip,from_s,to_s,move,truth and optionally person), tag streams of MSRC-12, or action labels of "
    "UTKinect;\n"
    "docs/streams.md explains these formats.";

Result<std::vector<TaughtMove>> Teach(const TeachCommandOptions& options) {
  ASSIGN_OR_RETURN(auto loaded, options.reading.Load(options.streams));
  for (const Error& refused : loaded.refused) fmt::print(stderr, "left out: {}\n", ToString(refused));
  for (const NamedStream& stream : loaded.streams)
    fmt::print(stderr, "{}\n", ToString(Error{{stream.source}, stream.description}));
  ASSIGN_OR_RETURN(const auto parts, LoadParts(options.labels, loaded.streams));
  // Leave out the moves that --without names; each of these moves must exist.
  std::set<std::string> moves;
  for (const LabelledPart& part : parts) moves.insert(part.move);
  const std::vector<std::string> names(moves.begin(), moves.end());
  for (const std::string& name : options.without) {
    if (!moves.contains(name)) return Fail({"--without"}, "{}", UnknownName("move", name, names));
  }
  const auto takes = [&](const LabelledPart& part) {
    return std::ranges::find(options.without, part.move) == options.without.end();
  };
  ASSIGN_OR_RETURN(auto taught, TeachMoves(loaded.streams, parts, takes, true));
  // Files show whole milliseconds: 3.9, not 3.9000000000000004.
  constexpr double kMs = 1000;
  for (TaughtMove& move : taught) move.span_s = std::round(kMs * move.span_s) / kMs;
  return taught;
}

std::string TargetsText(const TaughtPose& pose) {
  std::vector<std::string> targets;
  for (const PoseTarget& target : pose.targets) {
    targets.push_back(
        fmt::format("{} {:.0f}° ± {:.0f}°", FeatureName(target.feature), target.degrees, target.tolerance_deg));
  }
  return Join(targets);
}

Json FactsOf(const std::vector<TaughtMove>& moves) {
  Json all = Json::array();
  for (const TaughtMove& move : moves) {
    Json poses = Json::array();
    for (const TaughtPose& pose : move.poses) {
      Json targets = Json::array();
      for (const PoseTarget& target : pose.targets) {
        targets.push_back({{"feature", FeatureName(target.feature)},
                           {"angle_deg", target.degrees},
                           {"tolerance_deg", target.tolerance_deg}});
      }
      poses.push_back(std::move(targets));
    }
    all.push_back({{"move", move.name},
                   {"right", move.examples.size()},
                   {"wrong", move.counter_examples.size()},
                   {"span_s", move.span_s},
                   {"poses", std::move(poses)}});
  }
  return all;
}

Result<int> TeachCommand(const TeachCommandOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  ASSIGN_OR_RETURN(const auto moves, Teach(options));
  const std::string text = "# Learnt by `etude teach`\n" + WriteMoves(moves);
  RETURN_IF_ERROR(ReadMoves(text, options.output));  // write the file only if it can be read back
  RETURN_IF_ERROR(WriteFileAtomically(options.output, text));
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("teach", {{"moves", FactsOf(moves)}, {"output", options.output}}));
    return kSuccess;
  }
  for (const TaughtMove& move : moves) {
    fmt::print("{}: {} right, {} wrong, up to {:.1f} s\n", move.name, move.examples.size(),
               move.counter_examples.size(), move.span_s);
    for (const TaughtPose& pose : move.poses) fmt::print("  {}\n", TargetsText(pose));
  }
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace

void DefineTeach(CLI::App& app, Action& action) {
  auto options = std::make_shared<TeachCommandOptions>();
  CLI::App* command =
      app.add_subcommand("teach", "Learn moves from recordings and clips, for `etude recognise` and `etude coach`");
  command->add_option("streams", options->streams, "Recordings, clips, patterns of file names, or folders")->required();
  command->add_option("--labels", options->labels,
                      "Labels (which person performed which move, and when): a file, or a folder of tag streams");
  command->add_option("--without", options->without, "A move to leave out")->allow_extra_args(false);
  command->add_option("-o,--output", options->output, "The moves file to write (YAML)")->required();
  AddOverwrite(*command, options->overwrite);
  AddJson(*command, options->as_json);
  AddStreamReading(*command, options->reading);
  command->footer(kTeachText);
  command->callback([=, &action] { action = [=] { return Finish(TeachCommand(*options)); }; });
}

}  // namespace etude
