#include "engine/retargeting/exchanged_people.h"

#include <cstddef>
#include <set>
#include <vector>

#include "engine/retargeting/exchanged_sides.h"

namespace etude {

std::string DescribeExchangedMarkers(const MarkerMotion& markers, const MarkerColumns& one,
                                     const MarkerColumns& other) {
  constexpr std::size_t kListed = 4;
  const auto track_of = [&](std::size_t column) {
    std::vector<MarkerPosition> track;
    for (const auto& frame : markers.frames) track.push_back(frame[column]);
    return track;
  };
  std::vector<std::string> pairs;
  std::set<std::size_t> times;
  for (const auto& [key, column] : one) {
    const auto same = other.find(key);
    if (same == other.end()) continue;
    const auto frames = FindExchangesOf(track_of(column), track_of(same->second), markers.rate_hz);
    if (frames.empty()) continue;
    times.insert(frames.begin(), frames.end());
    pairs.push_back(markers.names[column] + " – " + markers.names[same->second]);
  }
  if (times.empty()) return "";
  if (pairs.size() > kListed) {
    pairs.resize(kListed);
    pairs.emplace_back("…");
  }
  return DescribeExchanges("markers of two people", times, markers.rate_hz, pairs);
}

}  // namespace etude
