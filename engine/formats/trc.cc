#include "engine/formats/trc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/formats/comma_use.h"
#include "engine/formats/length_units.h"
#include "engine/formats/row_clock.h"

namespace etude {

namespace {

constexpr double kMillimetres = 1000;

std::string Head(double rate_hz, std::size_t frames, std::span<const std::string> markers, std::string name) {
  // The name is in a table, so it must not contain line ends or tabs.
  std::ranges::replace_if(
      name, [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; }, '_');
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "PathFileType\t4\t(X/Y/Z)\t{}.trc\n", name);
  fmt::format_to(out,
                 "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
                 "OrigNumFrames\n");
  fmt::format_to(out, "{0}\t{0}\t{1}\t{2}\tmm\t{0}\t1\t{1}\n", rate_hz, frames, markers.size());
  // A marker's name is above the first of its three columns.
  text += "Frame#\tTime";
  for (const std::string& marker : markers) fmt::format_to(out, "\t{}\t\t", marker);
  text += "\n\t";
  for (std::size_t i = 1; i <= markers.size(); ++i) fmt::format_to(out, "\tX{0}\tY{0}\tZ{0}", i);
  text += "\n\n";
  return text;
}

void AddPlace(const std::optional<glm::dvec3>& place, std::string& text) {
  for (int axis = 0; axis < 3; ++axis) {
    text += '\t';
    if (place) fmt::format_to(std::back_inserter(text), "{:.5f}", kMillimetres * (*place)[axis]);
  }
}

/// Splits a line at its tabs; a tab at the end gives an empty last cell.
std::vector<std::string_view> Cells(std::string_view line) {
  std::vector<std::string_view> cells = SplitAt(line, '\t');
  for (std::string_view& cell : cells) {
    while (cell.starts_with(' ')) cell.remove_prefix(1);
    while (cell.ends_with(' ')) cell.remove_suffix(1);
  }
  return cells;
}

/// Reads a number with a decimal point or a decimal comma.
std::optional<double> NumberIn(std::string_view cell) {
  if (const std::size_t comma = cell.find(','); comma != std::string_view::npos) {
    std::string pointed(cell);
    pointed[comma] = '.';
    return ParseNumber<double>(pointed);
  }
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  return ParseNumber<double>(cell);
}

/// The values in the header's third line.
struct TrcHeader {
  double rate_hz = 0;
  std::size_t frames = 0, markers = 0;
  double metres = 0;  ///< metres per unit of the file
};

Result<TrcHeader> ReadHeader(std::string_view names, std::string_view values, const Place& place) {
  const auto keys = Cells(names), cells = Cells(values);
  const auto of = [&](std::string_view key) {
    const auto found = std::ranges::find(keys, key);
    const auto at = static_cast<std::size_t>(found - keys.begin());
    return at < cells.size() ? cells[at] : std::string_view{};
  };
  const auto rate = NumberIn(of("DataRate")), frames = NumberIn(of("NumFrames")), markers = NumberIn(of("NumMarkers"));
  constexpr double kMaxFrames = 1e7, kMaxMarkers = 1000;
  if (!rate || !frames || !markers || !(*rate >= 0) || !(*frames >= 0 && *frames <= kMaxFrames) ||
      !(*markers >= 1 && *markers <= kMaxMarkers)) {
    return Fail(place,
                "the header is not that of a TRC file; allowed: one line with DataRate, NumFrames, NumMarkers and "
                "Units, and one line with their values, both separated by tabs; at most 1000 markers");
  }
  const std::string_view unit = of("Units");
  const auto metres = MetresOfUnit(unit);
  if (!metres) return Fail(place, "found units '{}'; allowed: m, cm, mm, in, ft", unit);
  return TrcHeader{*rate, static_cast<std::size_t>(*frames), static_cast<std::size_t>(*markers), *metres};
}

/// Checks the line X1 Y1 Z1 X2 …. Labels with the same number belong to one marker; without numbers, each three do.
/// Fails if a marker's three axes are in another order than X, Y, Z. Other texts are ignored.
Result<void> CheckAxes(std::span<const std::string_view> cells, Place place) {
  std::string order, number;
  int column = 1;
  for (const std::string_view cell : cells) {
    const std::size_t axis = cell.empty() ? std::string_view::npos : std::string_view("XYZxyz").find(cell.front());
    if (axis != std::string_view::npos) {
      if (order.size() == 3 || cell.substr(1) != number) order.clear();
      if (order.empty()) place.column = column;
      number = cell.substr(1);
      order += "XYZXYZ"[axis];
      if (order != "XYZ" && std::ranges::is_permutation(order, std::string_view("XYZ"))) {
        return Fail(place, "found axes in the order {}; allowed: X, Y, Z of each marker", order);
      }
    }
    column += static_cast<int>(cell.size()) + 1;
  }
  return {};
}

Result<std::vector<std::optional<glm::dvec3>>> ReadFrame(std::string_view line, const TrcHeader& header,
                                                         const Place& place) {
  const auto cells = Cells(line);
  if (cells.size() < 2 || cells.size() > 2 + 3 * header.markers + 1) {
    return Fail(place, "found {} columns; allowed: {} for {} markers", cells.size(), 2 + 3 * header.markers,
                header.markers);
  }
  // A row may end after any marker, but a missing cell would shift the coordinates of all later markers.
  std::size_t filled = cells.size();
  while (filled > 2 && cells[filled - 1].empty()) --filled;
  if ((filled - 2) % 3 != 0) {
    return Fail(place, "found {} coordinates; allowed: a multiple of 3 (X, Y and Z of each marker)", filled - 2);
  }
  std::vector<std::optional<glm::dvec3>> frame(header.markers);
  for (std::size_t marker = 0; marker < header.markers; ++marker) {
    glm::dvec3 position(0);
    bool is_seen = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = 2 + 3 * marker + axis;
      const std::string_view cell = at < cells.size() ? cells[at] : std::string_view{};
      const auto value = NumberIn(cell);
      if (!cell.empty() && !value) return Fail(place, "{} is not a number", Quote(cell));
      constexpr double kMaxCoordinate = 1e9;  // limit of coordinates in millimetres, the unit of written files
      is_seen =
          is_seen && value && std::abs(*value) * (kMillimetres * header.metres) <= kMaxCoordinate;  // false for "nan"
      if (is_seen) position[static_cast<int>(axis)] = header.metres * *value;
    }
    if (is_seen) frame[marker] = position;
  }
  return frame;
}

}  // namespace

