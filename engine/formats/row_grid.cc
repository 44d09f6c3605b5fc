#include "engine/formats/row_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/formats/row_rates.h"

namespace etude {
namespace {

constexpr double kMaxStep_s = 600, kMinSpan_s = 0.5;
// A row coincides with a frame if their times differ by less than a tolerance. The tolerance, in frames, is the
// rounding of the times, but at least kEven (kExact for a whole rate) and at most kMaxEven.
constexpr double kEven = 0.1, kMaxEven = 0.45, kExact = 1e-4;
constexpr double kMaxAddedValues = 1e7;

/// Returns the last decimal to which all times were printed: the largest power of ten, at most `largest`, of which all
/// times are multiples. Returns 0 if a time has more than six decimals.
double PrintedStep(std::span<const double> times, double largest = 0.1) {
  constexpr double kRounding = 1e-6;
  for (double scale = 1 / largest; scale < 2e6; scale *= 10) {
    const auto is_multiple = [&](double time) { return std::abs(time * scale - std::round(time * scale)) < kRounding; };
    if (std::ranges::all_of(times, is_multiple)) return 1 / scale;
  }
  return 0;
}

/// Returns the indices of the rows that are used: of rows with equal times only the last. Fails if a time is missing,
/// times decrease, or a step is too long.
Result<std::vector<std::size_t>> CountingRows(std::span<const double> times, std::span<const int> lines,
                                              const std::string& file) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const Place place{file, lines.empty() ? 0 : lines[i]};
    if (std::isnan(times[i])) return Fail(place, "this row has no time, but other rows have one");
    if (rows.empty()) {
      rows.push_back(i);
      continue;
    }
    const double before = times[rows.back()];
    if (times[i] < before) {
      return Fail(place, "the time {:.6g} s follows {:.6g} s; allowed: times that do not decrease", times[i], before);
    }
    if (times[i] - before > kMaxStep_s) {
      return Fail(place, "the time {:.6g} s follows {:.6g} s; allowed: at most {} s between rows", times[i], before,
                  kMaxStep_s);
    }
    if (times[i] == before) rows.pop_back();
    rows.push_back(i);
  }
  return rows;
}

/// Describes the irregularities of a grid: frames without a row, frames between rows, and rows that are not used.
std::string DescribeGrid(const RowGrid& grid, std::size_t twice) {
  std::size_t holes = 0, places = 0, longest = 0, run = 0, between = 0;
  for (const GridFrame& frame : grid.frames) {
    if (!frame.is_hole && frame.part > 0) ++between;
    run = frame.is_hole ? run + 1 : 0;
    if (frame.is_hole) ++holes;
    if (run == 1) ++places;
    longest = std::max(longest, run);
  }
  std::vector<std::string> said;
  if (holes > 0) {
    said.push_back(fmt::format("by their times, {} of {} frames are missing, in {} {} of at most {:.3g} s", holes,
                               grid.frames.size(), places, places == 1 ? "gap" : "gaps",
                               static_cast<double>(longest + 1) / grid.rate_hz));
  }
  if (between > 0) {
    said.push_back(fmt::format("the times are uneven, so Etude interpolates {} frames to even steps of {:.4g} s",
                               between, 1 / grid.rate_hz));
  }
  if (twice > 0)
    said.push_back(
        fmt::format("{} rows have the same time as another row; Etude uses the last row of each time", twice));
  return Join(said, "; ");
}

/// Returns true if the gaps of a grid of `frames` frames with `width` values each may be stored.
bool AreGapsStorable(double frames, std::size_t rows, std::size_t width) {
  return (frames - static_cast<double>(rows)) * static_cast<double>(width) <= kMaxAddedValues;
}

/// Returns the grid of rows that come in bursts (MeanStepOfBursts), as evenly spaced frames.
RowGrid GridOfBursts(const std::vector<std::size_t>& rows, double mean_s, double median_s,
                     std::optional<double> told_hz, std::size_t all) {
  constexpr double kSameRate = 0.02;
  RowGrid grid{.rate_hz = 1 / mean_s, .frames = {}, .is_even = rows.size() == all, .remark = ""};
  const double whole = std::round(grid.rate_hz);
  for (const double rate : {whole, told_hz.value_or(0)}) {
    if (std::abs(rate * mean_s - 1) <= kSameRate) grid.rate_hz = rate;
  }
  for (const std::size_t row : rows) grid.frames.push_back({row, row});
  grid.remark = fmt::format(
      "rows arrive in bursts: the median step is {:.3g} s, but the mean step is {:.3g} s; Etude takes them as evenly "
      "spaced, at {:.6g} Hz",
      median_s, mean_s, grid.rate_hz);
  return grid;
}

