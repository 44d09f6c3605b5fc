#include "reports/badge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

MethodFinding Found(SamplingUnit unit, bool here_only, std::optional<Verdict> beyond) {
  MethodFinding finding{.method = "b", .baseline = "a", .unit = unit, .is_compared = true};
  finding.verdict = Verdict::kBetter;
  finding.beyond.on_these_only = here_only;
  finding.beyond.verdict = beyond;
  finding.beyond.as_on_these = beyond == Verdict::kBetter;
  return finding;
}

TEST(Badges, NameBothVerdicts) {
  const std::string differ = VerdictBadges(Found(SamplingUnit::kClip, false, Verdict::kUndecided));
  EXPECT_THAT(differ, HasSubstr("badge better"));
  EXPECT_THAT(differ, HasSubstr("</span> better on these clips</span>"));
  EXPECT_THAT(differ, HasSubstr("badge open"));
  EXPECT_THAT(differ, HasSubstr("</span> undecided for other clips</span>"));
  EXPECT_THAT(VerdictBadges(Found(SamplingUnit::kClip, true, std::nullopt)), HasSubstr("no verdict for other clips"));
  EXPECT_THAT(VerdictBadges(Found(SamplingUnit::kWorld, false, Verdict::kBetter)),
              HasSubstr("better on these worlds and others"));
  MethodFinding alone = Found(SamplingUnit::kClip, false, Verdict::kBetter);
  alone.is_compared = false;
  EXPECT_EQ(VerdictBadges(alone), "") << "nothing was compared";
}

TEST(Badges, PutWhatHoldsHereOnlyInBrackets) {
  Comparison c;
  c.verdict = Verdict::kBetter;
  EXPECT_EQ(ComparisonSign(c), "(▲)");
  EXPECT_THAT(ComparisonMark(c, SamplingUnit::kClip), HasSubstr("aria-label=\"better, on these clips only\""));
  c.beyond.verdict = Verdict::kUndecided;
  EXPECT_EQ(ComparisonSign(c), "(▲)");
  c.beyond.verdict = Verdict::kBetter;
  EXPECT_EQ(ComparisonSign(c), "▲");
  c.verdict = Verdict::kUndecided;
  EXPECT_EQ(ComparisonSign(c), "?");
  EXPECT_THAT(FindingBadge(Found(SamplingUnit::kClip, true, std::nullopt), "baseline"),
              HasSubstr(">(▲)</span> baseline"));
  EXPECT_THAT(FindingBadge(Found(SamplingUnit::kClip, false, Verdict::kBetter), "baseline"),
              HasSubstr(">▲</span> baseline"));
  EXPECT_EQ(FindingBadge(MethodFinding{}, "baseline"), "");
}

TEST(Badges, NeverShowUndecidedAsNoDifference) {
  for (const auto& verdict : {std::optional(Verdict::kUndecided), std::optional<Verdict>()}) {
    EXPECT_NE(VerdictSign(verdict), VerdictSign(Verdict::kNoDifference));
    EXPECT_THAT(VerdictBadge(verdict), Not(HasSubstr("badge same")));
  }
}

}  // namespace
}  // namespace etude
