#include "engine/retargeting/marker_repairs.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/retargeting/skin_markers.h"

namespace etude {
namespace {

/// Returns true if all coordinates are 0, which some programs write for a gap.
bool IsZero(const MarkerPosition& place) { return place && *place == glm::dvec3(0); }

/// Removes positions whose coordinates are all 0, for markers that are elsewhere in other frames; the root of a
/// root-relative pose stays, because it is always at 0. Returns their number.
int LeaveZerosOut(MarkerMotion& markers) {
  int zeros = 0;
  for (std::size_t marker = 0; marker < markers.names.size(); ++marker) {
    const auto is_zero = [&](const auto& frame) { return IsZero(frame[marker]); };
    const auto is_elsewhere = [&](const auto& frame) { return frame[marker] && !is_zero(frame); };
    if (std::ranges::none_of(markers.frames, is_zero) || std::ranges::none_of(markers.frames, is_elsewhere)) continue;
    for (auto& frame : markers.frames) {
      if (!is_zero(frame)) continue;
      frame[marker].reset();
      ++zeros;
    }
  }
  return zeros;
}

/// Leaves out positions that are a hundred times as far from the middle of their frame as usual there: numbers such as
/// -9999 that some programs write for a gap. Returns their number.
int LeaveFarOut(MarkerMotion& markers) {
  constexpr double kTimesUsual = 100;
  constexpr std::size_t kMinMarkers = 5;
  int far = 0;
  for (auto& frame : markers.frames) {
    std::array<std::vector<double>, 3> coordinates;
    for (const auto& place : frame) {
      for (int axis = 0; axis < 3 && place; ++axis)
        coordinates[static_cast<std::size_t>(axis)].push_back((*place)[axis]);
    }
    if (coordinates[0].size() < kMinMarkers) continue;
    const glm::dvec3 middle(Median(coordinates[0]), Median(coordinates[1]), Median(coordinates[2]));
    std::vector<double> distances;
    for (const auto& place : frame) {
      if (place) distances.push_back(glm::distance(*place, middle));
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

/// Returns the names that several markers have, of which only the first is used.
std::vector<std::string> NamesOfSeveral(const MarkerMotion& markers) {
  std::set<std::string> seen, several;
  for (const std::string& name : markers.names) {
    if (!seen.insert(name).second) several.insert(name);
  }
  return {several.begin(), several.end()};
}

}  // namespace

void RepairMarkers(MarkerMotion& markers) {
  const auto remark = [&](const std::string& text) { markers.remark += (markers.remark.empty() ? "" : "; ") + text; };
  if (const int zeros = LeaveZerosOut(markers); zeros > 0)
    remark(fmt::format("{} positions at 0, 0, 0 taken as gaps", zeros));
  if (const int far = LeaveFarOut(markers); far > 0) {
    remark(fmt::format("{} positions a hundred times as far away as the others taken as gaps", far));
  }
  if (const auto several = NamesOfSeveral(markers); !several.empty()) {
    constexpr std::size_t kListed = 3;
    const std::vector<std::string> first(
        several.begin(), several.begin() + static_cast<std::ptrdiff_t>(std::min(several.size(), kListed)));
    remark(fmt::format("several markers are called {}{}: the first of each name is used", Join(first),
                       several.size() > kListed ? ", …" : ""));
  }
}

}  // namespace etude
