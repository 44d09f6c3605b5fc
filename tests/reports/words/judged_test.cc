#include "reports/words/judged.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Comparison OnClips(Verdict here, std::optional<Verdict> beyond, int clips) {
  Comparison c;
  c.metric = "mpjpe_mm";
  c.verdict = here;
  c.beyond.verdict = beyond;
  c.beyond.units = clips;
  c.beyond.difference = -4.5;
  c.beyond.low = -6;
  c.beyond.high = -3;
  return c;
}

BeyondFinding InWords(const std::vector<Comparison>& comparisons, SamplingUnit unit) {
  static const ConditionSummary condition;
  std::vector<Judged> judged;
  for (const Comparison& c : comparisons) judged.push_back({&c, &condition});
  return BeyondInWords(judged, unit);
}

TEST(Beyond, SaysHowManyClipsCarryIt) {
  const BeyondFinding found = InWords({OnClips(Verdict::kBetter, Verdict::kBetter, 12)}, SamplingUnit::kClip);
  EXPECT_EQ(found.words, "for other clips: better (pseudo-median of 12 clips: −4.50 mm, 95 % CI −6.00 to −3.00)");
  EXPECT_TRUE(found.as_on_these);
  EXPECT_FALSE(found.on_these_only);
}

TEST(Beyond, OfTooFewClipsIsNoVerdictAndSaysWhatIsNeeded) {
  Comparison few = OnClips(Verdict::kBetter, std::nullopt, 4);
  few.beyond.why_open = "4 clips, 6 are needed";
  const BeyondFinding found = InWords({few}, SamplingUnit::kClip);
  EXPECT_EQ(found.words, "on these clips only (4 clips, 6 are needed)");
  EXPECT_TRUE(found.on_these_only);
  EXPECT_FALSE(found.as_on_these);
  EXPECT_EQ(ShortBeyond(few, SamplingUnit::kClip), "on these clips only (4 clips)");
  EXPECT_EQ(ShortBeyond(OnClips(Verdict::kBetter, Verdict::kWorse, 9), SamplingUnit::kClip), "worse");
}

TEST(Beyond, OfAnOlderRunClaimsNothing) {
  Comparison old;
  old.metric = "mpjpe_mm";
  old.verdict = Verdict::kBetter;
  const BeyondFinding found = InWords({old}, SamplingUnit::kLibrary);
  EXPECT_EQ(found.words, "on these libraries only");
  EXPECT_TRUE(found.on_these_only);
}

TEST(Beyond, SaysWhyItIsOpen) {
  Comparison open = OnClips(Verdict::kBetter, Verdict::kUndecided, 7);
  open.beyond.why_open = "too few clips";
  const BeyondFinding found = InWords({open}, SamplingUnit::kClipPair);
  EXPECT_THAT(found.words, HasSubstr("for other clips: undecided (pseudo-median of 7 clips"));
  EXPECT_THAT(found.words, ::testing::EndsWith(": too few clips"));
  EXPECT_FALSE(found.as_on_these);
}

TEST(Beyond, CountsConditions) {
  const BeyondFinding found =
      InWords({OnClips(Verdict::kBetter, Verdict::kBetter, 9), OnClips(Verdict::kBetter, Verdict::kUndecided, 9),
               OnClips(Verdict::kBetter, std::nullopt, 3)},
              SamplingUnit::kClip);
  EXPECT_EQ(found.words, "for other clips: better under 1 of 3, undecided under 1 of 3, no verdict under 1 of 3");
  EXPECT_FALSE(found.verdict.has_value());
}

TEST(Beyond, SaysTheSameOnlyOnceWhereEveryWorldIsItsOwnUnit) {
  EXPECT_EQ(InWords({OnClips(Verdict::kWorse, Verdict::kWorse, 20)}, SamplingUnit::kWorld).words,
            "for other worlds of the same kind: the same verdict");
  EXPECT_THAT(InWords({OnClips(Verdict::kWorse, Verdict::kUndecided, 20)}, SamplingUnit::kPerson).words,
              HasSubstr("for other people: undecided"));
}

TEST(Yardstick, IsAMethodThatIsComparedWithNone) {
  const RunData run = ExampleRun();
  ScenarioSummary scenario = run.scenarios.front();
  for (const std::string& method : scenario.methods) EXPECT_FALSE(IsYardstick(scenario, method)) << method;
  std::erase_if(scenario.conditions[0].comparisons, [](const Comparison& c) { return c.method == "wait-for-end"; });
  EXPECT_TRUE(IsYardstick(scenario, "wait-for-end"));
  EXPECT_EQ(MethodLabel(scenario, "wait-for-end"), "wait-for-end (yardstick)");
  EXPECT_EQ(MethodLabel(scenario, "now"), "now");

  const ScenarioFindings findings = FindingsOf(run, scenario);
  EXPECT_EQ(findings.yardsticks, std::vector<std::string>{"wait-for-end"});
  EXPECT_EQ(findings.methods.size(), 3u);
  EXPECT_EQ(findings.answer.method, "fuzzy-bridge");  // the next method answers the question
}

TEST(Yardstick, IsNobodysBaseline) {
  ScenarioSummary scenario = ExampleRun().scenarios.front();
  std::vector<Comparison>& comparisons = scenario.conditions[0].comparisons;
  std::erase_if(comparisons, [](const Comparison& c) { return c.method == "wait-for-end"; });
  comparisons.front().baseline = "wait-for-end";
  EXPECT_FALSE(IsYardstick(scenario, "wait-for-end"));
  EXPECT_TRUE(IsComparedWithNone(scenario, "wait-for-end"));
  const ScenarioFindings findings = FindingsOf(ExampleRun(), scenario);
  EXPECT_TRUE(findings.yardsticks.empty());
  EXPECT_EQ(findings.methods.size(), 3u);  // like a yardstick, a mere baseline gets no verdict
}

TEST(Yardstick, IsNobodyWhereNothingIsCompared) {
  ScenarioSummary scenario = ExampleRun().scenarios.front();
  scenario.conditions[0].comparisons.clear();
  scenario.headline_metrics.clear();
  EXPECT_FALSE(IsYardstick(scenario, "wait-for-end"));
}

TEST(LeftOut, IsSaidOnlyWhenSomethingIs) {
  EXPECT_EQ(LeftOutWords(40, 40, "methods", "a file"), "");
  EXPECT_EQ(LeftOutWords(1240, 40, "methods", "a file"),
            "1,200 more methods are not shown here; all of them are in a file.");
  EXPECT_EQ(LeftOutHtml(41, 40, "methods", "<a>"),
            "<p class=\"quiet legend\">1 more methods are not shown here; all of them are in &lt;a&gt;.</p>");
}

}  // namespace
}  // namespace etude
