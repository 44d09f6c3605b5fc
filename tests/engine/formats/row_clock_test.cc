#include "engine/formats/row_clock.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/formats/motive_csv.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

glm::dvec3 CurveAt(double time_s) { return {0.3 * std::sin(2 * time_s), 1 + 0.1 * std::cos(3 * time_s), time_s}; }

/// Returns rows at these times, rounded to multiples of `printed` if it is above 0.
MarkerRows RowsAt(const std::vector<double>& times, double told_hz = 0, double printed = 0) {
  MarkerRows rows{.markers = {.rate_hz = 30, .names = {"A"}, .frames = {}}, .times_s = {}, .lines = {}};
  if (told_hz > 0) {
    rows.markers.rate_hz = told_hz;
    rows.rate_name = "DataRate";
  }
  for (const double time : times) {
    rows.times_s.push_back(printed > 0 ? std::round(time / printed) * printed : time);
    rows.lines.push_back(static_cast<int>(rows.lines.size()) + 2);
    rows.markers.frames.push_back({CurveAt(time)});
  }
  return rows;
}

/// Returns `count` times at a rate, without those from `lost` to before `found`.
std::vector<double> TimesAt(double rate_hz, int count, int lost = 0, int found = 0) {
  std::vector<double> times;
  for (int k = 0; k < count; ++k) {
    if (k < lost || k >= found) times.push_back(k / rate_hz);
  }
  return times;
}

double FarthestFromCurve(const MarkerMotion& motion, double start_s = 0) {
  double worst = 0;
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    const double time = start_s + static_cast<double>(k) / motion.rate_hz;
    if (motion.frames[k][0]) worst = std::max(worst, glm::distance(*motion.frames[k][0], CurveAt(time)));
  }
  return worst;
}

TEST(RowClock, EvenRowsStayAsTheyAre) {
  for (const double rate : {1.0, 24.0, 29.97, 30.0, 59.94, 100.0, 119.88, 120.0, 1000.0}) {
    ASSERT_OK(laid, LayOnClock(RowsAt(TimesAt(rate, 90)), "a"));
    EXPECT_NEAR(laid->rate_hz, rate, 1e-9 * rate);
    EXPECT_EQ(laid->frames.size(), 90u);
    EXPECT_EQ(laid->remark, "");
    EXPECT_LT(FarthestFromCurve(*laid), 1e-9);
  }
}

TEST(RowClock, MissingRowsAreGapsOfTheirLength) {
  for (const double rate : {15.0, 29.97, 30.0, 120.0}) {
    for (const auto& [lost, found] : {std::pair(20, 35), std::pair(1, 2), std::pair(57, 59)}) {
      ASSERT_OK(laid, LayOnClock(RowsAt(TimesAt(rate, 60, lost, found)), "a"));
      ASSERT_EQ(laid->frames.size(), 60u) << rate << " " << lost;
      EXPECT_NEAR(laid->rate_hz, rate, 1e-9 * rate);
      for (int k = 0; k < 60; ++k) {
        EXPECT_EQ(laid->frames[static_cast<std::size_t>(k)][0].has_value(), k < lost || k >= found) << k;
      }
      EXPECT_LT(FarthestFromCurve(*laid), 1e-9);
      EXPECT_THAT(laid->remark, HasSubstr(fmt::format("{} of 60 frames are missing, in 1 gap", found - lost)));
    }
  }
}

TEST(RowClock, RowsMoreThanASecondApartAreMilliseconds) {
  std::vector<double> times = TimesAt(30, 60);
  for (double& time : times) time *= 1000;
  ASSERT_OK(laid, LayOnClock(RowsAt(times), "a.csv"));
  EXPECT_NEAR(laid->rate_hz, 30, 1e-9);
  EXPECT_EQ(laid->frames.size(), 60u);
  EXPECT_EQ(
      laid->remark,
      "its times are taken as milliseconds, because in seconds the rows would be more than a second apart; the rate "
      "is 30 Hz");
}

/// Returns `count` rows whose times are counted in units of `unit_s` seconds, rounded if the unit is small.
MarkerRows RowsCounted(double rate_hz, double unit_s, double told_hz = 0) {
  MarkerRows rows = RowsAt(TimesAt(rate_hz, 120), told_hz);
  for (double& time : rows.times_s) time = unit_s > 1 ? time / unit_s : std::round(1e4 * time / unit_s) / 1e4;
  return rows;
}