/// Rows that follow each other without a missing row.
struct Stretch {
  std::size_t first = 0, end = 0;
};

/// Splits coarsely printed times where they advance by more than one step of their last decimal: rows are missing
/// there. Returns an empty list if times decrease, or if a step is too long.
std::vector<Stretch> StretchesOf(std::span<const double> times, double step) {
  std::vector<Stretch> stretches = {{0, 1}};
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double advance = times[i] - times[i - 1];
    if (advance < 0 || advance > kMaxStep_s) return {};
    if (advance > 1.5 * step) stretches.push_back({i, i});
    stretches.back().end = i + 1;
  }
  return stretches;
}

/// Returns the times at which the stretch's first row may have been recorded, as their middle, seconds; nullopt if the
/// rate does not fit the stretch's times, which are rounded to `step`.
std::optional<double> FirstTimeOf(std::span<const double> times, Stretch stretch, double rate, double step) {
  double low = times[stretch.first], high = low;
  for (std::size_t i = stretch.first; i < stretch.end; ++i) {
    const double first = times[i] - static_cast<double>(i - stretch.first) / rate;
    low = std::min(low, first);
    high = std::max(high, first);
  }
  constexpr double kRounding = 1e-6;
  return high - low <= step + kRounding ? std::optional((low + high) / 2) : std::nullopt;
}

/// Returns the rates that coarsely printed times may have, in the order of preference: the stated rate, the usual rates
/// within `error` (a share) of the mean, nearest first, the mean rounded to a whole number n, n · 1000 / 1001
/// (television), and the mean.
std::vector<double> CoarseRates(double mean, double error, std::optional<double> told_hz) {
  std::vector<double> rates(kUsualRates_hz.begin(), kUsualRates_hz.end());
  std::ranges::sort(rates, {}, [&](double rate) { return std::pair(std::abs(rate - mean), rate); });
  std::erase_if(rates, [&](double rate) { return std::abs(rate / mean - 1) > error; });
  if (told_hz) rates.insert(rates.begin(), *told_hz);
  const double whole = std::round(mean);
  rates.insert(rates.end(), {whole, whole * kTelevision, mean});
  return rates;
}

/// Returns the grid of rows whose times are printed so coarsely that neighbouring rows share a time, e.g. 120 Hz
/// printed to 0.01 s; nullopt for other rows. The grid has the first of CoarseRates that fits all stretches without a
/// missing row. A gap between two stretches gets the number of frames that their times suggest.
std::optional<RowGrid> GridOfCoarseTimes(std::span<const double> times, std::optional<double> told_hz,
                                         std::size_t width) {
  constexpr std::size_t kMinRows = 8;   // of the file, and of the mean stretch
  constexpr double kMinPerStep = 1.05;  // minimum mean number of rows per step; with fewer, equal times are duplicates
  const double step = PrintedStep(times, 1);
  if (times.size() < kMinRows || step == 0 || std::ranges::adjacent_find(times) == times.end()) return std::nullopt;
  const std::vector<Stretch> stretches = StretchesOf(times, step);
  double span = 0;
  for (const auto& [first, end] : stretches) span += times[end - 1] - times[first];
  if (!(span > 0) || stretches.size() * kMinRows > times.size()) return std::nullopt;
  const double mean = static_cast<double>(times.size() - stretches.size()) / span;
  if (mean * step < kMinPerStep) return std::nullopt;

  const double error = static_cast<double>(stretches.size()) * step / span;  // each stretch is uncertain by a step
  for (const double rate : CoarseRates(mean, error, told_hz)) {
    std::vector<double> begins;
    for (const Stretch& stretch : stretches) {
      if (const auto first_s = FirstTimeOf(times, stretch, rate, step)) begins.push_back(*first_s);
    }
    if (begins.size() < stretches.size()) continue;
    // Place each stretch on the frame nearest to its first time, and holes between the stretches.
    RowGrid grid{.rate_hz = rate, .frames = {}, .remark = {}};
    if (!AreGapsStorable((begins.back() - begins.front()) * rate, times.size(), width)) return std::nullopt;
    for (std::size_t s = 0; s < stretches.size(); ++s) {
      const auto [first, end] = stretches[s];
      const double begin = std::round((begins[s] - begins.front()) * rate),
                   last = static_cast<double>(grid.frames.size());
      for (double k = last; k < begin; ++k) {
        grid.frames.push_back({first - 1, first, (k + 1 - last) / (begin + 1 - last), true});
      }
      for (std::size_t i = first; i < end; ++i) grid.frames.push_back({i, i});
    }
    grid.is_even = grid.frames.size() == times.size();
    grid.remark = fmt::format(
        "the times are rounded to {:g} s, so several rows have the same time; Etude takes the rows as evenly spaced, "
        "at {:.6g} Hz",
        step, rate);
    if (const std::string gaps = DescribeGrid(grid, 0); !gaps.empty()) grid.remark += "; " + gaps;
    return grid;
  }
  return std::nullopt;
}

