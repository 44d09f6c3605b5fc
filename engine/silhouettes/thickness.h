#pragma once

#include <span>
#include <vector>

#include "engine/silhouettes/fit_silhouettes.h"

namespace etude {

/// How thick a person's parts are beside the average's, by least squares over outline points of many frames: a limb
/// that is seen on both sides is too thin by what its outline lies outside on either. Parts that are seldom seen free
/// stay as they are.
class ThicknessEstimate {
 public:
  explicit ThicknessEstimate(const SilhouetteBody& body);

  /// Adds what one frame shows in the pose `state`.
  void Add(std::span<const SilhouetteView> views, const TreeState& state, const SilhouetteCostOptions& options,
           FitWorkspace& workspace);

  /// The body with its parts so thick.
  SilhouetteBody Apply() const;

 private:
  const SilhouetteBody& body_;
  std::vector<double> agrees_, counts_;  // of each part: Σ w r e, Σ w r²
};

}  // namespace etude