TEST(RowClock, TimesInOtherUnitsGetTheirRate) {
  // Without a stated rate. Ticks of 100 ns are .NET's; microseconds of a slow sensor stay microseconds.
  for (const double rate : {30.0, 60.0, 90.0, 120.0}) {
    for (const auto& [unit_s, name] :
         {std::pair(1e-3, "milliseconds"), {1e-6, "microseconds"}, {1e-7, "ticks of 100 ns"}, {1e-9, "nanoseconds"}}) {
      ASSERT_OK(laid, LayOnClock(RowsCounted(rate, unit_s), "a"));
      EXPECT_NEAR(laid->rate_hz, rate, 1e-3 * rate) << name;
      EXPECT_EQ(laid->frames.size(), 120u);
      EXPECT_THAT(laid->remark, HasSubstr(fmt::format("taken as {}, because", name)));
      EXPECT_THAT(laid->remark, HasSubstr(fmt::format("the rate is {:.4g} Hz", rate)));
    }
  }
  EXPECT_NEAR(LayOnClock(RowsCounted(15, 1e-6), "a")->rate_hz, 15, 1e-3);
  // With a stated rate, also hundredths of a second and frame numbers; a wrong header does not hide the unit.
  for (const auto& [unit_s, name] :
       {std::pair(1e-2, "hundredths of a second"), {1e-7, "ticks of 100 ns"}, {1.0 / 30, "frame numbers"}}) {
    ASSERT_OK(laid, LayOnClock(RowsCounted(30, unit_s, 30), "a"));
    EXPECT_EQ(laid->rate_hz, 30);
    EXPECT_EQ(laid->frames.size(), 120u);
    EXPECT_THAT(laid->remark, HasSubstr(fmt::format("the column Time is taken as {}, because", name)));
  }
  ASSERT_OK(wrong, LayOnClock(RowsCounted(30, 1e-3, 25), "a"));
  EXPECT_EQ(wrong->rate_hz, 30);
  EXPECT_THAT(wrong->remark,
              HasSubstr("the column Time is taken as milliseconds, because in seconds the rows would be more"));
  EXPECT_THAT(wrong->remark, HasSubstr("DataRate states 25 Hz, but the times in the column Time give 30 Hz, which is "
                                       "used"));
}

TEST(RowClock, HundredthsThatMayBeMillisecondsAreSaid) {
  ASSERT_OK(laid, LayOnClock(RowsCounted(30, 1e-2), "a"));
  EXPECT_NEAR(laid->rate_hz, 300, 1e-6);
  EXPECT_THAT(laid->remark, HasSubstr("the rate is 300 Hz (in hundredths of a second, it would be 30 Hz; `--rate`, in "
                                      "convert `--file-rate`, sets it)"));
}

TEST(RowClock, RatesAboveTenKilohertzAreRefused) {
  const auto reason = [](double unit_s) {
    const auto laid = LayOnClock(RowsCounted(30, unit_s), "a");
    return laid ? std::string("no complaint") : ToString(laid.error());
  };
  EXPECT_THAT(reason(3600),
              HasSubstr("which means a rate of 1.08e+05 Hz; allowed: at most 10000 Hz, with times in seconds"));
  EXPECT_EQ(reason(60), "no complaint") << "1800 Hz is possible";
}

TEST(RowClock, EqualTimesLeaveTheStatedRate) {
  ASSERT_OK(laid, LayOnClock(RowsAt(std::vector<double>(20, 4.0), 30), "a"));
  EXPECT_EQ(laid->rate_hz, 30);
  EXPECT_EQ(laid->remark, "all times in the column Time are equal, so Etude uses the rate that DataRate states, 30 Hz");
  ASSERT_OK(brief, LayOnClock(RowsAt(TimesAt(30, 14), 60), "a"));
  EXPECT_EQ(brief->remark,
            "DataRate states 60 Hz, which is used, but the times in the column Time give 30 Hz (from only 14 rows)");
}

TEST(RowClock, TimesMayBePrintedWithFewDecimals) {
  for (const double rate : {24.0, 30.0, 50.0, 100.0}) {
    ASSERT_OK(laid, LayOnClock(RowsAt(TimesAt(rate, 60, 20, 35), rate, 0.01), "a"));
    EXPECT_EQ(laid->rate_hz, rate);
    EXPECT_EQ(laid->frames.size(), 60u) << rate;
    EXPECT_LT(FarthestFromCurve(*laid), 1e-9) << "rows are used as they are";
  }
  ASSERT_OK(untold, LayOnClock(RowsAt(TimesAt(120, 500, 200, 230), 0, 0.001), "a"));
  EXPECT_EQ(untold->rate_hz, 120);
  EXPECT_EQ(untold->frames.size(), 500u);
  EXPECT_LT(FarthestFromCurve(*untold), 1e-9);
}

