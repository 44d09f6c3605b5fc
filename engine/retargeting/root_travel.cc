#include "engine/retargeting/root_travel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/motion/statistics.h"
#include "engine/retargeting/body_sampler.h"

namespace etude {
namespace {

/// Returns the joint that moves the body: the first joint with changing positions on the path from the hips to the
/// root; −1 if no position changes.
int MovedJoint(const Clip& clip, const JointMap& map) {
  for (int joint = map[Role::kHipCentre].joint; joint >= 0; joint = clip.skeleton.joints[joint].parent) {
    const glm::dvec3 first = clip.frames.front()[joint].translation;
    const auto moves = [&](const LocalPose& frame) { return frame[joint].translation != first; };
    if (std::ranges::any_of(clip.frames, moves)) return joint;
  }
  return -1;
}

}  // namespace

std::string DescribeRootTravel(const Clip& clip, const JointMap& map) {
  constexpr double kStep_s = 1.0 / 30;
  constexpr std::size_t kMaxSteps = 300, kMinSteps = 10;
  const int moved = clip.frames.empty() ? -1 : MovedJoint(clip, map);
  const auto apart = static_cast<std::size_t>(std::max(1.0, std::round(kStep_s * clip.rate_hz)));
  if (moved < 0 || clip.frames.size() < apart + kMinSteps) return "";
  // The displacements of both ankles and of the moved joint, each from a sampled frame to the frame a thirtieth of a
  // second later.
  struct Step {
    glm::dvec3 left, right, root;
  };
  std::vector<Step> steps;
  std::vector<double> statures;
  std::vector<GlobalTransform> globals;
  BodySampler sampler(clip, map);
  const auto place_at = [&](std::size_t frame) {
    ComputeGlobals(clip.skeleton, clip.frames[frame], globals);
    return globals[static_cast<std::size_t>(moved)].position;
  };
  const std::size_t stride = 1 + clip.frames.size() / kMaxSteps;
  for (std::size_t f = 0; f + apart < clip.frames.size(); f += stride) {
    const BodyPose pose = sampler.At(static_cast<double>(f)), later = sampler.At(static_cast<double>(f + apart));
    statures.push_back(Stature(pose));
    steps.push_back({later[Role::kLeftAnkle] - pose[Role::kLeftAnkle],
                     later[Role::kRightAnkle] - pose[Role::kRightAnkle], place_at(f + apart) - place_at(f)});
  }
  // Returns the median speed of the slower ankle, in statures per second, if the root's steps are multiplied by
  // `factor`.
  const double stature = Median(std::move(statures));
  const auto slide = [&](double factor) {
    std::vector<double> slides;
    for (const Step& step : steps) {
      const glm::dvec3 more = (factor - 1) * step.root;
      slides.push_back(std::min(glm::length(step.left + more), glm::length(step.right + more)));
    }
    return Median(std::move(slides)) * clip.rate_hz / static_cast<double>(apart) / stature;
  };
  constexpr double kMinSlide = 0.15, kMuchLess = 0.35;
  const double as_it_is = slide(1);
  if (!(as_it_is > kMinSlide)) return "";
  double best = 1, least = as_it_is;
  for (const double factor : {1000.0, 100.0, 10.0, 39.37, 30.48, 2.54, 3.281, 17.72, 5.644}) {
    for (const double one : {factor, 1 / factor}) {
      if (const double slides = slide(one); slides < least) {
        best = one;
        least = slides;
      }
    }
  }
  if (!(least < kMuchLess * as_it_is)) return "";
  // A factor below 1 slows down all feet, even feet that slide for another reason, so it is reported only if the speed
  // in the file is impossible.
  constexpr double kAsWell = 1.5, kImpossible = 3;  // a ratio of two speeds; a speed in statures per second
  if (best < 1 && as_it_is < kImpossible) return "";
  if (slide(0) > kAsWell * least) {
    return fmt::format(
        "the feet slide, but would stand still if the root's positions were multiplied by {:.4g}; do root and limbs "
        "have different units?",
        best);
  }
  return "no foot ever stands still; do the root's positions have a smaller unit than the limbs?";
}

}  // namespace etude
