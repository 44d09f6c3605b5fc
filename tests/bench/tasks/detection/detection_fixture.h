#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/tasks/base/task_kinds.h"
#include "io/clips/clip_library.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/support/run_world.h"

namespace etude {

class DetectionFixture : public ::testing::Test {
 protected:
  static constexpr const char* kFourMethods = R"(
methods:
  - {name: fixed, weights: fixed}
  - {name: adaptive, weights: adaptive}
  - {name: fixed-holt, filter: holt}
  - {name: adaptive-euro, filter: one-euro, weights: adaptive}
)";

  /// Makes a task from a scenario's text, which must live only until this function returns.
  static Result<std::unique_ptr<Task>> MakeTask(const std::string& yaml, const ClipLibrary& clips) {
    ASSIGN_OR_RETURN(auto node, ParseYaml(yaml, "test.yaml"));
    Fields condition(node, "a detection scenario");
    TaskInput input{condition, node.Find("methods")->items, clips};
    return MakeDetectionTaskKind().make(input);
  }

  static ClipLibrary FourMoves() {
    return *LoadClips({"builtin:clap", "builtin:boxing", "builtin:sway", "builtin:side_kick"}, {});
  }

  /// Returns a clip as a user's file gives it, without a known move.
  static LibraryClip Unlabelled() {
    LibraryClip clip{.name = "walk", .motion = FourMoves().clips.front().motion};
    return clip;
  }

  static WorldKey World(int trial) { return {.suite_seed = 1, .scenario = "detection-test", .trial = trial}; }

  /// Runs all of kFourMethods in one world.
  static std::vector<CellResult> CellsOf(const Task& task, int trial, bool keeps_motion = false) {
    return RunWorld(task, World(trial), 4, keeps_motion);
  }
};

}  // namespace etude
