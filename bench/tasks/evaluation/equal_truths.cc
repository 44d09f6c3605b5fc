#include "bench/tasks/evaluation/equal_truths.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/metrics/alignment.h"
#include "io/clips/raw_motions.h"

namespace etude {
namespace {

constexpr double kSame_m = 0.001;  // tolerance; files may round to a tenth of a millimetre

/// Some or all positions of a motion, by which it is recognised.
struct Sketch {
  std::size_t world = 0, frames = 0, joints = 0;
  std::vector<glm::dvec3> points;
};

/// Returns the positions of up to `max_joints` joints in up to `max_frames` frames, evenly chosen.
Sketch SketchOf(const RawMotion& motion, std::size_t world, std::size_t max_frames = 12, std::size_t max_joints = 30) {
  Sketch sketch{world, motion.FrameCount(), motion.joints.size(), {}};
  const std::size_t frames = std::min(max_frames, sketch.frames), joints = std::min(max_joints, sketch.joints);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      const std::size_t frame = frames == 1 ? 0 : f * (sketch.frames - 1) / (frames - 1);
      sketch.points.push_back(motion.At(frame, j * sketch.joints / joints));
    }
  }
  return sketch;
}

/// Returns the root mean square distance of the points from their mean, metres; it is the same for equal motions.
double RadiusOf(const Sketch& sketch) {
  const PointMoments moments = MomentsOf(sketch.points, sketch.points);
  return moments.count > 0 ? std::sqrt(moments.scatter / moments.count) : 0;
}

bool AreEqual(const Sketch& a, const Sketch& b) {
  if (a.frames != b.frames || a.joints != b.joints) return false;
  const auto fit = Fit(MomentsOf(a.points, b.points), false);
  if (!fit) return false;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    if (IsSeen(a.points[i]) != IsSeen(b.points[i])) return false;
    if (glm::distance(fit->Apply(a.points[i]), b.points[i]) > kSame_m) return false;
  }
  return true;
}

/// Returns true if a truth equals that of a file in all frames and joints.
bool IsEqual(const RawMotion& truth, const std::string& other_file, const OpenOptions& opening) {
  const auto other = OpenRawMotion(other_file, opening);
  const auto all_of = [](const RawMotion& motion) {
    return SketchOf(motion, 0, motion.FrameCount(), motion.joints.size());
  };
  return other && AreEqual(all_of(*other), all_of(truth));
}

}  // namespace

void FindEqualTruths(std::vector<JudgedFiles>& worlds, const OpenOptions& opening) {
  std::multimap<double, Sketch> known;  // by radius
  for (std::size_t w = 0; w < worlds.size() && worlds.size() > 1; ++w) {
    const auto truth = OpenRawMotion(worlds[w].truth, opening);
    if (!truth) continue;
    Sketch sketch = SketchOf(*truth, w);
    const double radius = RadiusOf(sketch);
    const auto end = known.upper_bound(radius + kSame_m);
    // Compare the sketches first, because they are at hand.
    const auto same = std::find_if(known.lower_bound(radius - kSame_m), end, [&](const auto& other) {
      return AreEqual(other.second, sketch) && IsEqual(*truth, worlds[other.second.world].truth, opening);
    });
    if (same == end) {
      known.emplace(radius, std::move(sketch));
      continue;
    }
    const JudgedFiles& first = worlds[same->second.world];
    worlds[w].same_as = first.name;
    worlds[w].unit = first.unit;
  }
}

}  // namespace etude
