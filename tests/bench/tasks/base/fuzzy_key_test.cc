#include "bench/tasks/base/fuzzy_key.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using ::testing::HasSubstr;

Result<std::string> NoFile(const std::string& file) { return Fail({file, 0, 0}, "is not asked for"); }

TEST(FuzzyKey, NamesThePapersSystemUnlessAnotherIsNamed) {
  EXPECT_EQ(OpenFuzzySystem("builtin:paper", {}, NoFile)->name, FuzzySystem{}.name);
  EXPECT_EQ(OpenFuzzySystem("builtin:gaussian", {}, NoFile)->name, "gaussian");
  EXPECT_EQ(FuzzyKey().fallback, "builtin:paper");
}

TEST(FuzzyKey, ReadsAFileUnderItsOwnName) {
  FuzzySystem mine;
  mine.name = "mine";
  const auto text = [&](const std::string&) -> Result<std::string> { return WriteFuzzySystem(mine); };
  EXPECT_TRUE(FuzzyKey().value.names_file("mine.yaml"));
  EXPECT_FALSE(FuzzyKey().value.names_file("builtin:gaussian"));
  EXPECT_EQ(OpenFuzzySystem("mine.yaml", {}, text)->name, "mine");
  const auto broken = OpenFuzzySystem("mine.yaml", {"s.yaml", 4, 8}, [](const std::string&) -> Result<std::string> {
    return "system: x\nfeature: 1\n";
  });
  EXPECT_THAT(ToString(broken.error()), HasSubstr("mine.yaml:1:1: a fuzzy system needs 'features'"));
}

TEST(FuzzyKey, ComplainsOfAnUnknownNameWhereItIsAskedFor) {
  EXPECT_THAT(ToString(OpenFuzzySystem("builtin:gausian", {"s.yaml", 4, 8}, NoFile).error()),
              HasSubstr("s.yaml:4:8: unknown fuzzy system 'gausian'; did you mean 'gaussian'?"));
}

}  // namespace
}  // namespace etude
