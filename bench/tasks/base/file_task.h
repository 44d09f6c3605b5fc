#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/tasks/base/task.h"
#include "engine/base/names.h"
#include "io/clips/clip_file.h"

namespace etude {

/// The data that all worlds of one condition share in a task that judges files.
template <typename Options, typename Method>
struct FileStudy {
  Options options;
  std::vector<Method> methods;
  std::vector<JudgedFiles> files;  ///< the files of each trial's world
  OpenOptions opening;

  /// Copies the files from the input. Fails if the number of a world's answers differs from the number of methods.
  Result<void> TakeFiles(const TaskInput& input) {
    files.assign(input.files.begin(), input.files.end());
    if (input.opening != nullptr) opening = *input.opening;
    for (const JudgedFiles& world : files) {
      if (world.answers.size() == methods.size()) continue;
      return Fail(input.condition.node().place, "world {} has {} answers, but the scenario has {} methods",
                  Quote(world.name), world.answers.size(), methods.size());
    }
    return {};
  }
};

/// Returns the error for every request that only outside programs need, such as a problem or a truth. A task that
/// judges files runs no such programs.
inline tl::unexpected<Error> FailOfFileTask() { return Fail({}, "a task that judges files runs no program"); }

/// A world of a task that judges files. It sends no problem to a program.
class FileWorld : public TaskWorld {
 public:
  Result<Payload> MakeProblem() final { return FailOfFileTask(); }
  Result<Payload> MakeTruth() final { return FailOfFileTask(); }
  Result<CellResult> Judge(const Json& /*answer*/) final { return FailOfFileTask(); }
};

/// A task that judges files. The constructor of `World` receives the study, a world's files, and a flag that is true if
/// the world's cells keep their motion.
template <typename Study, typename World>
class FileTask final : public Task {
 public:
  explicit FileTask(Study study) : study_(std::move(study)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    return std::make_unique<World>(study_, FilesOf(key), keeps_motion);
  }
  std::vector<std::string> ClipsOf(const WorldKey& key) const override { return {FilesOf(key).name}; }
  Result<Payload> Setting() const override { return FailOfFileTask(); }

 private:
  const JudgedFiles& FilesOf(const WorldKey& key) const { return study_.files[static_cast<std::size_t>(key.trial)]; }

  const Study study_;
};

}  // namespace etude
