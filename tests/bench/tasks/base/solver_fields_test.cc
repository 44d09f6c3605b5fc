#include "bench/tasks/base/solver_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/document/node.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct Method {
  const IkSolver* solver = DefaultIkSolver();
  IkOptions options;
};

struct Reading {
  std::string solver;
  IkOptions options;
  std::string complaint;
};

Reading Read(const std::string& method) {
  const auto node = ParseYaml(method, "m.yaml");
  EXPECT_TRUE(node) << method;
  const FieldTable<Method> table{IkSolverFields(&Method::solver, &Method::options)};
  const auto read = ReadMapping(*node, "a method", table);
  if (!read) return {"", {}, ToString(read.error())};
  return {read->solver->name, read->options, ""};
}

TEST(SolverFields, TakeTheDefaultOfThePageOfKeys) {
  EXPECT_EQ(Read("{}").solver, "gauss-newton");
  EXPECT_EQ(Read("{}").solver, IkSolverFields(&Method::solver, &Method::options).front().info.fallback);
}

TEST(SolverFields, ReadTheSettingsOfASolver) {
  const Reading weighing = Read("{solver: ccd-anderson, weights: fixed-tuned, refresh: joint, memory: 3}");
  EXPECT_THAT(weighing.complaint, IsEmpty());
  EXPECT_EQ(weighing.options.weights, WeightRule::kFixedTuned);
  EXPECT_EQ(weighing.options.refresh, WeightRefresh::kJoint);
  EXPECT_EQ(weighing.options.solver_settings, SolverSettings{.memory = 3});
  const Reading by_default = Read("{first_sweeps: 4}");
  EXPECT_THAT(by_default.complaint, IsEmpty());
  EXPECT_EQ(by_default.options.solver_settings, SolverSettings{.first_sweeps = 4});
}

TEST(SolverFields, RefuseWhatASolverDoesNotHaveAndSayWhichOnesDo) {
  EXPECT_EQ(Read("{weights: fixed}").complaint,
            "m.yaml:1:11: solver 'gauss-newton' (the default) has no 'weights'; allowed with solver: ccd, ccd-hinges, "
            "ccd-anderson");
  EXPECT_EQ(Read("{solver: ccd, memory: 3}").complaint,
            "m.yaml:1:23: solver 'ccd' has no 'memory'; allowed with solver: ccd-anderson");
}

TEST(SolverFields, RefuseAFormerNameAndSayTheNewOne) {
  EXPECT_EQ(Read("{solver: ccd-nullspace}").complaint,
            "m.yaml:1:10: solver 'ccd-nullspace' was renamed to 'gauss-newton'");
}

TEST(SolverFields, RefuseValuesThatNoSolverTakes) {
  EXPECT_THAT(Read("{solver: cdc}").complaint, HasSubstr("did you mean 'ccd'?"));
  EXPECT_THAT(Read("{first_sweeps: 1.5}").complaint, HasSubstr("must be a whole number, found 1.5"));
  EXPECT_THAT(Read("{solver: ccd-anderson, memory: 0}").complaint, HasSubstr("0 is out of range; allowed: 1 to 20"));
  EXPECT_THAT(Read("{solver: jacobian-pinv, pinv_damping: .nan}").complaint, HasSubstr("expected a number"));
}

}  // namespace
}  // namespace etude
