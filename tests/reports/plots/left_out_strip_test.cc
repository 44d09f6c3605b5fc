#include "reports/plots/estimation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/count_of.h"

namespace etude {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

/// A difference of mpjpe_mm, of which 1 mm matters, with and without each of three clips.
Comparison Differing(double all, std::vector<double> without) {
  Comparison c;
  c.metric = "mpjpe_mm";
  c.method = "adaptive";
  c.baseline = "fixed";
  c.beyond.difference = all;
  const char* names[] = {"a", "b", "<c>"};
  for (std::size_t i = 0; i < without.size(); ++i) c.beyond.left_out.push_back({names[i], without[i]});
  return c;
}

TEST(LeftOutStrip, NamesTheClipThatCarriesTheDifference) {
  EXPECT_EQ(WithoutEachUnit(Differing(-4, {-0.3, -5, -6.7}), SamplingUnit::kClip),
            "“adaptive” against “fixed”, mean difference without each clip: −6.70 mm to −0.300 mm. Without “a” −0.300 "
            "mm: then it no longer matters: this clip carries it.");
  // Nearer to the whole, and yet the one that counts, though another is farther off on the other side.
  EXPECT_THAT(WithoutEachUnit(Differing(2.4, {0.7, 2.2, 9}), SamplingUnit::kClip), HasSubstr("Without “a” 0.700 mm"));
  EXPECT_THAT(WithoutEachUnit(Differing(-2, {1.5, -3, -4}), SamplingUnit::kLibrary),
              EndsWith("this library carries it."));
}

TEST(LeftOutStrip, SaysThatNoneCarriesIt) {
  EXPECT_THAT(WithoutEachUnit(Differing(-4, {-3, -4, -5}), SamplingUnit::kClip),
              EndsWith("Without “a” −3.00 mm: no single clip carries it."));
}

TEST(LeftOutStrip, NamesTheClipThatHidesOne) {
  EXPECT_THAT(WithoutEachUnit(Differing(0.2, {0.1, -3, 0.5}), SamplingUnit::kClip), EndsWith("this clip hides it."));
}

TEST(LeftOutStrip, DrawsAMarkPerClipAgainstWhatMatters) {
  const std::string html = LeftOutStripHtml(Differing(-4, {-0.3, -5, -6.7}), SamplingUnit::kClip);
  EXPECT_EQ(CountOf(html, "class=\"left"), 1 + 3);  // the figure, and a line each
  EXPECT_EQ(CountOf(html, "class=\"left extreme\""), 1);
  EXPECT_THAT(html, HasSubstr("without &lt;c&gt;: −6.70 mm"));
  EXPECT_THAT(html, HasSubstr("class=\"band\""));
}

TEST(LeftOutStrip, IsNotDrawnWhereWorldsAreUnits) {
  EXPECT_EQ(LeftOutStripHtml(Differing(-4, {}), SamplingUnit::kWorld), "");
  EXPECT_EQ(LeftOutStripHtml(Comparison{}, SamplingUnit::kClip), "");
}

}  // namespace
}  // namespace etude
