#include "engine/formats/motion_bids.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/formats/length_units.h"
#include "engine/formats/number_rows.h"
#include "engine/formats/row_clock.h"

namespace etude {
namespace {

std::string LabelOf(std::string_view name) {
  std::string label;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c))) label += c;
  }
  return label.empty() ? "motion" : label;
}

/// The meaning of each column of a recording: one coordinate of one point, or another channel.
struct BidsChannels {
  struct Column {
    int point = -1;  ///< index into `points`; −1 for other channels than positions
    int axis = 0;
    double metres = 1;  ///< metres per unit of the column
  };
  std::vector<Column> columns;
  std::vector<std::string> points;
  std::optional<std::size_t> latency = {};  ///< the column of times
  std::size_t others = 0;
};

Result<BidsChannels> ReadChannels(std::string_view text, const std::string& file) {
  BidsChannels channels;
  std::array<std::size_t, 4> at{};  // indices of the columns component, type, tracked_point, units
  constexpr std::array kHeads = {"component", "type", "tracked_point", "units"};
  std::map<std::string, int, std::less<>> points;
  std::vector<std::array<bool, 3>> has;
  std::size_t heads = 0;
  for (int line = 1; !text.empty(); ++line) {
    const auto cells = SplitAt(TakeLine(text), '\t');
    if (cells.size() == 1 && cells[0].empty()) continue;
    // The first line names the columns.
    if (heads == 0) {
      heads = cells.size();
      for (std::size_t k = 0; k < kHeads.size(); ++k) {
        const auto found = std::ranges::find(cells, kHeads[k]);
        if (found == cells.end())
          return Fail({file, line}, "no column {}; needed: {}", kHeads[k], fmt::join(kHeads, ", "));
        at[k] = static_cast<std::size_t>(found - cells.begin());
      }
      continue;
    }
    if (cells.size() != heads)
      return Fail({file, line}, "this row has {} cells, but the heading has {}", cells.size(), heads);
    // Channels that hold neither positions nor times are only counted.
    BidsChannels::Column& column = channels.columns.emplace_back();
    if (cells[at[1]] == "LATENCY" && !channels.latency) {
      channels.latency = channels.columns.size() - 1;
      continue;
    }
    if (cells[at[1]] != "POS") {
      ++channels.others;
      continue;
    }
    // Assign the column to a coordinate of its point.
    const std::string_view component = cells[at[0]], units = cells[at[3]];
    constexpr std::string_view kAxes = "xyz";
    if (component.size() != 1 || kAxes.find(component) == std::string_view::npos)
      return Fail({file, line}, "found component {}; allowed for channels of type POS: x, y, z", Quote(component));
    column.axis = static_cast<int>(kAxes.find(component));
    const auto metres = MetresOfUnit(units);
    if (!metres)
      return Fail({file, line}, "found units {}; allowed for channels of type POS: m, cm, mm, in, ft", Quote(units));
    column.metres = *metres;
    const auto [point, is_new] =
        points.try_emplace(std::string(cells[at[2]]), static_cast<int>(channels.points.size()));
    if (is_new) {
      channels.points.push_back(point->first);
      has.emplace_back();
    }
    column.point = point->second;
    bool& has_axis = has[static_cast<std::size_t>(column.point)][static_cast<std::size_t>(column.axis)];
    if (has_axis) return Fail({file, line}, "the point {} has two channels for {}", Quote(point->first), component);
    has_axis = true;
  }
  // Every point needs all three coordinates.
  for (std::size_t i = 0; i < has.size(); ++i) {
    if (std::ranges::find(has[i], false) != has[i].end())
      return Fail({file}, "{} needs channels for x, y and z, but some are missing", Quote(channels.points[i]));
  }
  if (channels.points.empty())
    return Fail({file}, "found no channel of type POS; allowed: at least one, because Etude reads only positions");
  return channels;
}

}  // namespace

BidsFiles WriteMotionBids(const BodyMotion& motion, std::string_view name, std::string_view version) {
  const std::string label = LabelOf(name);
  std::string rows, channels = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n";
  const auto out = std::back_inserter(rows);
  // Write _motion.tsv, one row per frame, and _channels.tsv, one row per coordinate.
  for (const BodyPose& pose : motion.poses) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3& p = pose.joints[j];
      fmt::format_to(out, "{}{:.6f}\t{:.6f}\t{:.6f}", j == 0 ? "" : "\t", p.x, p.y, p.z);
    }
    rows += '\n';
  }
  for (const Role role : AllRoles()) {
    for (const char axis : {'x', 'y', 'z'})
      channels += fmt::format("{0}_{1}\t{1}\tPOS\t{0}\tm\tglobal\n", RoleName(role), axis);
  }
  // Write _motion.json.
  const std::string facts = fmt::format(
      R"({{"TaskName": "{0}", "TrackingSystemName": "etude", "SamplingFrequency": {1}, "MotionChannelCount": {2},
 "POSChannelCount": {2}, "TrackedPointsCount": {3}, "RecordingDuration": {4}, "SoftwareVersions": "Etude {5}",
 "MissingValues": "n/a"}}
)",
      label, motion.rate_hz, 3 * kRoleCount, kRoleCount, static_cast<double>(motion.poses.size()) / motion.rate_hz,
      version);
  // Write _channels.json. For a person who faces +Z, x is left, y superior, z anterior (LSA).
  const std::string axes = R"({"reference_frame": {"Levels": {"global": {"SpatialAxes": "LSA",
 "Description": "Metres; x to the left of a person who faces z, y up, origin on the floor"}}}}
)";
  // Write dataset_description.json.
  const std::string set = fmt::format(
      R"({{"Name": "Motions written by Etude", "BIDSVersion": "{}", "DatasetType": "raw", "License": "n/a",
 "Authors": ["n/a"], "GeneratedBy": [{{"Name": "Etude", "Version": "{}"}}]}}
)",
      kBidsVersion, version);
  const std::string stem = fmt::format("sub-01/motion/sub-01_task-{}_tracksys-etude", label);
  return {{stem + "_motion.tsv", std::move(rows)},
          {stem + "_channels.tsv", std::move(channels)},
          {stem + "_channels.json", axes},
          {stem + "_motion.json", facts},
          {"dataset_description.json", set},
          {"README",
           "Positions of twenty joints, as _channels.tsv names them. Written by Etude; sub-01 is the performer.\n"}};
}

