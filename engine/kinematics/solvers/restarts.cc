#include "engine/kinematics/solvers/restarts.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

constexpr double kScatter = 1.5;                     // radians
constexpr double kGoldenShare = 0.6180339887498949;  // its multiples, modulo 1, are spread evenly
constexpr double kSpread = 300;                      // a fifth of a degree changes x by a whole period

}  // namespace

void ScatterAround(std::span<const double> start, std::span<const AngleRange> ranges, int number,
                   std::vector<double>& angles) {
  angles.resize(start.size());
  for (std::size_t d = 0; d < start.size(); ++d) {
    double x = kGoldenShare * number * (static_cast<double>(d) + 1) + kSpread * start[d];
    x -= std::floor(x);
    angles[d] = std::clamp(start[d] + kScatter * (2 * x - 1), ranges[d].lower, ranges[d].upper);
  }
}

}  // namespace etude
