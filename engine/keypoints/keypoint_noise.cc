#include "engine/keypoints/keypoint_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/order_statistics.h"

namespace etude {

double KeypointVarianceOf(const RobustPoint& point) {
  const auto views = static_cast<double>(std::ranges::count(point.agrees, true));
  const double freedom = 2 * views - 3, root = 1 - 2 / (9 * freedom);
  return views * point.residual_px * point.residual_px / (freedom * root * root * root);
}

double KeypointNoise::Of(Role role) const {
  const auto landmark = LandmarkAt(role);
  return landmark ? px[Index(*landmark)].value_or(all_px) : all_px;
}

std::optional<KeypointNoise> MeasureKeypointNoise(std::span<const ProjectionMatrix> cameras,
                                                  const MatchedPerson& person, double min_confidence,
                                                  double outlier_px) {
  KeypointNoise noise;
  std::vector<double> all;
  constexpr std::size_t kMinPoints = 30;
  const std::size_t frames = person.seen.empty() ? 0 : person.seen.front().size();
  for (std::size_t landmark = 0; landmark < kLandmarkCount; ++landmark) {
    std::vector<double> variances;
    for (std::size_t frame = 0; frame < frames; ++frame) {
      std::vector<WeightedSighting> sightings;
      for (std::size_t c = 0; c < cameras.size(); ++c) {
        const auto& seen = person.seen[c][frame];
        if (!seen || seen->keypoints[landmark].confidence < min_confidence) continue;
        sightings.push_back({{cameras[c], seen->keypoints[landmark].pixel}});
      }
      const auto point = TriangulateRobustly(sightings, {.outlier_px = outlier_px});
      if (point) variances.push_back(KeypointVarianceOf(*point));
    }
    all.insert(all.end(), variances.begin(), variances.end());
    if (variances.size() >= kMinPoints) noise.px[landmark] = std::sqrt(Quantile(variances, 0.5));
  }
  if (all.empty()) return std::nullopt;
  noise.points = all.size();
  noise.all_px = std::sqrt(Quantile(all, 0.5));
  return noise;
}

}  // namespace etude
