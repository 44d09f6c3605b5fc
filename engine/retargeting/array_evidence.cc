#include "engine/retargeting/array_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/order_statistics.h"
#include "engine/motion/raw_motion.h"
#include "engine/retargeting/data_set_names.h"

namespace etude {
namespace {

/// Returns true if the body stands on its hands: a wrist is near the lowest joint in most frames, and that joint stays
/// at nearly the same height. `length` is the body's length; `columns` are the columns of the wrists.
bool StandsOnHands(std::span<const glm::dvec3> positions, std::size_t joints, const std::array<std::size_t, 2>& columns,
                   double length) {
  constexpr double kStillFloor = 0.1, kNear = 0.3, kMost = 0.5;  // kMost: a share of frames; others: body lengths
  std::vector<double> lowest;
  double low = 0;
  for (std::size_t begin = 0; begin < positions.size(); begin += joints) {
    double bottom = 1e300;
    for (const glm::dvec3& place : positions.subspan(begin, joints)) {
      if (IsSeen(place)) bottom = std::min(bottom, place.y);
    }
    const double wrist = std::min(positions[begin + columns[0]].y, positions[begin + columns[1]].y);
    low += wrist - bottom < kNear * length ? 1 : 0;
    lowest.push_back(bottom);
  }
  const double spread = LowerPercentile(lowest, 0.95) - LowerPercentile(lowest, 0.05);
  return low > kMost * static_cast<double>(lowest.size()) && spread < kStillFloor * length;
}

}  // namespace

double SpreadOf(std::span<const glm::dvec3> positions, std::size_t joints) {
  constexpr double kTimesUsual = 4;
  std::vector<double> spreads;
  for (std::size_t begin = 0; begin < positions.size(); begin += joints) {
    // Compute the median point and the median distance from it.
    std::array<std::vector<double>, 3> coordinates;
    std::vector<double> distances;
    for (const glm::dvec3& place : positions.subspan(begin, joints)) {
      for (int axis = 0; axis < 3 && IsSeen(place); ++axis)
        coordinates[static_cast<std::size_t>(axis)].push_back(place[axis]);
    }
    if (coordinates[0].empty()) continue;
    const glm::dvec3 middle(Median(coordinates[0]), Median(coordinates[1]), Median(coordinates[2]));
    for (const glm::dvec3& place : positions.subspan(begin, joints)) {
      if (IsSeen(place)) distances.push_back(glm::distance(place, middle));
    }
    double limit = kTimesUsual * Median(distances);
    // If more than a quarter of the points are beyond this limit, they belong to the body, so keep them. (Most points
    // of some layouts are on the hands, which may be held together.)
    const auto far = std::ranges::count_if(distances, [&](double distance) { return distance > limit; });
    if (4 * static_cast<std::size_t>(far) > distances.size()) limit = std::numeric_limits<double>::infinity();
    // Measure the extent of the points that are not too far from the median point.
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& place : positions.subspan(begin, joints)) {
      if (!IsSeen(place) || glm::distance(place, middle) > limit) continue;
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    if (low.x <= high.x) spreads.push_back(std::max({high.x - low.x, high.y - low.y, high.z - low.z}));
  }
  return spreads.empty() ? 0 : UpperMedian(std::move(spreads));
}

std::optional<double> UnitOfSpread(double spread) {
  for (const double unit : {1.0, 0.01, 0.001}) {
    if (spread * unit >= 0.8 && spread * unit <= 2.3) return unit;
  }
  return std::nullopt;
}

Standing FindStanding(std::span<const glm::dvec3> positions, const std::vector<std::string>& names) {
  const auto column_of = [&](Role role) {
    return static_cast<std::size_t>(std::ranges::find(names, RoleName(role), PlainJointName) - names.begin());
  };
  const std::array<std::size_t, 4> columns = {column_of(Role::kLeftShoulder), column_of(Role::kRightShoulder),
                                              column_of(Role::kLeftKnee), column_of(Role::kRightKnee)};
  if (std::ranges::count(columns, names.size()) > 0) return Standing::kUnknown;
  const std::array<std::size_t, 4> seat = {column_of(Role::kLeftHip), column_of(Role::kRightHip),
                                           column_of(Role::kLeftAnkle), column_of(Role::kRightAnkle)};
  const bool has_seat = std::ranges::count(seat, names.size()) == 0;
  constexpr double kUpright = 0.8;  // cosine of the angle between the body and the axis
  int seen = 0, upside_down = 0, along_z = 0;
  std::vector<double> lengths;
  for (std::size_t begin = 0; begin < positions.size(); begin += names.size()) {
    const auto place = [&](std::size_t i) { return positions[begin + columns[i]]; };
    const glm::dvec3 body = place(0) + place(1) - place(2) - place(3);
    const double length = glm::length(body);
    seen += std::isnan(length) ? 0 : 1;
    if (!std::isnan(length)) lengths.push_back(0.5 * length);
    // The thighs of a person who sits are horizontal, so trunk and shanks also show the direction.
    const auto joint = [&](std::size_t i) { return positions[begin + seat[i]]; };
    const glm::dvec3 seated =
        has_seat ? place(0) + place(1) - joint(0) - joint(1) + place(2) + place(3) - joint(2) - joint(3) : body;
    upside_down += body.y < -kUpright * length || seated.y < -kUpright * glm::length(seated) ? 1 : 0;
    along_z += std::abs(body.z) > kUpright * length ? 1 : 0;
  }
  if (upside_down > 0 && 4 * upside_down >= 3 * seen) {
    const std::array<std::size_t, 2> wrists = {column_of(Role::kLeftWrist), column_of(Role::kRightWrist)};
    const bool has_wrists = std::max(wrists[0], wrists[1]) < names.size();
    return has_wrists && StandsOnHands(positions, names.size(), wrists, Median(lengths)) ? Standing::kOnHands
                                                                                         : Standing::kAlongMinusY;
  }
  return along_z > 0 && 4 * along_z >= 3 * seen ? Standing::kAlongZ : Standing::kUnknown;
}

void ScaleToPerson(MarkerMotion& markers) {
  std::vector<glm::dvec3> places;
  for (const auto& frame : markers.frames) {
    for (const auto& place : frame) places.push_back(place.value_or(NotSeen()));
  }
  const auto unit = UnitOfSpread(SpreadOf(places, markers.names.size()));
  if (!unit) return;
  markers.metres_per_unit = *unit;
  for (auto& frame : markers.frames) {
    for (auto& place : frame) {
      if (place) *place *= *unit;
    }
  }
  const std::string said = fmt::format("1 unit = {:g} cm, by the size of the body", 100 * *unit);
  markers.remark += markers.remark.empty() ? said : "; " + said;
}

}  // namespace etude
