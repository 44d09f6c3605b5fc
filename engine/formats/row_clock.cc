#include "engine/formats/row_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/formats/row_rates.h"

namespace etude {
namespace {

constexpr double kMaxStep_s = 600, kMaxBridged_s = 1, kMinSpan_s = 0.5;
constexpr double kBriefTolerance = 0.05;
// A row coincides with a frame if their times differ by less than a tolerance. The tolerance, in frames, is the
// rounding of the times, but at least kEven (kExact for a whole rate) and at most kMaxEven.
constexpr double kEven = 0.1, kMaxEven = 0.45, kExact = 1e-4;
constexpr double kMaxAddedValues = 1e7;

void AddRemark(std::string& remark, const std::string& text) {
  if (!text.empty()) remark += (remark.empty() ? "" : "; ") + text;
}

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
    AddRemark(grid.remark, DescribeGrid(grid, 0));
    return grid;
  }
  return std::nullopt;
}

}  // namespace

Result<std::optional<RowGrid>> GridOfRows(std::span<const double> times_s, std::span<const int> lines,
                                          std::optional<double> told_hz, std::size_t width, const std::string& file) {
  if (std::ranges::all_of(times_s, [](double time) { return std::isnan(time); })) return std::nullopt;
  if (auto grid = GridOfCoarseTimes(times_s, told_hz, width)) return grid;
  ASSIGN_OR_RETURN(const auto rows, CountingRows(times_s, lines, file));
  if (rows.size() < 2) return std::nullopt;
  constexpr std::size_t kMaxPerTime = 4;  // mean number of rows; with more, most of the motion would be left out
  if (times_s.size() > kMaxPerTime * rows.size()) {
    return Fail(
        {file},
        "{} rows have only {} different times; allowed: times with enough decimals, or frame numbers instead of times",
        times_s.size(), rows.size());
  }

  // Fit the rate to the time steps between rows.
  std::vector<double> used = {times_s[rows.front()]}, steps;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    used.push_back(times_s[rows[i]]);
    steps.push_back(used[i] - used[i - 1]);
  }
  if (const auto mean_s = MeanStepOfBursts(used)) {
    return GridOfBursts(rows, *mean_s, LowerPercentile(steps, 0.5), told_hz, times_s.size());
  }
  const double start = times_s[rows.front()], span = times_s[rows.back()] - start;
  const double printed = 1.05 * PrintedStep(times_s), fitted = FittedRate(steps, false);
  const auto tolerance = [&](double rate) { return std::clamp(printed * rate, kEven, kMaxEven); };
  const auto fits = [&](double rate, double slack) {
    constexpr double kMost = 0.9;  // minimum share of rows that coincide with frames
    const auto lies_on_frame = [&](std::size_t row) {
      const double place = (times_s[row] - start) * rate;
      return std::abs(place - std::round(place)) <= slack;
    };
    const auto count = static_cast<double>(std::ranges::count_if(rows, lies_on_frame));
    return rate > 0 && count >= kMost * static_cast<double>(rows.size());
  };
  const bool is_brief = told_hz && span < kMinSpan_s;
  if (is_brief && std::abs(fitted / *told_hz - 1) > kBriefTolerance) return std::nullopt;
  // Try the stated rate, a whole rate, and the rate at which the last row coincides with a frame, in this order. Take
  // the first of these rates at which nearly all rows coincide with frames.
  const auto uneven = RateOfUnevenRows(used, told_hz);
  RowGrid grid{.rate_hz = uneven.value_or(fitted), .frames = {}, .remark = {}};
  bool is_whole = uneven.has_value();  // true if no rate fits, and no row is missing
  for (const double near : {fitted, FittedRate(steps, true)}) {
    const double whole = std::round(near), to_last = std::round(span * near) / span;
    const auto is_near = [&](double rate) { return std::abs(near - rate) * span <= kMaxEven; };
    if (is_brief || (told_hz && is_near(*told_hz) && fits(*told_hz, tolerance(*told_hz)))) {
      grid.rate_hz = *told_hz;
    } else if (is_near(whole) && fits(whole, std::clamp(printed * whole, kExact, kMaxEven))) {
      grid.rate_hz = whole;
    } else if (fits(to_last, tolerance(to_last))) {
      grid.rate_hz = to_last;
    } else {
      continue;
    }
    is_whole = false;
    break;
  }

  // Refuse rates that no recording of people has, and holes that would take too much memory.
  constexpr double kRounding = 1e-6;
  if (grid.rate_hz > kMaxMotionRate_hz * (1 + kRounding)) {
    return Fail({file},
                "the times of {} rows are mostly {:.3g} s apart, which means a rate of {:.4g} Hz; allowed: at most "
                "{:g} Hz, with times in seconds",
                rows.size(), 1 / grid.rate_hz, grid.rate_hz, kMaxMotionRate_hz);
  }
  const double slack = tolerance(grid.rate_hz), count = std::floor(span * grid.rate_hz + slack) + 1;
  if (!AreGapsStorable(count, rows.size(), width)) {
    return Fail({file},
                "{} rows in {:.6g} s, mostly {:.3g} s apart, have gaps that are too large to fill; allowed: {:g} "
                "missing values in total, at {} values per frame",
                rows.size(), span, 1 / grid.rate_hz, kMaxAddedValues, width);
  }
  // Place every frame on a row, between two rows, or in a hole.
  std::size_t at = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    const auto frame = static_cast<double>(k);
    const auto place_of = [&](std::size_t i) { return (times_s[rows[i]] - start) * grid.rate_hz; };
    while (at + 1 < rows.size() && place_of(at + 1) <= frame + slack) ++at;
    const std::size_t next = std::min(at + 1, rows.size() - 1);
    GridFrame& made = grid.frames.emplace_back(GridFrame{rows[at], rows[at]});
    if (next == at || std::abs(frame - place_of(at)) <= slack) continue;
    constexpr double kMissing = 1.5;  // a row is missing if neighbouring rows are at least this many frames apart
    const double step = place_of(next) - place_of(at);
    made = {rows[at], rows[next], (frame - place_of(at)) / step, step >= kMissing && !is_whole};
  }
  grid.is_even = grid.frames.size() == times_s.size();
  for (std::size_t k = 0; grid.is_even && k < grid.frames.size(); ++k) {
    grid.is_even = grid.frames[k].row == k && grid.frames[k].part == 0;
  }
  grid.remark = DescribeGrid(grid, times_s.size() - rows.size());
  return grid;
}

