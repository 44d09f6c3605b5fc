#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/tasks/base/task_kinds.h"
#include "engine/document/node.h"
#include "io/clips/clip_library.h"
#include "sim/choreography/move.h"
#include "tests/support/run_world.h"

namespace etude {

class TransitionFixture : public ::testing::Test {
 protected:
  static constexpr const char* kMethods = R"(
methods:
  - {name: now, choice: now}
  - {name: fuzzy}
  - {name: smallest, pick: smallest}
  - {name: smooth, join: inertialised-spring}
  - {name: end, choice: wait-for-end}
  - {name: never, threshold: 0}
)";

  static LibraryClip Builtin(const std::string& name) {
    auto move = LoadBuiltinMove(name);
    EXPECT_TRUE(move) << ToString(move.error());
    return {"builtin:" + name, "builtin:" + name, move->motion, *move};
  }

  static ClipLibrary EveryMove() {
    ClipLibrary library;
    for (const std::string& name : BuiltinMoveNames()) library.clips.push_back(Builtin(name));
    return library;
  }
  static ClipLibrary SmallLibrary() { return {{Builtin("sway"), Builtin("stretch"), Builtin("clap")}}; }

  static Result<std::unique_ptr<Task>> Make(const std::string& yaml, const ClipLibrary& library) {
    auto node = ParseYaml(yaml, "scenario.yaml");
    EXPECT_TRUE(node);
    Fields condition(*node, "a scenario");
    TaskInput input{condition, node->Find("methods")->items, library};
    return MakeTransitionTaskKind().make(input);
  }

  static WorldKey Trial(int trial) { return {.suite_seed = 1, .scenario = "test", .trial = trial}; }

  /// Runs all of kMethods in one world.
  static std::vector<CellResult> CellsOf(const Task& task, int trial, bool keeps_motion = false) {
    return RunWorld(task, Trial(trial), 6, keeps_motion);
  }

  static double ValueOf(const CellResult& cell, std::string_view id) {
    for (const MetricValue& metric : cell.metrics) {
      if (metric.id == id && metric.value) return *metric.value;
    }
    ADD_FAILURE() << "no value of " << id;
    return NAN;
  }
};

}  // namespace etude
