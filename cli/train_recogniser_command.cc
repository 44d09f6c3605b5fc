#include <fmt/core.h>

#include "bench/clips/clip_library.h"
#include "bench/files/files.h"
#include "bench/tasks/detection/train_recogniser.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/train_command.h"
#include "engine/base/named.h"
#include "engine/base/names.h"

namespace etude {
namespace {

Result<void> TrainIntoFile(const TrainOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  ASSIGN_OR_RETURN(const auto references, ExpandAll(options.clips));
  ASSIGN_OR_RETURN(const auto reading, ReadOptions(options.reading));
  ASSIGN_OR_RETURN(const ClipLibrary library, LoadClips(references, {}, reading));
  const Repertoire repertoire = RepertoireOf(library);
  if (repertoire.taught.size() < 2) {
    return Fail({}, "{} labelled clips; a recogniser learns from two at least", repertoire.taught.size());
  }
  const LearntModel model = TrainRecogniser(repertoire, {.sessions = options.sessions, .seed = options.seed});
  const std::string header = fmt::format(
      "# What the recogniser `learnt` knows, by `etude train --recogniser --sessions {} --seed {}` of\n#   {}\n"
      "# Trees: measure and limit of each question, then what the answers add to the log-odds of \"right\".\n",
      options.sessions, options.seed, Join(NamesOf(repertoire.taught)));
  return WriteFileAtomically(options.output, header + WriteLearntModel(model));
}

}  // namespace

int TrainRecogniserCommand(const TrainOptions& options) {
  const auto done = TrainIntoFile(options);
  if (!done) return Complain(done.error());
  fmt::print("written: {}\n", options.output);
  return kSuccess;
}

}  // namespace etude