TEST(RowClock, TimesThatSeveralRowsShareByRoundingKeepTheirRate) {
  for (const double rate : {119.88, 120.0, 144.0, 200.0, 240.0}) {
    for (const double told : {0.0, rate}) {
      ASSERT_OK(laid, LayOnClock(RowsAt(TimesAt(rate, 600), told, 0.01), "a"));
      EXPECT_NEAR(laid->rate_hz, rate, told > 0 ? 1e-9 : 0.13) << "untold, 119.88 Hz may be 120";
      EXPECT_EQ(laid->frames.size(), 600u);
      EXPECT_LT(FarthestFromCurve(*laid), told > 0 || rate > 119.9 ? 1e-9 : 0.02);
      EXPECT_THAT(laid->remark, HasSubstr("the times are rounded to 0.01 s, so several rows have the same time"));
    }
  }
  // The control: at 100 Hz, a repeated time is a repeated row.
  std::vector<double> times = TimesAt(100, 60);
  times.insert(times.begin() + 30, times[30]);
  ASSERT_OK(twice, LayOnClock(RowsAt(times, 0, 0.01), "a"));
  EXPECT_EQ(twice->rate_hz, 100);
  EXPECT_EQ(twice->remark, "1 rows have the same time as another row; Etude uses the last row of each time");
}

TEST(RowClock, CoarseTimesKeepTheirRateBesideHoles) {
  for (const double rate : {119.88, 120.0, 144.0, 200.0, 240.0}) {
    for (const double printed : {0.01, 0.1, 1.0}) {
      const int lost = static_cast<int>(6 * rate) + 70, found = lost + static_cast<int>(4 * rate), count = 16 * 240;
      SCOPED_TRACE(fmt::format("{} Hz to {} s", rate, printed));
      for (const double told : {0.0, rate}) {
        if (told == 0 && (rate == 119.88 || printed > 0.01)) continue;  // other rates fit as well
        ASSERT_OK(laid, LayOnClock(RowsAt(TimesAt(rate, count, lost, found), told, printed), "a"));
        EXPECT_NEAR(laid->rate_hz, rate, 1e-9 * rate);
        ASSERT_NEAR(static_cast<double>(laid->frames.size()), count, 1) << "the hole may be a frame longer or shorter";
        EXPECT_LT(FarthestFromCurve(*laid), 1.21 / rate) << "at 1.2 m/s, a frame beside its time";
        EXPECT_THAT(laid->remark, HasSubstr("several rows have the same time"));
        EXPECT_THAT(laid->remark, HasSubstr("in 1 gap of at most 4"));
        for (int k = 0; k < lost; ++k) EXPECT_TRUE(laid->frames[static_cast<std::size_t>(k)][0]) << k;
      }
    }
  }
  // With hundredths of a second at 120 Hz, the hole's length is exact.
  ASSERT_OK(exact, LayOnClock(RowsAt(TimesAt(120, 994, 400, 460), 0, 0.01), "a"));
  EXPECT_EQ(exact->rate_hz, 120);
  EXPECT_EQ(exact->frames.size(), 994u);
  EXPECT_LT(FarthestFromCurve(*exact), 1e-9);
  // The control: at 100 Hz, a repeated time beside a hole is a repeated row.
  std::vector<double> times = TimesAt(100, 200, 80, 100);
  times.insert(times.begin() + 30, times[30]);
  ASSERT_OK(twice, LayOnClock(RowsAt(times, 0, 0.01), "a"));
  EXPECT_EQ(twice->rate_hz, 100);
  EXPECT_EQ(twice->frames.size(), 200u);
  EXPECT_THAT(twice->remark, HasSubstr("1 rows have the same time as another row; Etude uses the last row of each "
                                       "time"));
}

