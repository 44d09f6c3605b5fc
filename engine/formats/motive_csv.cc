#include "engine/formats/motive_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/formats/length_units.h"
#include "engine/formats/row_clock.h"

namespace etude {
namespace {

constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
constexpr std::size_t kMaxColumns = 20'000;

std::vector<std::string_view> CommaCells(std::string_view line) {
  std::vector<std::string_view> cells = SplitAt(line, ',');
  for (std::string_view& cell : cells) {
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
  }
  return cells;
}

std::string_view CellAt(const std::vector<std::string_view>& cells, std::size_t i) {
  return i < cells.size() ? cells[i] : std::string_view{};
}

/// Returns the value that follows a key in the first line.
std::string_view ValueBehind(const std::vector<std::string_view>& cells, std::string_view key) {
  const auto at = static_cast<std::size_t>(std::ranges::find(cells, key) - cells.begin());
  return CellAt(cells, at + 1);
}

/// The columns X, Y, Z of one position.
struct PlaceColumns {
  std::string name;
  std::array<std::size_t, 3> at{};
};

/// Finds the position columns of all objects of type `type` in the table's headings.
std::vector<PlaceColumns> PlaceColumnsOf(std::string_view type, const std::vector<std::string_view>& types,
                                         const std::vector<std::string_view>& names,
                                         const std::vector<std::string_view>& kinds,
                                         const std::vector<std::string_view>& axes) {
  std::vector<PlaceColumns> places;
  for (std::size_t i = 2; i + 2 < axes.size(); ++i) {
    const bool is_place = CellAt(types, i) == type && CellAt(kinds, i) == "Position" && axes[i] == "X" &&
                          axes[i + 1] == "Y" && axes[i + 2] == "Z";
    if (is_place) places.push_back({std::string(CellAt(names, i)), {i, i + 1, i + 2}});
  }
  return places;
}

}  // namespace

bool IsMotiveCsv(std::string_view text) { return FirstLine(WithoutByteOrderMark(text)).starts_with("Format Version,"); }

Result<MarkerMotion> ReadMotiveCsv(std::string_view text, const std::string& file) {
  if (text.size() > kMaxFileBytes)
    return Fail({file}, "found {} bytes; allowed: at most {}", text.size(), kMaxFileBytes);
  // Read the properties in the first line that is not blank.
  int line = 0;
  const auto facts = CommaCells(TakeFirstLine(text, line));
  const Place first{file, line, 0};
  const std::string_view unit = ValueBehind(facts, "Length Units"), space = ValueBehind(facts, "Coordinate Space");
  const auto metres = MetresOfUnit(unit);
  if (!metres)
    return Fail(first, "'Length Units' is {}; allowed: Meters, Centimeters, Millimeters, Inches, Feet", Quote(unit));
  if (!space.empty() && space != "Global")
    return Fail(first, "'Coordinate Space' is {}; allowed: Global", Quote(space));
  auto rate = ParseFinite(ValueBehind(facts, "Export Frame Rate"));
  if (!rate) rate = ParseFinite(ValueBehind(facts, "Capture Frame Rate"));
  constexpr double kMaxRateHz = 10'000;
  if (!rate || *rate <= 0 || *rate > kMaxRateHz)
    return Fail(first, "'Export Frame Rate' is missing or out of range; allowed: above 0, up to {:g} Hz", kMaxRateHz);

  // Read the headings, which end with the line of axes.
  std::vector<std::string_view> types, names, kinds, axes;
  while (!text.empty() && CellAt(axes, 0) != "Frame") {
    kinds = axes;
    axes = CommaCells(TakeLine(text, line));
    if (CellAt(axes, 1) == "Type") types = axes;
    if (CellAt(axes, 1) == "Name") names = axes;
  }
  if (axes.size() > kMaxColumns) return Fail({file, line, 0}, "more than {} columns", kMaxColumns);
  // Use bones, or markers if there are no bones.
  std::vector<PlaceColumns> places = PlaceColumnsOf("Bone", types, names, kinds, axes);
  if (places.empty()) places = PlaceColumnsOf("Marker", types, names, kinds, axes);
  if (places.empty() || places.size() > 1000) {
    return Fail({file, line, 0}, "found {} bones or markers with a Position; allowed: 1 to 1000", places.size());
  }

  // Read the frames; a position with an empty cell was not seen.
  MarkerRows rows{.markers = {.rate_hz = *rate, .names = {}, .frames = {}, .metres_per_unit = *metres},
                  .times_s = {},
                  .numbers = {},
                  .lines = {},
                  .rate_name = "the first line"};
  MarkerMotion& motion = rows.markers;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const bool has_times = CellAt(axes, 1).starts_with("Time");
  for (const PlaceColumns& place : places) motion.names.push_back(place.name);
  while (!text.empty()) {
    const std::string_view here = TakeLine(text, line);
    if (here.find_first_not_of(", ") == std::string_view::npos) continue;
    const auto cells = CommaCells(here);
    auto& frame = motion.frames.emplace_back();
    rows.numbers.push_back(ParseFinite(CellAt(cells, 0)).value_or(kNone));
    rows.times_s.push_back(has_times ? ParseFinite(CellAt(cells, 1)).value_or(kNone) : kNone);
    rows.lines.push_back(line);
    for (const PlaceColumns& place : places) {
      glm::dvec3 at(0);
      bool is_seen = true;
      for (int axis = 0; axis < 3; ++axis) {
        const std::string_view cell = CellAt(cells, place.at[static_cast<std::size_t>(axis)]);
        const auto value = ParseFinite(cell);
        if (!cell.empty() && !value) return Fail({file, line, 0}, "{} is not a number", Quote(cell));
        is_seen = is_seen && value;
        if (is_seen) at[axis] = *metres * *value;
      }
      frame.push_back(is_seen ? std::optional(at) : std::nullopt);
    }
  }
  const auto announced = ParseFinite(ValueBehind(facts, "Total Exported Frames"));
  if (announced && *announced > static_cast<double>(motion.frames.size())) {
    motion.remark = fmt::format("found {} rows, but 'Total Exported Frames' is {:g}", motion.frames.size(), *announced);
  }
  // If no row has a time, the frame numbers give the times.
  if (std::ranges::all_of(rows.times_s, [](double time) { return std::isnan(time); })) {
    TakeTimesFromNumbers(rows, *rate);
  }
  return LayOnClock(std::move(rows), file);
}

}  // namespace etude
