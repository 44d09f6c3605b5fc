#include "bench/scenario/sources.h"

#include <filesystem>

#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/bench/scenario/parse.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const std::string kTwo =
    "include: [shared/all.yaml, more.yaml]\n"
    "defaults: {question: q, task: ik, trials: 7, methods: [{name: a}]}\n"
    "scenarios:\n"
    "  - {scenario: one}\n"
    "  - {scenario: two, trials: 9, max_sweeps: 4}\n";
const SourceTexts kIncluded = {
    {"shared/all.yaml", "include: [deep.yaml]\ndefaults: {trials: 1, seed: 2, max_sweeps: 5}\n"},
    {"shared/deep.yaml", "defaults: {seed: 1, noise: uniform, stop_at: tight}\n"},
    {"more.yaml", "defaults: {max_sweeps: 6, poses: {uniform: 1}}\n"}};

TEST(Sources, LetsTheNearerFileWin) {
  ASSERT_OK(scenarios, Parse(kTwo, kIncluded));
  ASSERT_EQ(scenarios->size(), 2u);
  const Scenario &one = (*scenarios)[0], &two = (*scenarios)[1];
  EXPECT_EQ(one.name, "one");
  EXPECT_EQ(one.trials, 7);  // the file's defaults override shared/all.yaml
  EXPECT_EQ(two.trials, 9);  // the scenario's own value overrides the file's
  EXPECT_EQ(one.seed, 2u);   // shared/all.yaml overrides shared/deep.yaml
  const auto value = [](const Scenario& scenario, const char* key) {
    return scenario.conditions[0].node.Find(key)->scalar;
  };
  EXPECT_EQ(value(one, "max_sweeps"), "6");  // a later include overrides an earlier one
  EXPECT_EQ(value(two, "max_sweeps"), "4");
  EXPECT_EQ(value(one, "noise"), "uniform");
}

TEST(Sources, ReplacesAKeyWholeAndNeverMerges) {
  ASSERT_OK(scenarios,
            Parse("defaults: {limits: {time_s: 5, memory_mb: 100}}\n"
                  "scenarios: [{scenario: s, question: q, task: ik, methods: [{name: a}], limits: {time_s: 7}}]\n"));
  EXPECT_EQ(scenarios->front().limits.time_s, 7);
  EXPECT_EQ(scenarios->front().limits.memory_mb, Limits{}.memory_mb);
}

TEST(Sources, LetsASingleScenarioInclude) {
  ASSERT_OK(scenarios, Parse("include: [more.yaml]\n" + kHead + kMethods, {{"more.yaml", "defaults: {trials: 3}\n"}}));
  EXPECT_EQ(scenarios->front().trials, 3);
}

TEST(Sources, RefusesAnAvalancheOfIncludes) {
  SourceTexts deep;
  for (int i = 0; i < 50; ++i) deep[fmt::format("{}.yaml", i)] = fmt::format("include: [{}.yaml]\n", i + 1);
  EXPECT_THAT(Complaint("include: [0.yaml]\n" + kHead, deep), HasSubstr("nested more than 8 files deep"));
  SourceTexts wide;  // 12^7 inclusions of 7 small files
  for (int i = 0; i < 7; ++i) {
    std::string list;
    for (int k = 0; k < 12; ++k) list += fmt::format("{}.yaml,", i + 1);
    wide[fmt::format("{}.yaml", i)] = "include: [" + list + "]\n";
  }
  wide["7.yaml"] = "defaults: {}\n";
  EXPECT_THAT(Complaint("include: [0.yaml]\n" + kHead, wide), HasSubstr("more than 100 inclusions"));
}

TEST(Sources, RefusesCopiesThatWouldFillTheMemory) {
  std::string many = "a";
  for (int i = 0; i < 3000; ++i) many += ",a";
  const std::string head = "defaults: {question: q, task: ik, methods: [{name: a}], ";
  std::string scenarios = "scenarios:\n";
  for (int i = 0; i < 500; ++i) scenarios += fmt::format("  - {{scenario: s{}}}\n", i);
  EXPECT_THAT(Complaint(head + "clips: [" + many + "]}\n" + scenarios), HasSubstr("at most 300000 values in all"));
  EXPECT_THAT(Complaint(head + "sweep: {poses: {from: 0, to: 1, count: 1000}}}\n" + scenarios),
              HasSubstr("the conditions of the file have more than 300000 values"));
}

TEST(Sources, ReadsFilesAndAllThatTheyInclude) {
  ASSERT_OK(made, TemporaryFolder::Make("sources"));
  const std::filesystem::path folder = made->path();
  const auto write = [&](const std::string& name, const std::string& text) {
    ASSERT_TRUE(WriteFileAtomically(folder / name, text));
  };
  const std::string main = (folder / "main.yaml").string();
  write("main.yaml", kTwo);
  SourceTexts texts;
  const auto missing = ReadScenarios(main, texts);
  EXPECT_THAT(testing::Refusal(missing), HasSubstr("main.yaml:1:11: "));
  EXPECT_THAT(testing::Refusal(missing), HasSubstr("all.yaml"));
  for (const auto& [name, text] : kIncluded) write(name, text);
  ASSERT_OK(read, ReadScenarios(main, texts));
  EXPECT_EQ(read->size(), 2u);
  EXPECT_EQ(texts.size(), 4u);
  EXPECT_EQ(texts.count((folder / "shared/deep.yaml").string()), 1u);
  EXPECT_EQ(ParseScenarios(main, texts)->size(), 2u);
}

}  // namespace
}  // namespace etude