TEST(RowClock, TimesSince1970AndInSmallerUnitsCountFromTheFirstRow) {
  for (const auto& [per_second, unit] : {std::pair(1.0, ""), {1e3, "milli"}, {1e6, "micro"}, {1e9, "nano"}}) {
    std::vector<double> times = TimesAt(60, 90);
    for (double& time : times) time = std::round((time + 1.6e9) * 1000) / 1000 * per_second;
    MarkerRows rows = RowsAt(TimesAt(60, 90));
    rows.times_s = times;
    ASSERT_OK(laid, LayOnClock(std::move(rows), "a"));
    EXPECT_EQ(laid->rate_hz, 60) << unit;
    EXPECT_EQ(laid->frames.size(), 90u);
    EXPECT_THAT(laid->remark, HasSubstr("the times begin at 1600000000 s; Etude counts time from the first row"));
    EXPECT_THAT(laid->remark, HasSubstr(unit));
    EXPECT_NEAR(laid->start_s.value_or(0), 1.6e9, 1e-3) << "the file's own clock";
  }
  ASSERT_OK(csv, ReadJointCsv("time_s,head_x_m,head_y_m,head_z_m\n1600000000.5,1,2,3\n1600000000.75,1,2,3\n", "a"));
  EXPECT_EQ(LayOnClock(*csv, "a")->start_s, 1600000000.5);
}

TEST(RowClock, ARowAtAWrongTimeChangesNoRate) {
  std::vector<double> times = TimesAt(30, 70);
  times[40] -= 0.45 / 30;
  ASSERT_OK(laid, LayOnClock(RowsAt(times), "a"));
  EXPECT_EQ(laid->rate_hz, 30);
  EXPECT_EQ(laid->frames.size(), 70u);
  EXPECT_LT(FarthestFromCurve(*laid), 0.002);
}

TEST(RowClock, UnevenTimesAreInterpolatedAndTold) {
  // A camera whose period varies by up to a third, with a correct clock.
  std::vector<double> times;
  for (int k = 0; k < 90; ++k) times.push_back(k / 30.0 + 0.01 * std::sin(1.7 * k) + 0.01);
  ASSERT_OK(laid, LayOnClock(RowsAt(times), "a"));
  EXPECT_NEAR(laid->rate_hz, 30, 0.1);
  EXPECT_THAT(laid->remark, HasSubstr("the times are uneven, so Etude interpolates "));
  for (const auto& frame : laid->frames) EXPECT_TRUE(frame[0]);
  EXPECT_LT(FarthestFromCurve(*laid, times.front()), 0.005) << "as even rows they are 12 mm off";
}

TEST(RowClock, RowsInBurstsAreEvenlySpaced) {
  for (const int burst : {2, 3, 6}) {
    std::vector<double> times;
    for (int k = 0; k < 300; ++k) times.push_back(k / burst * burst / 30.0 + 0.001 * (k % burst));
    for (const double told : {0.0, 30.0}) {
      auto rows = RowsAt(times, told);
      for (int k = 0; k < 300; ++k) rows.markers.frames[static_cast<std::size_t>(k)] = {CurveAt(k / 30.0)};
      ASSERT_OK(laid, LayOnClock(std::move(rows), "a"));
      EXPECT_NEAR(laid->rate_hz, 30, 1e-9);
      EXPECT_EQ(laid->frames.size(), 300u);
      EXPECT_LT(FarthestFromCurve(*laid), 1e-9);
      EXPECT_THAT(laid->remark, HasSubstr("rows arrive in bursts"));
    }
  }
}

TEST(RowClock, JitterMakesNoRowMissing) {
  for (const auto& [rate, jitter_s] : {std::pair(30.0, 0.012), {100.0, 0.004}}) {
    std::vector<double> times;
    for (int k = 0; k < 300; ++k) times.push_back(k / rate + jitter_s * std::sin(1.0 + 37.7 * k * k));
    times.front() = 0;
    ASSERT_OK(laid, LayOnClock(RowsAt(times), "a"));
    EXPECT_EQ(laid->rate_hz, rate);
    EXPECT_NEAR(static_cast<double>(laid->frames.size()), 300, 1);
    for (const auto& frame : laid->frames) EXPECT_TRUE(frame[0]);
  }
}

TEST(RowClock, TheRateThatAHeaderTellsYieldsToTheTimes) {
  ASSERT_OK(other, LayOnClock(RowsAt(TimesAt(29.97, 300), 30), "a"));
  EXPECT_NEAR(other->rate_hz, 29.97, 1e-9);
  EXPECT_EQ(other->remark, "DataRate states 30 Hz, but the times in the column Time give 29.97 Hz, which is used");
  EXPECT_LT(FarthestFromCurve(*other), 1e-9);
  ASSERT_OK(missing, LayOnClock(RowsAt(TimesAt(30, 60, 20, 35), 30), "a"));
  EXPECT_EQ(missing->rate_hz, 30) << "a mean rate would be 22.4 Hz";
}

