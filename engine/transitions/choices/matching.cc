#include "engine/transitions/choices/matching.h"

#include <cmath>

#include "engine/transitions/choices/fuzzy_window_rows.h"
#include "engine/transitions/choices/point_cloud_rows.h"
#include "engine/transitions/choices/ranked.h"

namespace etude {
namespace {

class MotionFeatureRows : public PairRows {
 public:
  MotionFeatureRows(std::span<const MotionFeatures> playing, std::span<const MotionFeatures> next)
      : playing_(playing), next_(next) {}

  void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) override {
    const MotionFeatures& leaving = playing_[leave_frame];
    for (std::size_t i = 0; i < enter_frames.size(); ++i) {
      const MotionFeatures& entering = next_[enter_frames[i]];
      double squares = 0;
      for (std::size_t k = 0; k < kMotionFeatureCount; ++k) {
        const double gap = leaving[k] - entering[k];
        squares += gap * gap;
      }
      costs[i] = std::sqrt(squares);
    }
  }

 private:
  std::span<const MotionFeatures> playing_, next_;
};

SwitchRecord PlanByPointCloud(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules,
                              bool gated) {
  PointCloudRows costs(library.motions[request.from], library.motions[request.to], request.request_frame,
                       rules.window_s);
  return PlanRanked(library, request, rules, {.name = "point-cloud distance", .unit = "cm", .gated = gated}, costs);
}

}  // namespace

SwitchRecord PlanFuzzyKovar(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  return PlanByPointCloud(library, request, rules, true);
}

SwitchRecord PlanPointCloud(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  return PlanByPointCloud(library, request, rules, false);
}

SwitchRecord PlanMotionMatching(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  MotionFeatureRows costs(library.features[request.from], library.features[request.to]);
  return PlanRanked(library, request, rules, {.name = "distance of positions and velocities", .unit = "SD"}, costs);
}

SwitchRecord PlanFuzzyWindow(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const int reach = static_cast<int>(std::lround(rules.reach_s * playing.rate_hz));
  FuzzyWindowRows costs(playing.grades, next.grades, request.request_frame, reach, rules.weights);
  return PlanRanked(library, request, rules, {.name = "mean fuzzy distance", .unit = "d", .gated = true}, costs);
}

}  // namespace etude