std::vector<double> TimesOfNumbers(std::span<const double> numbers, double rate_hz) {
  std::vector<double> steps, times;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!(numbers[i] == std::floor(numbers[i])) || (i > 0 && !(numbers[i] > numbers[i - 1]))) return {};
    if (i > 0) steps.push_back(numbers[i] - numbers[i - 1]);
  }
  if (steps.empty()) return {};
  const double usual = LowerPercentile(std::move(steps), 0.5);
  for (const double number : numbers) times.push_back((number - numbers.front()) / usual / rate_hz);
  return times;
}

namespace {

/// Returns a remark if the times contradict the stated rate; otherwise "". Without a grid, the times are too brief or
/// all equal, and the stated rate is used.
std::string DescribeOtherRate(const MarkerRows& rows, double told_hz, const std::optional<RowGrid>& grid) {
  const std::size_t count = rows.times_s.size();
  if (count < 3) return "";
  const double span = rows.times_s.back() - rows.times_s.front();
  if (span == 0)
    return fmt::format("all times in {} are equal, so Etude uses the rate that {} states, {:g} Hz", rows.time_name,
                       rows.rate_name, told_hz);
  const double rate = grid ? grid->rate_hz : static_cast<double>(count - 1) / span;
  const bool is_other = grid ? rate != told_hz : std::abs(rate / told_hz - 1) > kBriefTolerance;
  if (!is_other) return "";  // also if a time is missing
  return fmt::format("{} states {:g} Hz{}, but the times in {} give {:g} Hz{}", rows.rate_name, told_hz,
                     grid ? "" : ", which is used", rows.time_name, rate,
                     grid ? std::string(", which is used") : fmt::format(" (from only {} rows)", count));
}

/// Returns a remark about the first place where the frame numbers jump and the times do not, or the reverse; "" if
/// there is none, or if the numbers do not increase.
std::string DescribeOtherNumbers(const MarkerRows& rows) {
  const std::vector<double>& numbers = rows.numbers;
  if (numbers.size() < 3 || numbers.size() != rows.times_s.size()) return "";
  std::vector<double> ratios;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    const double step_s = rows.times_s[i] - rows.times_s[i - 1];
    if (!(numbers[i] > numbers[i - 1]) || !(step_s > 0)) return "";
    ratios.push_back((numbers[i] - numbers[i - 1]) / step_s);
  }
  const double per_second = Median(std::move(ratios));
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    constexpr double kMinFrames = 2;
    const double counted = numbers[i] - numbers[i - 1];
    const double timed = (rows.times_s[i] - rows.times_s[i - 1]) * per_second;
    if (!(std::abs(counted - timed) >= kMinFrames) || !(std::max(counted, timed) >= 2 * std::min(counted, timed)))
      continue;
    return fmt::format(
        "the frame numbers go from {:.10g} to {:.10g}, but the times in {} advance by {:.4g} s, the duration of {:.3g} "
        "frames; Etude uses the times",
        numbers[i - 1], numbers[i], rows.time_name, rows.times_s[i] - rows.times_s[i - 1], timed);
  }
  return "";
}

}  // namespace

void TakeTimesFromNumbers(MarkerRows& rows, double rate_hz) {
  rows.times_s = TimesOfNumbers(rows.numbers, rate_hz);
  rows.has_clock = false;
  rows.first_number = rows.numbers.empty() ? 0 : rows.numbers.front();
}

