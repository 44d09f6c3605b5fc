#include "engine/formats/point_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/formats/length_units.h"
#include "engine/formats/number_rows.h"

namespace etude {
namespace {

constexpr std::string_view kNameSeparators = "_.:-/|";

/// A heading without its unit, and the unit as text; "" if the heading states none.
struct HeadingAndUnit {
  std::string_view heading, unit;
};

/// Returns the headings of a line with an underscore for each space within a heading.
std::vector<std::string> NamesOfColumns(std::string_view line) {
  std::string joined(line);
  const bool has_separator = joined.find_first_of(",;\t") != std::string::npos;
  if (has_separator) std::ranges::replace(joined, ' ', '_');
  std::vector<std::string> headings = HeadingsOf(joined);
  for (std::string& heading : headings) {
    while (heading.ends_with('_')) heading.pop_back();
    heading.erase(0, std::min(heading.find_first_not_of('_'), heading.size()));
  }
  return headings;
}

/// Splits a unit from a heading: "wrist_x[mm]", "wrist_x(mm)" or "wrist_x_mm".
HeadingAndUnit SplitUnit(std::string_view heading) {
  if (heading.ends_with(')') || heading.ends_with(']')) {
    const std::size_t open = heading.find_last_of("([");
    if (open == std::string_view::npos) return {heading, ""};
    std::string_view before = heading.substr(0, open);
    while (before.ends_with('_')) before.remove_suffix(1);
    return {before, heading.substr(open + 1, heading.size() - open - 2)};
  }
  const std::size_t end = heading.find_last_of(kNameSeparators);
  if (end == std::string_view::npos) return {heading, ""};
  return {heading.substr(0, end), heading.substr(end + 1)};
}

struct PointAndAxis {
  std::string point;
  int axis = 0;
};

std::optional<int> AxisOfLetter(char letter) {
  const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower >= 'x' && lower <= 'z' ? std::optional(lower - 'x') : std::nullopt;
}

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

/// Splits the name of a column into a point and an axis: wrist_x, WristX, x_wrist, x1 or 1x.
std::optional<PointAndAxis> SplitAxis(std::string_view name) {
  if (name.size() < 2) return std::nullopt;
  const auto is_separator = [](char c) { return kNameSeparators.find(c) != std::string_view::npos; };
  const std::size_t last = name.size() - 1;
  if (const auto axis = AxisOfLetter(name[last])) {
    const char before = name[last - 1];
    if (is_separator(before) && last > 1) return PointAndAxis{std::string(name.substr(0, last - 1)), *axis};
    const bool is_capital = name[last] < 'a' && before >= 'a' && before <= 'z';
    if (is_capital || IsDigit(before)) return PointAndAxis{std::string(name.substr(0, last)), *axis};
  }
  if (const auto axis = AxisOfLetter(name[0])) {
    if (is_separator(name[1]) && name.size() > 2) return PointAndAxis{std::string(name.substr(2)), *axis};
    if (std::ranges::all_of(name.substr(1), IsDigit)) return PointAndAxis{std::string(name.substr(1)), *axis};
  }
  return std::nullopt;
}

/// Splits a name at separators and at capitals after small letters, in lower case: "leftWrist_Pos" → left, wrist, pos.
std::vector<std::string> WordsIn(std::string_view name) {
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_separator = kNameSeparators.find(name[i]) != std::string_view::npos;
    const bool is_new = i > 0 && name[i] >= 'A' && name[i] <= 'Z' && name[i - 1] >= 'a' && name[i - 1] <= 'z';
    if (is_separator || is_new) words.emplace_back();
    if (!is_separator) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return words;
}

/// Returns true if the point's name says another quantity than a position.
bool IsOtherQuantity(const std::string& point) {
  constexpr std::array<std::string_view, 28> kOthers = {
      "vel", "velocity", "speed", "acc",         "accel", "acceleration", "jerk",   "rot",  "rotation", "euler",
      "ang", "angle",    "quat",  "orientation", "force", "moment",       "torque", "gyro", "mag",      "std",
      "err", "error",    "var",   "scale",       "cov",   "normal",       "omega",  "alpha"};
  return std::ranges::any_of(
      WordsIn(point), [&](const std::string& word) { return std::ranges::find(kOthers, word) != kOthers.end(); });
}

/// Returns the point's name without a last word that says "position".
std::string WithoutPosition(std::string point) {
  constexpr std::array<std::string_view, 6> kPositions = {"pos", "position", "loc", "location", "trans", "translation"};
  const std::string last = WordsIn(point).back();
  if (last.size() >= point.size() || std::ranges::find(kPositions, last) == kPositions.end()) return point;
  point.resize(point.size() - last.size());
  if (kNameSeparators.find(point.back()) != std::string_view::npos && point.size() > 1) point.pop_back();
  return point;
}

/// A column of a coordinate, as its heading states it.
struct CoordinateColumn {
  std::string point;
  int axis = 0;
  std::optional<double> metres;  ///< metres per unit, if stated
};

std::optional<CoordinateColumn> CoordinateOf(std::string_view heading) {
  if (auto whole = SplitAxis(heading)) return CoordinateColumn{WithoutPosition(whole->point), whole->axis, {}};
  const HeadingAndUnit split = SplitUnit(heading);
  const auto metres = MetresOfUnit(split.unit);
  const auto found = metres ? SplitAxis(split.heading) : std::nullopt;
  return found ? std::optional(CoordinateColumn{WithoutPosition(found->point), found->axis, metres}) : std::nullopt;
}

/// Returns the seconds per unit of a column of times; nullopt if the heading names no time. Without a unit: seconds.
std::optional<double> SecondsOfTime(std::string_view heading) {
  constexpr std::array<std::string_view, 6> kTimes = {"t", "time", "times", "timestamp", "timestamps", "time_stamp"};
  constexpr std::pair<std::string_view, double> kTimeUnits[] = {{"", 1},
                                                                {"s", 1},
                                                                {"sec", 1},
                                                                {"secs", 1},
                                                                {"seconds", 1},
                                                                {"ms", 1e-3},
                                                                {"msec", 1e-3},
                                                                {"milliseconds", 1e-3},
                                                                {"us", 1e-6},
                                                                {"µs", 1e-6},
                                                                {"microseconds", 1e-6},
                                                                {"ns", 1e-9},
                                                                {"nanoseconds", 1e-9},
                                                                {"min", 60},
                                                                {"minutes", 60}};
  const auto is_time = [&](std::string_view name) {
    return std::ranges::any_of(kTimes, [&](std::string_view time) { return EqualsIgnoringCase(time, name); });
  };
  const HeadingAndUnit split = is_time(heading) ? HeadingAndUnit{heading, ""} : SplitUnit(heading);
  if (!is_time(split.heading)) return std::nullopt;
  for (const auto& [unit, seconds] : kTimeUnits) {
    if (EqualsIgnoringCase(unit, split.unit)) return seconds;
  }
  return std::nullopt;
}

bool IsOneOf(std::string_view heading, std::initializer_list<std::string_view> names) {
  return std::ranges::any_of(names, [&](std::string_view name) { return EqualsIgnoringCase(name, heading); });
}

bool IsFrameNumber(std::string_view heading) {
  return IsOneOf(
      heading, {"", "frame", "frames", "frame#", "frame_number", "frame_id", "frameid", "fnum", "index", "Unnamed:_0"});
}

bool IsPerson(std::string_view heading) {
  return IsOneOf(heading,
                 {"id", "person", "person_id", "personid", "people", "track", "track_id", "trackid", "subject",
                  "subject_id", "player", "player_id", "body", "body_id", "bodyid", "skeleton", "skeleton_id"});
}

/// The columns of a table. Points are in the order of their first columns.
struct PointColumns {
  std::vector<std::string> points;
  std::vector<std::array<std::optional<std::size_t>, 3>> columns;
  std::optional<double> metres;
  std::optional<std::size_t> time, number;
  double seconds = 1;
  std::vector<std::size_t> people;
  std::vector<std::string> left_out;
};

/// Assigns the columns by their headings. Fails as ReadPointTable does.
Result<PointColumns> FindPointColumns(const std::vector<std::string>& headings, const Place& place) {
  PointColumns found;
  std::map<std::string, std::size_t> known;
  std::optional<std::string> first_unit;  // a heading that states, or lacks, the unit
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const std::string& heading = headings[i];
    if (const auto seconds = SecondsOfTime(heading); seconds && !found.time) {
      found.time = i;
      found.seconds = *seconds;
    } else if (IsFrameNumber(heading)) {
      if (!found.number || !heading.empty()) found.number = i;
    } else if (IsPerson(heading)) {
      found.people.push_back(i);
    } else if (const auto coordinate = CoordinateOf(heading); coordinate && !IsOtherQuantity(coordinate->point)) {
      if (!first_unit) {
        first_unit = heading;
        found.metres = coordinate->metres;
      }
      if (coordinate->metres != found.metres) {
        return Fail(place, "found the headings {} and {}; allowed: the same unit in all headings", Quote(*first_unit),
                    Quote(heading));
      }
      const auto [at, is_new] = known.try_emplace(coordinate->point, found.points.size());
      if (is_new) {
        found.points.push_back(coordinate->point);
        found.columns.emplace_back();
      }
      auto& column = found.columns[at->second][static_cast<std::size_t>(coordinate->axis)];
      if (column)
        return Fail(place, "found {} of the point {} twice", "xyz"[coordinate->axis], Quote(coordinate->point));
      column = i;
    } else {
      found.left_out.push_back(heading);
    }
  }
  for (std::size_t p = 0; p < found.points.size(); ++p) {
    const auto& [x, y, z] = found.columns[p];
    if (!x || !y || !z)
      return Fail(place, "found no {} of the point {}; allowed: x, y and z of each point",
                  !x   ? 'x'
                  : !y ? 'y'
                       : 'z',
                  Quote(found.points[p]));
  }
  constexpr std::size_t kMaxTablePoints = 1000;
  if (found.points.size() > kMaxTablePoints)
    return Fail(place, "found {} points; allowed: at most {}", found.points.size(), kMaxTablePoints);
  return found;
}

/// Returns the headings, or none if the first line that is not a comment is no line of headings.
std::string_view HeadingLine(std::string_view text) {
  text = WithoutByteOrderMark(text);
  while (!text.empty()) {
    const std::string_view line = Trimmed(TakeLine(text));
    if (!line.empty() && !line.starts_with('#') && !line.starts_with("//")) return line;
  }
  return {};
}

/// Refuses rows of several people, which would be read as one person who jumps. A column that ascends from row to row
/// counts rows.
Result<void> CheckOnePerson(const NumberRows& table, std::size_t column, const std::string& heading,
                            const std::string& file) {
  std::size_t changed = 0;
  bool ascends = true;
  for (std::size_t t = 1; t < table.RowCount(); ++t) {
    const double before = table.Row(t - 1)[column], here = table.Row(t)[column];
    ascends = ascends && here > before;
    if (changed == 0 && here != before && !std::isnan(here) && !std::isnan(before)) changed = t;
  }
  if (changed == 0 || ascends) return {};
  return Fail({file, table.lines[changed]}, "the column {} goes from {:g} to {:g}; allowed: the rows of one person",
              Quote(heading), table.Row(changed - 1)[column], table.Row(changed)[column]);
}

/// Describes what was left out and assumed.
std::string RemarkOn(const PointColumns& columns, const NumberRows& table) {
  constexpr std::size_t kListedColumns = 8;
  std::vector<std::string> said;
  if (table.has_decimal_commas) said.emplace_back("Etude read commas as decimal points");
  if (!columns.left_out.empty()) {
    const bool has_more = columns.left_out.size() > kListedColumns;
    const std::span<const std::string> listed(columns.left_out.data(),
                                              has_more ? kListedColumns : columns.left_out.size());
    said.push_back("Etude left out columns that are no positions: " + Join(listed) + (has_more ? ", …" : ""));
  }
  return Join(said, "; ");
}

}  // namespace