TEST(RowClock, OfEqualTimesTheLastCounts) {
  std::vector<double> times = TimesAt(30, 40);
  times.insert(times.begin() + 11, times[10]);
  auto rows = RowsAt(times);
  rows.markers.frames[10][0] = glm::dvec3(9);
  ASSERT_OK(laid, LayOnClock(std::move(rows), "a"));
  EXPECT_EQ(laid->frames.size(), 40u);
  EXPECT_LT(FarthestFromCurve(*laid), 1e-9);
  EXPECT_EQ(laid->remark, "1 rows have the same time as another row; Etude uses the last row of each time");
}

TEST(RowClock, RefusesWhatIsNoClock) {
  const auto reason = [](const std::vector<double>& times, std::size_t markers = 1) {
    auto rows = RowsAt(times);
    for (auto& frame : rows.markers.frames) frame.resize(markers);
    rows.markers.names.resize(markers, "B");
    const auto laid = LayOnClock(std::move(rows), "a");
    return laid ? std::string("no complaint") : ToString(laid.error());
  };
  const double nan = std::nan("");
  EXPECT_EQ(reason({0, 0.1, 0.05}), "a:4: the time 0.05 s follows 0.1 s; allowed: times that do not decrease");
  EXPECT_EQ(reason({0, nan, 0.1}), "a:3: this row has no time, but other rows have one");
  EXPECT_EQ(reason({0, 0.1, 700}), "a:4: the time 700 s follows 0.1 s; allowed: at most 600 s between rows");
  EXPECT_THAT(reason({0, 1e-4, 2e-4, 500}, 3),
              HasSubstr("allowed: 1e+07 missing values in total, at 3 values per frame"));
  EXPECT_EQ(
      reason({0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2}),
      "a: 13 rows have only 3 different times; allowed: times with enough decimals, or frame numbers instead of times");
  EXPECT_EQ(reason({nan, nan, nan}), "no complaint");
  EXPECT_EQ(reason({4, 4, 4}), "no complaint") << "a column that tells nothing";
}

TEST(RowClock, FrameNumbersAreAClock) {
  using Numbers = std::vector<double>;
  const auto expect = [](const Numbers& numbers, const Numbers& times) {
    const auto told = TimesOfNumbers(numbers, 10);
    ASSERT_EQ(told.size(), times.size());
    for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(told[i], times[i], 1e-12);
  };
  expect({7, 8, 9, 12}, {0, 0.1, 0.2, 0.5});
  expect({0, 5, 10, 20}, {0, 0.1, 0.2, 0.4});
  expect({0, 1, 1}, {});
  expect({0, 0.5}, {});
}

/// Returns a take of Motive with one marker at 120 Hz; 30 rows are missing.
std::string MotiveTake(bool has_times) {
  std::string text =
      "Format Version,1.23,Export Frame Rate,120.000000,Total Exported Frames,240,Length Units,Meters,Coordinate "
      "Space,Global\n\n"
      ",Type,Marker,Marker,Marker\n,Name,A,A,A\n,ID,1,1,1\n,,Position,Position,Position\n";
  text += has_times ? "Frame,Time (Seconds),X,Y,Z\n" : "Frame,Label,X,Y,Z\n";
  for (int k = 0; k < 240; ++k) {
    if (k >= 100 && k < 130) continue;
    const glm::dvec3 at = CurveAt(k / 120.0);
    text += fmt::format("{},{},{:.6f},{:.6f},{:.6f}\n", k, has_times ? fmt::format("{:.6f}", k / 120.0) : "", at.x,
                        at.y, at.z);
  }
  return text;
}

TEST(RowClock, KeepsTheTimeOfASingleRow) {
  for (const bool has_clock : {true, false}) {
    MarkerRows rows{.markers = {.names = {"A"}, .frames = {{glm::dvec3(1, 2, 3)}}},
                    .times_s = {3.3333},
                    .lines = {7},
                    .has_clock = has_clock};
    ASSERT_OK(laid, LayOnClock(std::move(rows), "a"));
    EXPECT_EQ(laid->start_s, has_clock ? std::optional(3.3333) : std::nullopt);
  }
}

