#include "engine/retargeting/marker_repairs.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/retargeting/marker_sets.h"
#include "engine/retargeting/skin_markers.h"

namespace etude {
namespace {

/// Returns true if all coordinates are 0: some programs write this for a gap.
bool IsZero(const MarkerPosition& place) { return place && *place == glm::dvec3(0); }

/// Returns true if a marker set assigns this marker to an arm or a leg.
bool IsOfLimb(std::string_view name) {
  const std::string key = MarkerKey(name);
  return std::ranges::any_of(MarkerSets(), [&](const MarkerSet& set) {
    return std::ranges::any_of(set.rules, [&](const MarkerRule& rule) {
      return rule.role != Mirrored(rule.role) && std::ranges::find(rule.markers, key) != rule.markers.end();
    });
  });
}

bool Counts(const std::set<std::size_t>& used, std::size_t column) { return used.empty() || used.contains(column); }

/// Returns true if, in a tenth of the frames, the origin is farther from the markers' centroid than twice the markers'
/// median distance from that centroid. The positions are then not relative to a point of the body.
bool IsFarFromZero(const MarkerMotion& markers, const std::set<std::size_t>& used) {
  constexpr double kTimes = 2, kTenth = 0.1;
  const auto is_far = [&](const auto& frame) {
    glm::dvec3 middle(0);
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (!frame[i] || IsZero(frame[i]) || !Counts(used, i)) continue;
      middle += *frame[i];
      places.push_back(*frame[i]);
    }
    const auto count = static_cast<double>(places.size());
    std::vector<double> distances;
    for (const glm::dvec3& place : places) distances.push_back(glm::distance(place, middle / count));
    return !distances.empty() && glm::length(middle / count) > kTimes * Median(std::move(distances));
  };
  const auto far = std::ranges::count_if(markers.frames, is_far);
  return static_cast<double>(far) > kTenth * static_cast<double>(markers.frames.size());
}

/// Removes a marker's positions at 0, 0, 0 if the marker has other positions in other frames, if it is on a limb and
/// other markers move, or if the body is far from the origin. (The root of a root-relative pose stays, because it is
/// always at 0.) Returns the number of removed positions.
int LeaveZerosOut(MarkerMotion& markers, const std::set<std::size_t>& used) {
  int zeros = 0;
  const auto moves = [&](std::size_t marker) {
    return std::ranges::any_of(markers.frames,
                               [&](const auto& frame) { return frame[marker] != markers.frames.front()[marker]; });
  };
  std::optional<bool> is_far, is_moving;
  for (std::size_t marker = 0; marker < markers.names.size(); ++marker) {
    const auto is_zero = [&](const auto& frame) { return IsZero(frame[marker]); };
    const auto is_elsewhere = [&](const auto& frame) { return frame[marker] && !is_zero(frame); };
    if (std::ranges::none_of(markers.frames, is_zero)) continue;
    if (std::ranges::none_of(markers.frames, is_elsewhere)) {
      if (!is_far) is_far = IsFarFromZero(markers, used);
      if (!is_moving) is_moving = std::ranges::any_of(std::views::iota(std::size_t{0}, markers.names.size()), moves);
      if (!*is_far && !(*is_moving && IsOfLimb(markers.names[marker]))) continue;
    }
    for (auto& frame : markers.frames) {
      if (!is_zero(frame)) continue;
      frame[marker].reset();
      ++zeros;
    }
  }
  return zeros;
}

/// Returns the absolute value of the coordinates if it is the same for all three and not 0; otherwise 0.
double EqualCoordinate(const MarkerPosition& place) {
  if (!place) return 0;
  const glm::dvec3 size = glm::abs(*place);
  return size.x == size.y && size.y == size.z ? size.x : 0;
}

/// Removes positions whose coordinates are three equal numbers (apart from signs, which other axes change), if the same
/// number recurs: some programs write -1 or 9999 for a gap. Returns the number of removed positions.
int LeaveEqualNumbersOut(MarkerMotion& markers) {
  std::map<double, int> times;
  for (const auto& frame : markers.frames) {
    for (const MarkerPosition& place : frame) {
      if (const double number = EqualCoordinate(place); number > 0) ++times[number];
    }
  }
  int removed = 0;
  for (auto& frame : markers.frames) {
    for (MarkerPosition& place : frame) {
      const double number = EqualCoordinate(place);
      if (number == 0 || times[number] < 2) continue;
      place.reset();
      ++removed;
    }
  }
  return removed;
}

/// Removes positions that are a hundred times farther from the middle of the frame's used markers than usual, because
/// some programs write numbers such as -9999 for a gap. Returns the number of removed positions.
int LeaveFarOut(MarkerMotion& markers, const std::set<std::size_t>& used) {
  constexpr double kTimesUsual = 100;
  constexpr std::size_t kMinMarkers = 5;
  int far = 0;
  for (auto& frame : markers.frames) {
    std::array<std::vector<double>, 3> coordinates;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      for (int axis = 0; axis < 3 && frame[i] && Counts(used, i); ++axis)
        coordinates[static_cast<std::size_t>(axis)].push_back((*frame[i])[axis]);
    }
    if (coordinates[0].size() < kMinMarkers) continue;
    const glm::dvec3 middle(Median(coordinates[0]), Median(coordinates[1]), Median(coordinates[2]));
    std::vector<double> distances;
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (frame[i] && Counts(used, i)) distances.push_back(glm::distance(*frame[i], middle));
    }
    const double limit = kTimesUsual * Median(std::move(distances));
    for (auto& place : frame) {
      if (!place || limit == 0 || glm::distance(*place, middle) <= limit) continue;
      place.reset();
      ++far;
    }
  }
  return far;
}

