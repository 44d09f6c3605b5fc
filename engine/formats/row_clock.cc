#include "engine/formats/row_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/formats/row_rates.h"

namespace etude {
namespace {

constexpr double kMaxBridged_s = 1;

void AddRemark(std::string& remark, const std::string& text) {
  if (!text.empty()) remark += (remark.empty() ? "" : "; ") + text;
}

}  // namespace

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
  if (!grid) {
    // A single row has no rate, but its time may place it within another motion.
    if (rows.has_clock && rows.times_s.size() == 1 && !std::isnan(rows.times_s.front()))
      markers.start_s = scale.first * scale.seconds + rows.times_s.front();
    return std::move(markers);
  }
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