/// The rows that a grid uses, with their times in seconds, which increase.
struct ClockRows {
  std::vector<std::size_t> rows;
  std::vector<double> times_s, steps_s;
  double printed_s = 0;  ///< the step to which the times were printed; 0 = they have more decimals

  double Start() const { return times_s.front(); }
  double Span() const { return times_s.back() - times_s.front(); }
  /// Returns the largest difference between a row and its frame, in frames.
  double Tolerance(double rate_hz) const { return std::clamp(printed_s * rate_hz, kEven, kMaxEven); }
  /// Returns true if nearly all rows coincide with frames, within `slack` frames.
  bool Fit(double rate_hz, double slack) const {
    constexpr double kMost = 0.9;  // minimum share of rows that coincide with frames
    const auto lies_on_frame = [&](double time) {
      const double place = (time - Start()) * rate_hz;
      return std::abs(place - std::round(place)) <= slack;
    };
    const auto count = static_cast<double>(std::ranges::count_if(times_s, lies_on_frame));
    return rate_hz > 0 && count >= kMost * static_cast<double>(rows.size());
  }
};

ClockRows MakeClockRows(std::vector<std::size_t> rows, std::span<const double> times_s) {
  ClockRows clock{.rows = std::move(rows), .times_s = {}, .steps_s = {}, .printed_s = 1.05 * PrintedStep(times_s)};
  for (const std::size_t row : clock.rows) clock.times_s.push_back(times_s[row]);
  for (std::size_t i = 1; i < clock.rows.size(); ++i) {
    clock.steps_s.push_back(clock.times_s[i] - clock.times_s[i - 1]);
  }
  return clock;
}

/// A frame rate, Hz. If `is_uneven`, the rows do not coincide with its frames, but no row is missing.
struct ClockRate {
  double hz = 0;
  bool is_uneven = false;
};

/// Chooses the rate of rows. Tries the stated rate, a whole rate, and the rate at which the last row coincides with a
/// frame, in this order, and takes the first of these rates at which nearly all rows coincide with frames. Returns
/// nullopt if the rows are too brief to contradict the stated rate, but do so.
std::optional<ClockRate> ChooseRate(const ClockRows& clock, std::optional<double> told_hz) {
  const double fitted = FittedRate(clock.steps_s, false), span = clock.Span();
  const bool is_brief = told_hz && span < kMinSpan_s;
  if (is_brief && std::abs(fitted / *told_hz - 1) > kBriefTolerance) return std::nullopt;
  if (is_brief) return ClockRate{*told_hz};
  for (const double near : {fitted, FittedRate(clock.steps_s, true)}) {
    const double whole = std::round(near), to_last = std::round(span * near) / span;
    const auto is_near = [&](double rate) { return std::abs(near - rate) * span <= kMaxEven; };
    if (told_hz && is_near(*told_hz) && clock.Fit(*told_hz, clock.Tolerance(*told_hz))) return ClockRate{*told_hz};
    if (is_near(whole) && clock.Fit(whole, std::clamp(clock.printed_s * whole, kExact, kMaxEven)))
      return ClockRate{whole};
    if (clock.Fit(to_last, clock.Tolerance(to_last))) return ClockRate{to_last};
  }
  const auto uneven = RateOfUnevenRows(clock.times_s, told_hz);
  return ClockRate{uneven.value_or(fitted), uneven.has_value()};
}