bool IsPointTable(std::string_view text) {
  constexpr std::size_t kMinTablePoints = 3;
  std::map<std::string, int> axes;
  for (const std::string& heading : NamesOfColumns(HeadingLine(text))) {
    if (const auto found = CoordinateOf(heading)) axes[found->point] |= 1 << found->axis;
  }
  constexpr int kAllAxes = 7;
  return std::ranges::count(axes, kAllAxes, [](const auto& one) { return one.second; }) >=
         static_cast<std::ptrdiff_t>(kMinTablePoints);
}

Result<PointTable> ReadPointTable(std::string_view text, const std::string& file) {
  constexpr double kMaxTableTime = 1e19, kMaxCoordinate = 1e9, kNoTime = std::numeric_limits<double>::quiet_NaN();
  constexpr std::size_t kMaxTableRows = 1'000'000;
  ASSIGN_OR_RETURN(const NumberRows table, ReadNumberRows(text, file, kMaxTableTime, true));
  if (table.RowCount() > kMaxTableRows)
    return Fail({file}, "found {} rows; allowed: at most {}", table.RowCount(), kMaxTableRows);
  // Find the columns. Columns of texts are no positions.
  const std::vector<std::string> headings = NamesOfColumns(table.heading);
  if (headings.size() != table.columns)
    return Fail({file, 1}, "found {} headings, but {} columns", headings.size(), table.columns);
  ASSIGN_OR_RETURN(PointColumns columns, FindPointColumns(headings, {file, 1}));
  for (const auto& [column, word] : table.texts) {
    if (std::ranges::find(columns.left_out, headings[column]) != columns.left_out.end()) continue;
    if (std::ranges::find(columns.people, column) != columns.people.end()) continue;
    return Fail({file, table.lines.front()}, "column {}: found {}; allowed: a number, or nan for a missing value",
                Quote(headings[column]), Quote(word));
  }
  for (const std::size_t column : columns.people)
    RETURN_IF_ERROR(CheckOnePerson(table, column, headings[column], file));
  // Read the rows.
  PointTable read{.rows = {.markers = {.names = columns.points, .frames = {}}, .times_s = {}, .lines = table.lines},
                  .has_unit = columns.metres.has_value(),
                  .has_rate = columns.time.has_value()};
  const double metres = columns.metres.value_or(1);
  read.rows.markers.metres_per_unit = metres;
  for (std::size_t t = 0; t < table.RowCount(); ++t) {
    const auto row = table.Row(t);
    auto& frame = read.rows.markers.frames.emplace_back(columns.points.size());
    for (std::size_t p = 0; p < columns.points.size(); ++p) {
      const auto& [x, y, z] = columns.columns[p];
      const glm::dvec3 place(row[*x], row[*y], row[*z]);
      if (std::isnan(place.x + place.y + place.z)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(place[axis]) <= kMaxCoordinate) continue;
        return Fail({file, table.lines[t]}, "{} of {}: found {:.10g}; allowed: a number within ±{:g}", "xyz"[axis],
                    Quote(columns.points[p]), place[axis], kMaxCoordinate);
      }
      frame[p] = metres * place;
    }
    read.rows.times_s.push_back(columns.time ? columns.seconds * row[*columns.time] : kNoTime);
    if (columns.number) read.rows.numbers.push_back(row[*columns.number]);
  }
  if (columns.time) read.rows.time_name = "the column " + headings[*columns.time];
  if (!columns.time) TakeTimesFromNumbers(read.rows, kJudgedRateHz);
  read.rows.markers.remark = RemarkOn(columns, table);
  return read;
}

}  // namespace etude