MarkerMotion JointMarkers(const BodyMotion& motion, double start_s) {
  MarkerMotion markers{.rate_hz = motion.rate_hz, .names = {}, .frames = {}, .start_s = start_s};
  for (const Role role : AllRoles()) markers.names.emplace_back(RoleName(role));
  for (const BodyPose& pose : motion.poses) markers.frames.emplace_back(pose.joints.begin(), pose.joints.end());
  return markers;
}

std::string WriteTrc(const BodyMotion& motion, std::string name) {
  return WriteTrc(JointMarkers(motion, 0), std::move(name));
}

std::string WriteTrc(const MarkerMotion& motion, std::string name) {
  std::string text = Head(motion.rate_hz, motion.frames.size(), motion.names, std::move(name));
  for (std::size_t k = 0; k < motion.frames.size(); ++k) {
    const double time_s = motion.start_s.value_or(0) + static_cast<double>(k) / motion.rate_hz;
    fmt::format_to(std::back_inserter(text), "{}\t{:.6f}", k + 1, time_s);
    for (const auto& place : motion.frames[k]) AddPlace(place, text);
    text += '\n';
  }
  return text;
}

Result<MarkerRows> ReadTrcRows(std::string_view text, const std::string& file) {
  constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
  if (text.size() > kMaxFileBytes)
    return Fail({file}, "found {} bytes; allowed: at most {}", text.size(), kMaxFileBytes);
  // Read the header and the markers' names.
  int line = 0;
  TakeFirstLine(text, line);  // skip the line PathFileType
  const std::string_view keys = TakeLine(text, line), values = TakeLine(text, line);
  ASSIGN_OR_RETURN(const TrcHeader header, ReadHeader(keys, values, {file, line, 0}));
  MarkerRows rows{.markers = {.rate_hz = header.rate_hz, .names = {}, .frames = {}, .metres_per_unit = header.metres},
                  .times_s = {},
                  .lines = {},
                  .rate_name = header.rate_hz > 0 ? "DataRate" : ""};
  MarkerMotion& motion = rows.markers;
  const auto names = Cells(TakeLine(text, line));
  for (std::size_t marker = 0; marker < header.markers; ++marker) {
    const std::size_t at = 2 + 3 * marker;
    if (at >= names.size() || names[at].empty())
      return Fail({file, line, 0}, "the header states {} markers, but this line has only {} names", header.markers,
                  marker);
    motion.names.emplace_back(names[at]);
  }
  // Check the axes; a line that begins with a number is the first frame of a file without that line.
  const std::string_view after_names = text;
  const auto axes = Cells(TakeLine(text, line));
  RETURN_IF_ERROR(CheckAxes(axes, {file, line, 0}));
  if (NumberIn(axes.front())) {
    text = after_names;
    --line;
  }
  const bool has_commas = text.find(',') != std::string_view::npos;
  if (has_commas) motion.remark = "Etude read commas as decimal points";
  // Check the size before any frame is stored: rows may leave out the cells of their last markers, so frames may take
  // far more memory than the text.
  constexpr double kMaxFrameBytes = 1e9;
  const auto line_ends = static_cast<double>(std::max(std::ranges::count(text, '\n'), std::ranges::count(text, '\r')));
  const double bytes = line_ends * static_cast<double>(header.markers * sizeof(std::optional<glm::dvec3>));
  if (bytes > kMaxFrameBytes) {
    return Fail({file, line, 0}, "{} rows of {} markers take {:.0f} MB; allowed: at most {:.0f} MB", line_ends,
                header.markers, bytes / 1e6, kMaxFrameBytes / 1e6);
  }
  // Read the frames, their numbers and their times.
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  CommaUse commas;
  while (!text.empty()) {
    const std::string_view here = TakeLine(text, line);
    if (here.find_first_not_of(" \t") == std::string_view::npos) continue;
    ASSIGN_OR_RETURN(auto frame, ReadFrame(here, header, {file, line, 0}));
    motion.frames.push_back(std::move(frame));
    const auto cells = Cells(here);
    for (std::size_t i = 0; has_commas && i < cells.size(); ++i) commas.Add(cells[i], i, here, line);
    rows.numbers.push_back(NumberIn(cells[0]).value_or(kNone));
    rows.times_s.push_back(NumberIn(cells[1]).value_or(kNone));
    rows.lines.push_back(line);
  }
  RETURN_IF_ERROR(commas.Check(file));
  if (motion.frames.size() != header.frames) {
    return Fail({file}, "the file contains {} frames, but its header states {}", motion.frames.size(), header.frames);
  }
  // If no row has a time, the frame numbers give the times.
  if (std::ranges::all_of(rows.times_s, [](double time) { return std::isnan(time); })) {
    TakeTimesFromNumbers(rows, header.rate_hz);
    if (header.rate_hz == 0) return Fail({file, 3, 0}, "DataRate is 0, and the rows have no times");
  }
  return rows;
}

Result<MarkerMotion> ReadTrc(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(auto rows, ReadTrcRows(text, file));
  ASSIGN_OR_RETURN(auto laid, LayOnClock(std::move(rows), file));
  if (laid.rate_hz == 0) return Fail({file, 3, 0}, "DataRate is 0, and all rows have the same time");
  return laid;
}

}  // namespace etude
