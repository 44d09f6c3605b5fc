#include "engine/motion/equal_motions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "engine/base/nearest_rotation.h"
#include "engine/motion/raw_motion.h"

namespace etude {
namespace {

constexpr double kSame_m = 0.001;  // tolerance; files may round to a tenth of a millimetre
constexpr int kMinSeen = 3;        // fewer points do not determine a rotation

using Points = std::span<const glm::dvec3>;

/// The number of points that are seen, and their mean.
struct Middle {
  int seen = 0;
  glm::dvec3 mean = glm::dvec3(0);
};

Middle MiddleOf(Points points) {
  Middle middle;
  for (const glm::dvec3& point : points) {
    if (!IsSeen(point)) continue;
    ++middle.seen;
    middle.mean += point;
  }
  if (middle.seen > 0) middle.mean /= middle.seen;
  return middle;
}

/// Returns the root mean square distance of the points from their mean, metres; it is the same for equal motions.
double RadiusOf(Points points) {
  const Middle middle = MiddleOf(points);
  double sum = 0;
  for (const glm::dvec3& point : points) {
    const glm::dvec3 arm = point - middle.mean;
    if (IsSeen(point)) sum += glm::dot(arm, arm);
  }
  return middle.seen > 0 ? std::sqrt(sum / middle.seen) : 0;
}

bool AreCongruent(Points a, Points b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (IsSeen(a[i]) != IsSeen(b[i])) return false;
  }
  const Middle of_a = MiddleOf(a), of_b = MiddleOf(b);
  if (of_a.seen < kMinSeen) return false;
  glm::dmat3 covariance(0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (IsSeen(a[i])) covariance += glm::outerProduct(b[i] - of_b.mean, a[i] - of_a.mean);
  }
  const glm::dmat3 turn = NearestRotationTo(covariance).rotation;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (glm::distance(turn * (a[i] - of_a.mean), b[i] - of_b.mean) > kSame_m) return false;
  }
  return true;
}

}  // namespace

Places PlacesOf(const BodyMotion& motion) {
  return {motion.poses.size(), kRoleCount,
          [&motion](std::size_t frame, std::size_t joint) { return motion.poses[frame].joints[joint]; }};
}

std::vector<glm::dvec3> SketchOf(const Places& places, std::size_t max_frames, std::size_t max_joints) {
  const std::size_t frames = std::min(max_frames, places.frames), joints = std::min(max_joints, places.joints);
  std::vector<glm::dvec3> points;
  points.reserve(frames * joints);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      const std::size_t frame = frames == 1 ? 0 : f * (places.frames - 1) / (frames - 1);
      points.push_back(places.at(frame, j * places.joints / joints));
    }
  }
  return points;
}

bool AreEqual(const Places& a, const Places& b) {
  return a.frames == b.frames && a.joints == b.joints && AreCongruent(SketchOf(a), SketchOf(b)) &&
         AreCongruent(SketchOf(a, a.frames, a.joints), SketchOf(b, b.frames, b.joints));
}

std::vector<std::optional<std::size_t>> FindEqual(std::size_t count,
                                                  const std::function<std::vector<glm::dvec3>(std::size_t)>& sketch_of,
                                                  const std::function<bool(std::size_t, std::size_t)>& are_equal) {
  std::vector<std::optional<std::size_t>> equals(count);
  std::multimap<double, std::pair<std::size_t, std::vector<glm::dvec3>>> known;  // by radius
  for (std::size_t m = 0; m < count && count > 1; ++m) {
    std::vector<glm::dvec3> sketch = sketch_of(m);
    const double radius = RadiusOf(sketch);
    const auto end = known.upper_bound(radius + kSame_m);
    const auto same = std::find_if(known.lower_bound(radius - kSame_m), end, [&](const auto& other) {
      return AreCongruent(other.second.second, sketch) && are_equal(other.second.first, m);
    });
    if (same != end) {
      equals[m] = same->second.first;
    } else if (!sketch.empty()) {
      known.emplace(radius, std::pair(m, std::move(sketch)));
    }
  }
  return equals;
}

std::vector<std::optional<std::size_t>> FindEqual(const std::vector<Places>& motions) {
  return FindEqual(
      motions.size(), [&](std::size_t m) { return SketchOf(motions[m]); },
      [&](std::size_t a, std::size_t b) { return AreEqual(motions[a], motions[b]); });
}

}  // namespace etude
