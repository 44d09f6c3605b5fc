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

TransitionRecord PlanByPointCloud(const MotionLibrary& library, const TransitionRequest& request,
                                  const MatchRules& rules, const PointCloudOptions& options, bool gated) {
  PointCloudRows costs(library.motions[request.from], library.motions[request.to], request.request_frame,
                       options.window_s);
  const Ranking ranking{.allowed = AllowedAnyFrames(library, request, options.least_play_s),
                        .name = "point-cloud distance",
                        .unit = "cm",
                        .gated = gated};
  return PlanRanked(library, request, rules, ranking, costs);
}

/// The setting that all of these choices have.
template <typename Options>
typename SettingTable<Options>::Row LeastPlay() {
  return {"least_play_s", &Options::least_play_s, 0, 60,
          "Seconds of the wanted clip that must be left to play; its front half may always be entered."};
}

}  // namespace

const SettingTable<PointCloudOptions>& PointCloudSettings() {
  static const SettingTable<PointCloudOptions> kSettings({LeastPlay<PointCloudOptions>()});
  return kSettings;
}

TransitionRecord PlanFuzzyKovar(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options) {
  return PlanByPointCloud(library, request, rules, options, true);
}

TransitionRecord PlanPointCloud(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options) {
  return PlanByPointCloud(library, request, rules, options, false);
}

const SettingTable<MotionMatchingOptions>& MotionMatchingSettings() {
  static const SettingTable<MotionMatchingOptions> kSettings({LeastPlay<MotionMatchingOptions>()});
  return kSettings;
}

TransitionRecord PlanMotionMatching(const MotionLibrary& library, const TransitionRequest& request,
                                    const MatchRules& rules, const MotionMatchingOptions& options) {
  MotionFeatureRows costs(library.features[request.from], library.features[request.to]);
  const Ranking ranking{.allowed = AllowedAnyFrames(library, request, options.least_play_s),
                        .name = "distance of positions and velocities",
                        .unit = "SD"};
  return PlanRanked(library, request, rules, ranking, costs);
}

const SettingTable<FuzzyWindowOptions>& FuzzyWindowSettings() {
  static const SettingTable<FuzzyWindowOptions> kSettings({LeastPlay<FuzzyWindowOptions>()});
  return kSettings;
}

TransitionRecord PlanFuzzyWindow(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules, const FuzzyWindowOptions& options) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const int reach = static_cast<int>(std::lround(options.reach_s * playing.rate_hz));
  FuzzyWindowRows costs(playing.grades, next.grades, request.request_frame, reach, rules.weights);
  const Ranking ranking{.allowed = AllowedAnyFrames(library, request, options.least_play_s),
                        .name = "mean fuzzy distance",
                        .unit = "d",
                        .gated = true};
  return PlanRanked(library, request, rules, ranking, costs);
}

}  // namespace etude
