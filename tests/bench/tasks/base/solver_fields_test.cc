#include "bench/tasks/base/solver_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/document/node.h"

namespace etude {
namespace {

struct Method {
  const IkSolver* solver = DefaultIkSolver();
  IkOptions options;
};

struct Reading {
  std::string solver;
  IkOptions options;
};

Reading Read(const std::string& method) {
  const auto node = ParseYaml(method, "m.yaml");
  EXPECT_TRUE(node) << method;
  const FieldTable<Method> table{IkSolverFields(&Method::solver, &Method::options)};
  const auto read = ReadMapping(*node, "a method", table);
  EXPECT_TRUE(read) << ToString(read.error());
  return {read->solver->name, read->options};
}

TEST(SolverFields, TakeTheDefaultOfThePageOfKeys) {
  EXPECT_EQ(Read("{}").solver, "gauss-newton");
  EXPECT_EQ(Read("{}").solver, IkSolverFields(&Method::solver, &Method::options).front().info.fallback);
}

TEST(SolverFields, ReadTheSettingsOfASolver) {
  const Reading weighing = Read("{solver: ccd-anderson, weights: fixed-tuned, refresh: joint, memory: 3}");
  EXPECT_EQ(weighing.options.weights, WeightRule::kFixedTuned);
  EXPECT_EQ(weighing.options.refresh, WeightRefresh::kJoint);
  EXPECT_EQ(weighing.options.solver_settings, SolverSettings{.memory = 3});
  EXPECT_EQ(Read("{first_sweeps: 4}").options.solver_settings, SolverSettings{.first_sweeps = 4});
}

}  // namespace
}  // namespace etude