TEST(RowClock, TimesThatAreNotWholeAreNoFrameNumbers) {
  MarkerRows rows{.markers = {.rate_hz = 30, .names = {"A"}, .frames = {}},
                  .times_s = {0, 1, 2, 2.5, 5, 5.0333, 6.6667},
                  .lines = {},
                  .rate_name = "DataRate"};
  for (const double time : rows.times_s) rows.markers.frames.push_back({glm::dvec3(time, 0, 0)});
  ASSERT_OK(laid, LayOnClock(std::move(rows), "a"));
  EXPECT_THAT(laid->remark, ::testing::Not(HasSubstr("frame numbers")));
  EXPECT_NEAR(static_cast<double>(laid->frames.size() - 1) / laid->rate_hz, 6.6667, 1 / laid->rate_hz) << laid->remark;
}

TEST(RowClock, OfMotiveIsItsColumnTimeElseItsFrameNumbers) {
  for (const bool has_times : {true, false}) {
    ASSERT_OK(take, ReadMotiveCsv(MotiveTake(has_times), "a.csv"));
    EXPECT_EQ(take->rate_hz, 120);
    ASSERT_EQ(take->frames.size(), 240u) << has_times;
    EXPECT_FALSE(take->frames[110][0]);
    EXPECT_LT(FarthestFromCurve(*take), 2e-6);
    EXPECT_EQ(take->start_s.has_value(), has_times) << "frame numbers are no clock";
    EXPECT_THAT(take->remark,
                HasSubstr("found 210 rows, but 'Total Exported Frames' is 240; by their times, 30 of 240 frames"));
  }
}

TEST(RowClock, OfTrcIsItsColumnTimeElseItsFrameNumbers) {
  for (const bool has_times : {true, false}) {
    std::string text =
        "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n30\t45\t1\tm\n"
        "Frame#\tTime\tA\n\n";
    for (int k = 0; k < 60; ++k) {
      if (k >= 20 && k < 35) continue;
      const glm::dvec3 at = CurveAt(k / 30.0);
      text += fmt::format("{}\t{}\t{:.7f}\t{:.7f}\t{:.7f}\n", k + 1, has_times ? fmt::format("{:.3f}", k / 30.0) : "",
                          at.x, at.y, at.z);
    }
    ASSERT_OK(read, ReadTrc(text, "a.trc"));
    EXPECT_EQ(read->rate_hz, 30);
    ASSERT_EQ(read->frames.size(), 60u) << has_times;
    EXPECT_LT(FarthestFromCurve(*read), 1e-6);
  }
}

TEST(RowClock, OfABodyIsBridgedForASecondAndCutBeyond) {
  double start_s = 0;
  const auto lay = [&](const std::vector<double>& times, std::string& remark) {
    BodyMotion rows{.poses = {}};
    for (const double time : times) rows.poses.emplace_back()[Role::kHead] = CurveAt(time);
    const auto motion = LayOnClock(std::move(rows), times, "a", remark, start_s);
    EXPECT_TRUE(motion);
    return motion.value_or(BodyMotion{});
  };
  std::string remark;
  const BodyMotion bridged = lay(TimesAt(30, 60, 20, 35), remark);
  ASSERT_EQ(bridged.poses.size(), 60u);
  EXPECT_LT(glm::distance(bridged.poses[27][Role::kHead], 0.5 * (CurveAt(19 / 30.0) + CurveAt(35 / 30.0))), 1e-9);
  EXPECT_THAT(remark, HasSubstr("15 of 60 frames are missing"));
  EXPECT_EQ(start_s, 0);
  remark.clear();
  const BodyMotion cut = lay(TimesAt(30, 100, 20, 60), remark);
  ASSERT_EQ(cut.poses.size(), 40u);
  EXPECT_LT(glm::distance(cut.poses[0][Role::kHead], CurveAt(2)), 1e-9);
  EXPECT_THAT(remark, HasSubstr("Etude keeps only frames 61 to 100 of 100"));
  EXPECT_EQ(start_s, 2);
}

TEST(RowClock, FrameNumbersThatBeginLaterAreSaidWhereThereAreNoTimes) {
  const auto remark = [](double first_number, bool has_clock) {
    MarkerRows rows = RowsAt(TimesAt(30, 90), 30);
    rows.first_number = first_number;
    rows.has_clock = has_clock;
    return LayOnClock(std::move(rows), "a")->remark;
  };
  EXPECT_EQ(remark(11, false),
            "the rows have frame numbers from 11 on, but no times; Etude gives the first row time 0");
  for (const double usual : {0.0, 1.0}) EXPECT_EQ(remark(usual, false), "");
  EXPECT_EQ(remark(11, true), "");
}

}  // namespace
}  // namespace etude
