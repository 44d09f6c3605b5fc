#include "engine/keypoints/people.h"

#include <algorithm>
#include <limits>

namespace etude {

double HeightPx(const SeenPerson& person) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Keypoint& keypoint : person.keypoints) {
    if (keypoint.confidence <= 0) continue;
    low = std::min(low, keypoint.pixel.y);
    high = std::max(high, keypoint.pixel.y);
  }
  return std::max(0.0, high - low);
}

}  // namespace etude
