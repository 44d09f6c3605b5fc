#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "bench/run/setup.h"
#include "bench/run/suite.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// A folder with a scenario that names `fuzzy`, gone when the test is.
class FuzzySetup : public ::testing::Test {
 protected:
  std::string Write(const std::string& name, const std::string& text) {
    const std::string path = (folder_.path() / name).string();
    EXPECT_TRUE(WriteFileAtomically(path, text));
    return path;
  }

  Result<SuiteSetup> Suite(const std::string& task, const std::string& fuzzy) {
    const std::string method = task == "ik" ? "{name: a, solver: ccd, weights: fixed}" : "{name: a}";
    RunOptions options;
    options.scenarios = {Write("s.yaml", fmt::format("scenario: s\nquestion: q\ntask: {}\n{}\ntrials: 1\n"
                                                     "clips: ['builtin:clap', 'builtin:sway']\nmethods: [{}]\n",
                                                     task, fuzzy, method))};
    return ReadSuite(options);
  }

  TemporaryFolder folder_ = *TemporaryFolder::Make("fuzzy-setup-test");
};

TEST_F(FuzzySetup, KeepsTheTextOfEveryNamedFileSoThatTheFileMayGo) {
  const std::string mine = Write("mine.yaml", WriteFuzzySystem(FuzzySystem{}));
  const auto suite = Suite("transition", "fuzzy: " + mine);
  ASSERT_TRUE(suite) << ToString(suite.error());
  EXPECT_EQ(suite->sources.at(mine), WriteFuzzySystem(FuzzySystem{}));
  std::filesystem::remove(mine);
  const auto prepared = PrepareAll(*suite);
  EXPECT_TRUE(prepared) << ToString(prepared.error());
  SuiteSetup without = *suite;
  without.sources.erase(mine);
  EXPECT_FALSE(PrepareAll(without)) << "the control";
}

TEST_F(FuzzySetup, MakesATaskOfEverySystemThatIsSwept) {
  const auto suite = Suite("transition", "sweep: {fuzzy: ['builtin:paper', 'builtin:gaussian']}");
  ASSERT_TRUE(suite) << ToString(suite.error());
  const auto prepared = PrepareAll(*suite);
  ASSERT_TRUE(prepared) << ToString(prepared.error());
  EXPECT_EQ(prepared->front().scenario().conditions.size(), 2u);
  const auto unknown = Suite("transition", "sweep: {fuzzy: ['builtin:paper', 'builtin:papper']}");
  ASSERT_TRUE(unknown) << ToString(unknown.error());
  EXPECT_THAT(ToString(PrepareAll(*unknown).error()), HasSubstr("did you mean 'paper'?"));
}

TEST_F(FuzzySetup, ComplainsWhereAFileIsNamedAndWhereItIsWrong) {
  const auto missing = Suite("transition", "fuzzy: no_such.yaml");
  ASSERT_FALSE(missing);
  EXPECT_THAT(ToString(missing.error()), HasSubstr("s.yaml:4:8: no_such.yaml"));
  const std::string mine = Write("mine.yaml", "system: mine\nfeatures:\n  RX: {}\n");
  const auto suite = Suite("transition", "fuzzy: " + mine);
  ASSERT_TRUE(suite) << ToString(suite.error());
  EXPECT_THAT(ToString(PrepareAll(*suite).error()), HasSubstr("mine.yaml:3:3: unknown feature 'RX'"));
}

TEST_F(FuzzySetup, IsRefusedByATaskThatGradesNoPoses) {
  const auto suite = Suite("ik", "fuzzy: builtin:paper");
  ASSERT_FALSE(suite);
  EXPECT_THAT(ToString(suite.error()), HasSubstr("'fuzzy'"));
}

}  // namespace
}  // namespace etude