Result<MarkerMotion> LayOnClock(MarkerRows rows, const std::string& file) {
  MarkerMotion& markers = rows.markers;
  const std::optional<double> told = rows.rate_name.empty() ? std::nullopt : std::optional(markers.rate_hz);
  const TimeScale scale = FindTimeScale(rows.times_s, {told, rows.rate_name, rows.time_name});
  for (double& time : rows.times_s) time = scale.SecondsOf(time);
  AddRemark(markers.remark, scale.remark);
  ASSIGN_OR_RETURN(const auto grid, GridOfRows(rows.times_s, rows.lines, told, markers.names.size(), file));
  if (told) AddRemark(markers.remark, DescribeOtherRate(rows, *told, grid));
  if (rows.has_clock && !MeanStepOfBursts(rows.times_s)) AddRemark(markers.remark, DescribeOtherNumbers(rows));
  if (!grid) return std::move(markers);
  markers.rate_hz = grid->rate_hz;
  if (!rows.has_clock && rows.first_number > 1) {
    AddRemark(markers.remark,
              fmt::format("the rows have frame numbers from {:.10g} on, but no times; Etude gives the first row time 0",
                          rows.first_number));
  }
  if (rows.has_clock) markers.start_s = scale.first * scale.seconds + rows.times_s[grid->frames.front().row];
  AddRemark(markers.remark, grid->remark);
  if (grid->is_even) return std::move(markers);
  // Interpolate each marker between the two rows of a frame if both rows contain it. Some programs write zeros for a
  // gap, so zeros are only interpolated with zeros.
  std::vector<std::vector<std::optional<glm::dvec3>>> frames;
  frames.reserve(grid->frames.size());
  for (const GridFrame& at : grid->frames) {
    const auto &row = markers.frames[at.row], &next = markers.frames[at.next];
    auto& frame = frames.emplace_back(markers.names.size());
    for (std::size_t i = 0; i < frame.size() && !at.is_hole; ++i) {
      if (at.part == 0) frame[i] = row[i];
      if (at.part == 0 || !row[i] || !next[i]) continue;
      if ((*row[i] == glm::dvec3(0)) == (*next[i] == glm::dvec3(0))) frame[i] = glm::mix(*row[i], *next[i], at.part);
    }
  }
  markers.frames = std::move(frames);
  return std::move(markers);
}

Result<MarkerMotion> LayOnClock(const JointCsv& csv, const std::string& file) {
  MarkerRows rows{.markers = {.names = {}, .frames = {}, .remark = csv.remark},
                  .times_s = csv.times_s,
                  .numbers = csv.numbers,
                  .lines = csv.lines};
  for (const Role role : AllRoles()) rows.markers.names.emplace_back(RoleName(role));
  for (const auto& frame : csv.frames) rows.markers.frames.emplace_back(frame.begin(), frame.end());
  if (!csv.rate_hz) TakeTimesFromNumbers(rows, kJudgedRateHz);
  ASSIGN_OR_RETURN(auto laid, LayOnClock(std::move(rows), file));
  if (laid.start_s) *laid.start_s += csv.scale.first * csv.scale.seconds;
  return laid;
}

Result<BodyMotion> LayOnClock(BodyMotion rows, std::span<const double> times_s, const std::string& file,
                              std::string& remark, double& start_s) {
  ASSIGN_OR_RETURN(const auto grid, GridOfRows(times_s, {}, std::nullopt, kRoleCount, file));
  start_s = times_s.empty() ? 0 : times_s.front();
  if (!grid) return rows;
  AddRemark(remark, grid->remark);
  rows.rate_hz = grid->rate_hz;
  if (grid->is_even) return rows;
  // Find the longest stretch without a hole of more than a second.
  const auto is_lost = [&](const GridFrame& frame) {
    return frame.is_hole && times_s[frame.next] - times_s[frame.row] > kMaxBridged_s;
  };
  std::size_t begin = 0, best_begin = 0, best_end = 0;
  for (std::size_t k = 0; k <= grid->frames.size(); ++k) {
    if (k < grid->frames.size() && !is_lost(grid->frames[k])) continue;
    if (k - begin > best_end - best_begin) std::tie(best_begin, best_end) = std::pair(begin, k);
    begin = k + 1;
  }
  if (best_end - best_begin < grid->frames.size()) {
    AddRemark(remark,
              fmt::format("Etude keeps only frames {} to {} of {}, because the gaps around them are longer than {:g} s",
                          best_begin + 1, best_end, grid->frames.size(), kMaxBridged_s));
  }
  start_s += static_cast<double>(best_begin) / rows.rate_hz;
  // Interpolate every joint.
  BodyMotion laid{.rate_hz = rows.rate_hz, .poses = {}};
  for (std::size_t k = best_begin; k < best_end; ++k) {
    const GridFrame& at = grid->frames[k];
    BodyPose& pose = laid.poses.emplace_back(rows.poses[at.row]);
    for (std::size_t i = 0; i < kRoleCount && at.part > 0; ++i) {
      pose.joints[i] = glm::mix(pose.joints[i], rows.poses[at.next].joints[i], at.part);
    }
  }
  return laid;
}

}  // namespace etude
