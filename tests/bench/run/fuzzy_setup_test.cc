#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "bench/run/setup.h"
#include "bench/run/suite.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// A folder with a scenario that uses `fuzzy`; it is removed after the test.
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
  ASSERT_OK(suite, Suite("transition", "fuzzy: " + mine));
  EXPECT_EQ(suite->sources.at(mine), WriteFuzzySystem(FuzzySystem{}));
  std::filesystem::remove(mine);
  const auto prepared = PrepareAll(*suite);
  EXPECT_TRUE(prepared) << ToString(prepared.error());
  SuiteSetup without = *suite;
  without.sources.erase(mine);
  EXPECT_FALSE(PrepareAll(without)) << "the control";
}

TEST_F(FuzzySetup, MakesATaskOfEverySystemThatIsSwept) {
  ASSERT_OK(suite, Suite("transition", "sweep: {fuzzy: ['builtin:paper', 'builtin:gaussian']}"));
  ASSERT_OK(prepared, PrepareAll(*suite));
  EXPECT_EQ(prepared->front().scenario().conditions.size(), 2u);
  ASSERT_OK(unknown, Suite("transition", "sweep: {fuzzy: ['builtin:paper', 'builtin:papper']}"));
  EXPECT_THAT(ToString(PrepareAll(*unknown).error()), HasSubstr("did you mean 'paper'?"));
}

TEST_F(FuzzySetup, ComplainsWhereAFileIsNamedAndWhereItIsWrong) {
  EXPECT_THAT(testing::Refusal(Suite("transition", "fuzzy: no_such.yaml")), HasSubstr("s.yaml:4:8: no_such.yaml"));
  const std::string mine = Write("mine.yaml", "system: mine\nfeatures:\n  RX: {}\n");
  ASSERT_OK(suite, Suite("transition", "fuzzy: " + mine));
  EXPECT_THAT(ToString(PrepareAll(*suite).error()), HasSubstr("mine.yaml:3:3: unknown feature 'RX'"));
}

TEST_F(FuzzySetup, IsRefusedByATaskThatGradesNoPoses) {
  EXPECT_THAT(testing::Refusal(Suite("ik", "fuzzy: builtin:paper")), HasSubstr("'fuzzy'"));
}

}  // namespace
}  // namespace etude
