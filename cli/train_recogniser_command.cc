#include <fmt/core.h>

#include <string>
#include <utility>

#include "bench/clips/clip_library.h"
#include "bench/files/files.h"
#include "bench/tasks/coach/train_coached.h"
#include "bench/tasks/detection/train_recogniser.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "cli/train_command.h"
#include "engine/base/named.h"
#include "engine/base/names.h"

namespace etude {
namespace {

/// A model, and what made it.
struct Trained {
  LearntModel model;
  std::string header;
};

constexpr const char* kHeader =
    "# What the recogniser `{}` knows, by `etude train --{} --sessions {} --seed {}` of\n#   {}\n"
    "# Trees: measure and limit of each question, then what the answers add to the log-odds of \"right\".\n";

Result<Trained> TrainLearnt(const TrainOptions& options) {
  ASSIGN_OR_RETURN(const auto references, ExpandAll(options.clips));
  ASSIGN_OR_RETURN(const auto reading, ReadOptions(options.reading));
  ASSIGN_OR_RETURN(const ClipLibrary library, LoadClips(references, {}, reading, TellOf("clips read")));
  const Repertoire repertoire = RepertoireOf(library);
  if (repertoire.taught.size() < 2) {
    return Fail({}, "{} labelled clips; a recogniser learns from two at least", repertoire.taught.size());
  }
  RecogniserTraining training{.seed = options.seed, .progress = TellOf("sessions")};
  training.sessions = options.sessions.value_or(training.sessions);
  return Trained{TrainRecogniser(repertoire, training), fmt::format(kHeader, "learnt", "recogniser", training.sessions,
                                                                    training.seed, Join(NamesOf(repertoire.taught)))};
}

Result<Trained> TrainCoachedOf(const TrainOptions& options) {
  CoachedTraining training{.seed = options.seed, .progress = TellOf("sessions")};
  training.sessions = options.sessions.value_or(training.sessions);
  ASSIGN_OR_RETURN(LearntModel model, TrainCoached(options.clips, training));
  return Trained{std::move(model),
                 fmt::format(kHeader, "coached", "coached", training.sessions, training.seed, Join(options.clips))};
}

Result<void> TrainIntoFile(const TrainOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  ASSIGN_OR_RETURN(const Trained trained, options.coached ? TrainCoachedOf(options) : TrainLearnt(options));
  return WriteFileAtomically(options.output, trained.header + WriteLearntModel(trained.model));
}

}  // namespace

int TrainRecogniserCommand(const TrainOptions& options) {
  const auto done = TrainIntoFile(options);
  if (!done) return Complain(done.error());
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace etude