/// Returns the names that several markers share. Only the first marker of a name is used.
std::vector<std::string> NamesOfSeveral(const MarkerMotion& markers) {
  std::set<std::string> seen, several;
  for (const std::string& name : markers.names) {
    if (!seen.insert(name).second) several.insert(name);
  }
  return {several.begin(), several.end()};
}

std::string DescribeNamesOfSeveral(const MarkerMotion& markers) {
  const std::vector<std::string> several = NamesOfSeveral(markers);
  if (several.empty()) return "";
  constexpr std::size_t kListed = 3;
  const std::span<const std::string> first(several.data(), std::min(several.size(), kListed));
  return fmt::format("several markers have the name {}{}; Etude uses the first marker of each name", Join(first),
                     several.size() > kListed ? ", …" : "");
}

}  // namespace

std::string DescribeEqualNames(const MarkerMotion& markers, const std::set<std::size_t>& used) {
  const bool is_used = std::ranges::any_of(
      used, [&](std::size_t column) { return std::ranges::count(markers.names, markers.names[column]) > 1; });
  return is_used ? DescribeNamesOfSeveral(markers) : "";
}

void RepairMarkers(MarkerMotion& markers, const std::set<std::size_t>& used) {
  const auto remark = [&](const std::string& text) { markers.remark += (markers.remark.empty() ? "" : "; ") + text; };
  if (const int zeros = LeaveZerosOut(markers, used); zeros > 0)
    remark(fmt::format("Etude treats {} positions at (0, 0, 0) as missing", zeros));
  if (const int far = LeaveFarOut(markers, used); far > 0) {
    remark(fmt::format(
        "Etude treats {} positions as missing, because they are a hundred times as far away as the others", far));
  }
  if (const int equal = LeaveEqualNumbersOut(markers); equal > 0) {
    remark(fmt::format("Etude treats {} repeated positions of three equal numbers as missing", equal));
  }
  const std::string equal_names = DescribeNamesOfSeveral(markers);
  if (!equal_names.empty() && DescribeEqualNames(markers, used).empty()) remark(equal_names);
}

}  // namespace etude
