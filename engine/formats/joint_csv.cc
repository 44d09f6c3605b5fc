#include "engine/formats/joint_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/formats/number_rows.h"

namespace etude {
namespace {

constexpr std::size_t kMaxRows = 1'000'000;  // nine hours at 30 Hz
constexpr double kMaxTime = 1e19;            // nanoseconds since 1970

std::string HeadingOf(Role role, int axis) { return fmt::format("{}_{}_m", RoleName(role), "xyz"[axis]); }

/// Returns the rate from the median of the positive time steps; steps of 0 occur if times are printed with few
/// decimals.
std::optional<double> RateOf(const std::vector<double>& times_s) {
  std::vector<double> steps;
  for (std::size_t t = 1; t < times_s.size(); ++t) {
    if (const double step = times_s[t] - times_s[t - 1]; step > 0) steps.push_back(step);
  }
  return steps.empty() ? std::nullopt : std::optional(1 / UpperMedian(std::move(steps)));
}

/// Refuses times that decrease; equal times are allowed.
Result<void> CheckTimes(const NumberRows& table, std::size_t time_column, const std::string& file) {
  double last = -std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < table.RowCount(); ++t) {
    const double time = table.Row(t)[time_column];
    if (time < last) {
      return Fail({file, table.lines[t]}, "the time {:.13g} s follows {:.13g} s; allowed: times that do not decrease",
                  time, last);
    }
    if (!std::isnan(time)) last = time;
  }
  return {};
}

Result<void> CheckColumns(std::size_t headings, std::size_t columns, const std::string& file) {
  if (headings == columns) return {};
  return Fail({file, 1}, "{} headings, but {} columns{}", headings, columns,
              2 * columns >= 3 * headings && headings > 1
                  ? "; if the numbers have decimal commas, separate the columns by semicolons or tabs"
                  : "");
}

/// Assigns the columns to joints and coordinates by their headings; `left_out` receives the unknown headings of text
/// columns.
Result<JointCsvColumns> FindColumns(const NumberRows& table, const std::string& file,
                                    std::vector<std::string>& left_out) {
  // Check the number of headings, and list the headings that are known.
  const std::vector<std::string> headings = HeadingsOf(table.heading);
  RETURN_IF_ERROR(CheckColumns(table.heading.empty() ? 0 : headings.size(), table.columns, file));
  std::vector<std::string> known = {"frame", "time_s"};
  for (const Role role : AllRoles()) {
    for (int axis = 0; axis < 3; ++axis) known.push_back(HeadingOf(role, axis));
  }
  // Assign each column.
  JointCsvColumns columns{.heading = table.heading, .count = headings.size()};
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const bool is_minutes = NamesMinutes(headings[i]);
    const auto found = std::ranges::find(known, is_minutes ? "time_s" : headings[i]);
    const auto text = std::ranges::find(table.texts, i, &std::pair<std::size_t, std::string>::first);
    if (text != table.texts.end() && found != known.end()) {
      return Fail({file, table.lines.front()}, "column {}: found {}; allowed: a number, or nan for a missing value",
                  headings[i], Quote(text->second));
    }
    if (text != table.texts.end()) {
      left_out.push_back(headings[i]);
      columns.texts.push_back(i);
      continue;
    }
    if (found == known.end()) return Fail({file, 1}, "{}", UnknownName("heading", headings[i], known));
    if (std::ranges::count(headings, headings[i]) > 1) return Fail({file, 1}, "heading '{}' twice", headings[i]);
    const auto number = static_cast<std::size_t>(found - known.begin());
    if (number == 0) columns.number = i;
    if (number == 1 && columns.time) {
      return Fail({file, 1}, "found two columns of times, '{}' and '{}'; allowed: one", headings[*columns.time],
                  headings[i]);
    }
    if (number == 1) columns.time = i;
    columns.counts_minutes = columns.counts_minutes || is_minutes;
    if (number >= 2) columns.joints[(number - 2) / 3][(number - 2) % 3] = i;
  }
  // A joint must have columns for all three coordinates or for none.
  for (const Role role : AllRoles()) {
    const auto& [x, y, z] = columns.joints[Index(role)];
    if (x.has_value() == y.has_value() && y.has_value() == z.has_value()) continue;
    return Fail({file, 1}, "'{}' needs columns for x, y and z, but some are missing", RoleName(role));
  }
  return columns;
}

/// Refuses positions that are too large to be computed with.
Result<void> CheckPlaces(std::span<const double> values, const JointCsvColumns& columns, const Place& place) {
  constexpr double kMax = 1e9;
  for (const auto& joint : columns.joints) {
    for (const auto& column : joint) {
      if (!column || !(std::abs(values[*column]) > kMax)) continue;
      return Fail(place, "value {}: found {:.10g}; allowed: a number within ±{:g}, or nan for a missing value",
                  *column + 1, values[*column], kMax);
    }
  }
  return {};
}

