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

/// Returns true if all coordinates are 0: some programs write this for a gap.
bool IsZero(const MarkerPosition& place) { return place && *place == glm::dvec3(0); }

/// Removes positions at 0, 0, 0 if the marker is elsewhere in other frames. (The root of a root-relative pose stays,
/// because it is always at 0.) Returns the number of removed positions.
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

/// Removes positions that are a hundred times farther from the middle of their frame than usual; some programs write
/// numbers such as -9999 for a gap. Returns the number of removed positions.
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

/// Returns the names that several markers share. Only the first marker of a name is used.
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