std::optional<glm::dvec3> UpOfSpatialAxes(std::string_view axes) {
  std::string pairs;  // the pair of each letter, named by its first letter
  glm::dvec3 up(0);
  for (std::size_t axis = 0; axis < axes.size() && axis < 3; ++axis) {
    const char letter = axes[axis];
    pairs += letter == 'P' ? 'A' : letter == 'R' ? 'L' : letter == 'I' ? 'S' : letter;
    if (pairs.back() == 'S') up[static_cast<int>(axis)] = letter == 'S' ? 1 : -1;
  }
  std::ranges::sort(pairs);
  return axes.size() == 3 && pairs == "ALS" ? std::optional(up) : std::nullopt;
}

std::set<std::string, std::less<>> FramesOfBids(std::string_view channels_tsv) {
  const auto heads = SplitAt(TakeLine(channels_tsv), '\t');
  const auto index = [&](std::string_view head) {
    return static_cast<std::size_t>(std::ranges::find(heads, head) - heads.begin());
  };
  const std::size_t type = index("type"), frame = index("reference_frame");
  std::set<std::string, std::less<>> frames;
  while (!channels_tsv.empty() && std::max(type, frame) < heads.size()) {
    const auto cells = SplitAt(TakeLine(channels_tsv), '\t');
    if (cells.size() == heads.size() && cells[type] == "POS" && cells[frame] != "n/a") frames.emplace(cells[frame]);
  }
  return frames;
}

Result<MarkerMotion> ReadMotionBids(std::string_view motion_tsv, std::string_view channels_tsv, const BidsFacts& facts,
                                    const std::array<std::string, 2>& files) {
  ASSIGN_OR_RETURN(const BidsChannels channels, ReadChannels(channels_tsv, files[1]));
  MarkerRows laid{.markers = {.rate_hz = facts.rate_hz, .names = channels.points, .frames = {}},
                  .times_s = {},
                  .lines = {},
                  .rate_name = "SamplingFrequency",
                  .time_name = "the channel LATENCY"};
  MarkerMotion& motion = laid.markers;
  // Replace the file's own text for a missing value by "nan". If that text is a number, values are compared with it
  // below.
  const auto missing = ParseFinite(facts.missing);
  std::string rows;
  for (std::string_view rest = motion_tsv; !missing && !rest.empty(); rows += '\n') {
    std::vector<std::string_view> cells = SplitAt(TakeLine(rest), '\t');
    for (std::string_view& cell : cells) cell = Trimmed(cell) == facts.missing ? "nan" : cell;
    fmt::format_to(std::back_inserter(rows), "{}", fmt::join(cells, "\t"));
  }
  ASSIGN_OR_RETURN(const NumberRows table, ReadNumberRows(missing ? motion_tsv : rows, files[0]));
  if (table.columns != channels.columns.size()) {
    return Fail({files[0], 1}, "{} columns, but {} channels in {}", table.columns, channels.columns.size(), files[1]);
  }
  if (!table.heading.empty())
    return Fail(
        {files[0], 1},
        "found a line with column names; allowed: only rows of numbers, because _channels.tsv has the column names");
  for (std::size_t t = 0; t < table.RowCount(); ++t) {
    const auto row = table.Row(t);
    std::vector<glm::dvec3> places(channels.points.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
      const BidsChannels::Column& column = channels.columns[i];
      if (column.point >= 0) places[static_cast<std::size_t>(column.point)][column.axis] = column.metres * row[i];
    }
    // A point is missing if one of its values is missing. But if 0 means missing, all three must be 0, because a single
    // coordinate may really be 0.
    std::vector<int> gaps(places.size());
    for (std::size_t i = 0; missing && i < row.size(); ++i) {
      const int point = channels.columns[i].point;
      if (point >= 0 && row[i] == *missing) ++gaps[static_cast<std::size_t>(point)];
    }
    auto& frame = motion.frames.emplace_back(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const bool is_gap = gaps[i] >= (missing == 0 ? 3 : 1);
      if (!is_gap && !std::isnan(places[i].x + places[i].y + places[i].z)) frame[i] = places[i];
    }
    // A time of 0 is a value, even in a file where 0 means "missing".
    const double time = channels.latency ? row[*channels.latency] : std::nan("");
    laid.times_s.push_back(missing && *missing != 0 && time == *missing ? std::nan("") : time);
    laid.lines.push_back(table.lines[t]);
  }
  if (channels.others > 0)
    motion.remark = fmt::format("Etude left out {} channels that are not positions", channels.others);
  return LayOnClock(std::move(laid), files[0]);
}

}  // namespace etude
