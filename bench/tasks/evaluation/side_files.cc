#include "bench/tasks/evaluation/side_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/csv.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/formats/number_rows.h"

namespace etude {
Result<StatisticsByJoint> ReadJointStatistics(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const NumberRows rows, ReadNumberRows(text, file));
  ASSIGN_OR_RETURN(const auto heading_rows, ReadCsv(rows.heading, file));
  const std::vector<std::string> names = heading_rows.empty() ? std::vector<std::string>{} : heading_rows[0].cells;
  if (rows.heading.empty() || names.size() != rows.columns || rows.RowCount() != 2) {
    return Fail({file},
                "found {} names in the heading, and {} rows of {} numbers; allowed: a heading JOINT_x_m,JOINT_y_m,…, a "
                "row of means and a row of deviations",
                rows.heading.empty() ? 0 : names.size(), rows.RowCount(), rows.columns);
  }
  constexpr std::string_view kEndings[] = {"_x_m", "_y_m", "_z_m"};
  StatisticsByJoint statistics;
  std::map<std::string, int, std::less<>> axes;  // for each joint, the number of axes read so far
  for (std::size_t column = 0; column < names.size(); ++column) {
    const std::string& name = names[column];
    const auto axis = std::ranges::find_if(kEndings, [&](std::string_view end) { return name.ends_with(end); });
    const Place heading{file, 1, 0}, deviations{file, rows.lines[1], 0};
    if (axis == std::end(kEndings)) return Fail(heading, "the name {} must end in _x_m, _y_m or _z_m", Quote(name));
    const std::string joint = name.substr(0, name.size() - axis->size());
    const auto index = static_cast<glm::length_t>(axis - std::begin(kEndings));
    const double mean = rows.Row(0)[column], deviation = rows.Row(1)[column];
    if (!(deviation > 0) || !(mean == mean)) {
      return Fail(deviations, "{}: found mean {} and deviation {}; allowed: a number as mean, and a deviation above 0",
                  Quote(name), mean, deviation);
    }
    if (axes[joint]++ != index)
      return Fail(heading, "{} is out of order; allowed: for each joint, _x_m, _y_m and _z_m in this order",
                  Quote(name));
    statistics[joint].mean[index] = mean;
    statistics[joint].deviation[index] = deviation;
  }
  for (const auto& [joint, count] : axes) {
    if (count != 3) return Fail({file, 1, 0}, "joint {} has {} coordinates; needed: three", Quote(joint), count);
  }
  return statistics;
}

Result<std::vector<double>> ReadMusicBeats(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const NumberRows rows, ReadNumberRows(text, file));
  if (rows.columns != 1)
    return Fail({file}, "found {} numbers in a line; allowed: one number, a time in seconds", rows.columns);
  for (std::size_t i = 0; i < rows.values.size(); ++i) {
    const double before = i == 0 ? -1e9 : rows.values[i - 1];
    if (rows.values[i] > before) continue;
    return Fail({file, rows.lines[i], 0}, "found a beat at {} s; allowed: times that increase from line to line",
                rows.values[i]);
  }
  return rows.values;
}

std::string DoubtOnBeats(std::span<const double> beats_s, double motion_s, double rate_hz) {
  constexpr double kMaxSeconds = 3, kMinBeat_s = 0.25, kMaxBeat_s = 1.5;
  std::vector<double> steps;
  for (std::size_t i = 1; i < beats_s.size(); ++i) steps.push_back(beats_s[i] - beats_s[i - 1]);
  if (steps.empty() || beats_s.back() <= motion_s) return "";
  const double step = Median(steps);
  if (step <= kMaxSeconds) return "";
  // Frames of librosa: 512 samples at 22,050 Hz.
  const std::pair<double, std::string> units[] = {{512 / 22050.0, "frames of librosa (512 samples at 22050 Hz)"},
                                                  {1 / rate_hz, fmt::format("frames of the motion ({:g} Hz)", rate_hz)},
                                                  {1e-3, "milliseconds"}};
  const auto distance = [&](double unit) { return std::abs(std::log(beats_s.back() * unit / motion_s)); };
  const std::pair<double, std::string>* likely = nullptr;
  for (const auto& unit : units) {
    if (step * unit.first < kMinBeat_s || step * unit.first > kMaxBeat_s) continue;
    if (likely == nullptr || distance(unit.first) < distance(likely->first)) likely = &unit;
  }
  if (likely == nullptr) return "";
  return fmt::format(
      ", the music's beats are {:.3g} s apart and end at {:.4g} s, after the motion's end ({:.3g} s): are they {} "
      "instead "
      "of seconds?",
      step, beats_s.back(), motion_s, likely->second);
}

}  // namespace etude