JointCsvRow RowOf(std::span<const double> values, const JointCsvColumns& columns) {
  JointCsvRow row{.time_s = columns.time ? values[*columns.time] : std::numeric_limits<double>::quiet_NaN()};
  if (columns.counts_minutes) row.time_s *= kMinute_s;
  for (std::size_t j = 0; j < kRoleCount; ++j) {
    const auto& [x, y, z] = columns.joints[j];
    if (!x) continue;
    const glm::dvec3 place(values[*x], values[*y], values[*z]);
    if (!std::isnan(place.x + place.y + place.z)) row.places[j] = place;
  }
  return row;
}

}  // namespace

std::string WriteJointCsv(const BodyMotion& motion, double start_s) {
  std::string text = "frame,time_s";
  const auto out = std::back_inserter(text);
  for (const Role role : AllRoles()) {
    for (const char axis : {'x', 'y', 'z'}) fmt::format_to(out, ",{}_{}_m", RoleName(role), axis);
  }
  text += '\n';
  for (std::size_t k = 0; k < motion.poses.size(); ++k) {
    fmt::format_to(out, "{},{}", k, start_s + static_cast<double>(k) / motion.rate_hz);
    for (const glm::dvec3& joint : motion.poses[k].joints) fmt::format_to(out, ",{},{},{}", joint.x, joint.y, joint.z);
    text += '\n';
  }
  return text;
}

bool IsJointCsv(std::string_view text) {
  constexpr std::string_view kEnd = "_x_m";
  std::vector<std::string> roles;
  for (const Role role : AllRoles()) roles.emplace_back(RoleName(role));
  bool is_found = false;
  for (const std::string& one : HeadingsOf(FirstLine(text))) {
    if (!one.ends_with(kEnd)) continue;
    const std::string name = one.substr(0, one.size() - kEnd.size());
    if (std::ranges::find(roles, name) == roles.end() && NearestName(name, roles).empty()) return false;
    is_found = true;
  }
  return is_found;
}

Result<JointCsv> ReadJointCsv(std::string_view text, const std::string& file) {
  // Find the columns, then read the rows.
  ASSIGN_OR_RETURN(const NumberRows table, ReadNumberRows(text, file, kMaxTime, true));
  if (table.RowCount() > kMaxRows)
    return Fail({file}, "found {} rows; allowed: at most {}", table.RowCount(), kMaxRows);
  JointCsv csv;
  std::vector<std::string> left_out;
  ASSIGN_OR_RETURN(csv.columns, FindColumns(table, file, left_out));
  if (csv.columns.time) RETURN_IF_ERROR(CheckTimes(table, *csv.columns.time, file));
  csv.lines = table.lines;
  for (std::size_t t = 0; t < table.RowCount(); ++t) {
    RETURN_IF_ERROR(CheckPlaces(table.Row(t), csv.columns, {file, table.lines[t]}));
    const JointCsvRow row = RowOf(table.Row(t), csv.columns);
    csv.times_s.push_back(row.time_s);
    if (csv.columns.number) csv.numbers.push_back(table.Row(t)[*csv.columns.number]);
    csv.frames.push_back(row.places);
  }
  // Convert the times to seconds, and state assumptions and ignored columns in the remark.
  csv.scale = FindTimeScale(csv.times_s, {});
  for (double& time : csv.times_s) time = csv.scale.SecondsOf(time);
  csv.rate_hz = RateOf(csv.times_s);
  std::vector<std::string> said;
  if (csv.columns.counts_minutes) said.emplace_back("the heading of the times names minutes");
  if (!csv.scale.remark.empty()) said.push_back(csv.scale.remark);
  const auto is_first = [&](double time) { return time == csv.times_s.front(); };
  if (csv.times_s.size() > 1 && std::ranges::all_of(csv.times_s, is_first)) {
    said.emplace_back("all times in the column time_s are equal, so they do not determine the rate");
  }
  if (table.has_decimal_commas) said.emplace_back("Etude read commas as decimal points");
  if (!left_out.empty()) {
    constexpr std::size_t kListed = 8;
    const bool has_more = left_out.size() > kListed;
    left_out.resize(std::min(left_out.size(), kListed));
    said.push_back("Etude left out columns that contain text: " + Join(left_out) + (has_more ? ", …" : ""));
  }
  csv.remark = Join(said, "; ");
  return csv;
}

Result<JointCsvRow> ReadJointCsvRow(std::string_view row, const JointCsvColumns& columns, const std::string& file) {
  // Put the heading above the row. The heading determines the separator. Without a heading, ReadNumberRows would
  // mistake a row that begins with a word for the heading.
  ASSIGN_OR_RETURN(const NumberRows table,
                   ReadNumberRows(columns.heading + "\n" + std::string(row), file, kMaxTime, true));
  RETURN_IF_ERROR(CheckColumns(columns.count, table.columns, file));
  for (const auto& [column, text] : table.texts) {
    if (std::ranges::count(columns.texts, column) > 0) continue;
    return Fail({file, table.lines.front()}, "value {}: found {}; allowed: a number, or nan for a missing value",
                column + 1, Quote(text));
  }
  RETURN_IF_ERROR(CheckPlaces(table.Row(0), columns, {file, table.lines.front()}));
  return RowOf(table.Row(0), columns);
}

}  // namespace etude
