#include "reports/plots/swarm.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace etude {
namespace {

constexpr double kMarkSize = 5;

}  // namespace

std::vector<double> SwarmOffsets(const std::vector<double>& places, double most) {
  std::map<long, std::vector<std::size_t>> bins;
  for (std::size_t i = 0; i < places.size(); ++i) bins[std::lround(places[i] / kMarkSize)].push_back(i);
  std::vector<double> offsets(places.size(), 0);
  for (const auto& [bin, members] : bins) {
    // One in the middle, then alternately to either side; closer together where there are many.
    const double sides = std::max<double>(1, static_cast<double>(members.size() / 2));
    const double step = std::min(kMarkSize, most / sides);
    for (std::size_t k = 0; k < members.size(); ++k) {
      const double rank = static_cast<double>((k + 1) / 2);
      offsets[members[k]] = (k % 2 == 0 ? -1 : 1) * rank * step;
    }
  }
  return offsets;
}

std::size_t StrideFor(std::size_t count, std::size_t most) { return std::max<std::size_t>(1, (count + most - 1) / most); }

}  // namespace etude