/// Returns `count` frames at a rate; each lies on a row, between two rows, or in a hole.
std::vector<GridFrame> PlaceFrames(const ClockRows& clock, const ClockRate& rate, std::size_t count) {
  constexpr double kMissingRow = 1.5;  // a row is missing if neighbouring rows are at least this many frames apart
  const double slack = clock.Tolerance(rate.hz);
  const auto place_of = [&](std::size_t i) { return (clock.times_s[i] - clock.Start()) * rate.hz; };
  std::vector<GridFrame> frames;
  std::size_t at = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto frame = static_cast<double>(k);
    while (at + 1 < clock.rows.size() && place_of(at + 1) <= frame + slack) ++at;
    const std::size_t next = std::min(at + 1, clock.rows.size() - 1);
    GridFrame& made = frames.emplace_back(GridFrame{clock.rows[at], clock.rows[at]});
    if (next == at || std::abs(frame - place_of(at)) <= slack) continue;
    const double step = place_of(next) - place_of(at);
    made = {clock.rows[at], clock.rows[next], (frame - place_of(at)) / step, step >= kMissingRow && !rate.is_uneven};
  }
  return frames;
}

}  // namespace

Result<std::optional<RowGrid>> GridOfRows(std::span<const double> times_s, std::span<const int> lines,
                                          std::optional<double> told_hz, std::size_t width, const std::string& file) {
  if (std::ranges::all_of(times_s, [](double time) { return std::isnan(time); })) return std::nullopt;
  if (auto grid = GridOfCoarseTimes(times_s, told_hz, width)) return grid;
  ASSIGN_OR_RETURN(auto rows, CountingRows(times_s, lines, file));
  if (rows.size() < 2) return std::nullopt;
  constexpr std::size_t kMaxPerTime = 4;  // mean number of rows; with more, most of the motion would be left out
  if (times_s.size() > kMaxPerTime * rows.size()) {
    return Fail(
        {file},
        "{} rows have only {} different times; allowed: times with enough decimals, or frame numbers instead of times",
        times_s.size(), rows.size());
  }
  const ClockRows clock = MakeClockRows(std::move(rows), times_s);
  if (const auto mean_s = MeanStepOfBursts(clock.times_s)) {
    return GridOfBursts(clock.rows, *mean_s, LowerPercentile(clock.steps_s, 0.5), told_hz, times_s.size());
  }
  const auto rate = ChooseRate(clock, told_hz);
  if (!rate) return std::nullopt;

  // Refuse rates that no recording of people has, and holes that would take too much memory.
  constexpr double kRounding = 1e-6;
  if (rate->hz > kMaxMotionRate_hz * (1 + kRounding)) {
    return Fail({file},
                "the times of {} rows are mostly {:.3g} s apart, which means a rate of {:.4g} Hz; allowed: at most "
                "{:g} Hz, with times in seconds",
                clock.rows.size(), 1 / rate->hz, rate->hz, kMaxMotionRate_hz);
  }
  const double count = std::floor(clock.Span() * rate->hz + clock.Tolerance(rate->hz)) + 1;
  if (!AreGapsStorable(count, clock.rows.size(), width)) {
    return Fail({file},
                "{} rows in {:.6g} s, mostly {:.3g} s apart, have gaps that are too large to fill; allowed: {:g} "
                "missing values in total, at {} values per frame",
                clock.rows.size(), clock.Span(), 1 / rate->hz, kMaxAddedValues, width);
  }
  RowGrid grid{.rate_hz = rate->hz, .frames = {}, .remark = {}};
  grid.frames = PlaceFrames(clock, *rate, static_cast<std::size_t>(count));
  grid.is_even = grid.frames.size() == times_s.size();
  for (std::size_t k = 0; grid.is_even && k < grid.frames.size(); ++k) {
    grid.is_even = grid.frames[k].row == k && grid.frames[k].part == 0;
  }
  grid.remark = DescribeGrid(grid, times_s.size() - clock.rows.size());
  return grid;
}

}  // namespace etude
