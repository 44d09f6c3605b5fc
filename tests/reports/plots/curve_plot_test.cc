#include "reports/plots/curve_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "io/drawing/marks.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::vector<std::pair<double, double>> PointsOf(const std::string& svg) {
  const std::size_t begin = svg.find(" points=\"") + 9;
  const std::string text = svg.substr(begin, svg.find('"', begin) - begin);
  const std::regex point(R"((-?[0-9.]+),(-?[0-9.]+))");
  std::vector<std::pair<double, double>> points;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), point); it != std::sregex_iterator(); ++it) {
    points.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  }
  return points;
}

TEST(AxesFor, HoldEveryCurveInWholeDecades) {
  const PlotCurve a{0, false, {50, 2}}, b{1, false, {7, 0.03, 0.02, 0.0}};
  const CurveAxes axes = AxesFor({&a, &b});
  EXPECT_DOUBLE_EQ(axes.up.high, 1e2);
  EXPECT_DOUBLE_EQ(axes.up.low, 1e-2);
  EXPECT_EQ(axes.across.high, 3);
}

TEST(AxesFor, HaveWidthAndHeightWhateverTheyAreGiven) {
  const PlotCurve none{0, false, {}}, zeros{0, false, {0, 0}}, one{0, false, {10}}, far{0, false, {1, 1e-300}};
  for (const PlotCurve* curve : {&none, &zeros, &one, &far}) {
    const CurveAxes axes = AxesFor({curve});
    EXPECT_GT(axes.up.high, axes.up.low);
    EXPECT_LE(axes.up.high / axes.up.low, 1.0001e8);
    EXPECT_GE(axes.across.high, 1);
  }
}

TEST(CurvePlot, DrawsEqualRatiosAsEqualDistances) {
  const PlotCurve curve{0, false, {100, 10, 1, 0}};
  const auto points = PointsOf(CurvePlotSvg({curve}, AxesFor({&curve}), ""));
  ASSERT_EQ(points.size(), 4u);
  EXPECT_NEAR(points[1].second - points[0].second, points[2].second - points[1].second, 0.11);
  EXPECT_EQ(points[3].second, points[2].second);  // zero is drawn at the axis's lower end
  EXPECT_NEAR(points[1].first - points[0].first, points[3].first - points[2].first, 0.11);
}

TEST(CurvePlot, StaysLightAndStillTellsWhereALongCurveEnds) {
  PlotCurve curve{0, false, std::vector<double>(5000, 1.0)};
  curve.values.back() = 100;
  const auto points = PointsOf(CurvePlotSvg({curve}, AxesFor({&curve}), ""));
  EXPECT_LE(points.size(), 80u);
  EXPECT_LT(points.back().second, points.front().second);
  EXPECT_EQ(points.back().first, std::ranges::max(points).first);
}

TEST(CurvePlot, TellsMethodsApartByColourAndDashes) {
  const PlotCurve first{0, false, {1, 2}}, second{4, true, {1, 2}};
  const std::string svg = CurvePlotSvg({first, second}, AxesFor({&first, &second}), "<me>");
  EXPECT_THAT(svg, HasSubstr("class=\"c0\" points"));
  EXPECT_THAT(svg, HasSubstr("class=\"c4 faint\" stroke-dasharray"));
  EXPECT_THAT(svg, Not(HasSubstr("<me>")));
}

TEST(LineKey, OfEveryMethodOfSixteenLooksDifferent) {
  std::set<std::string> keys;
  for (std::size_t style = 0; style < 16; ++style) keys.insert(LineKeySvg(style));
  EXPECT_EQ(keys.size(), 16u);
}

TEST(DecadeText, IsShortAtEverySize) {
  EXPECT_EQ(DecadeText(-3), "1e-3");
  EXPECT_EQ(DecadeText(-2), "0.01");
  EXPECT_EQ(DecadeText(2), "100");
  EXPECT_EQ(DecadeText(3), "1k");
  EXPECT_EQ(DecadeText(5), "100k");
  EXPECT_EQ(DecadeText(6), "1M");
  EXPECT_EQ(DecadeText(9), "1e9");
}

}  // namespace
}  // namespace etude
