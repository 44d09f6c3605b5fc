#include "engine/silhouettes/thickness.h"

#include <algorithm>

namespace etude {
namespace {

constexpr double kSpreadOfPeople = 0.15;  // of people about the average, standard deviation
constexpr double kMostChange = 0.15;      // how much a part may change at a time

}  // namespace

ThicknessEstimate::ThicknessEstimate(const SilhouetteBody& body)
    : body_(body), agrees_(body.part_count, 0.0), counts_(body.part_count, 0.0) {}

void ThicknessEstimate::Add(std::span<const SilhouetteView> views, const TreeState& state,
                            const SilhouetteCostOptions& options, FitWorkspace& workspace) {
  ComputeFrames(body_.tree, state, workspace.frames);
  for (const SilhouetteView& view : views) {
    ProjectFlesh(body_, workspace.frames, view.matrix, workspace.flesh);
    workspace.residuals.clear();
    AppendResiduals(workspace.flesh, *view.silhouette, options, workspace.residuals);
    for (const SilhouetteResidual& residual : workspace.residuals) {
      if (residual.is_inside) continue;
      const ProjectedCapsule& capsule = workspace.flesh[residual.capsule];
      const double radius = -residual.slopes[2] * capsule.radius_a - residual.slopes[5] * capsule.radius_b;
      const double weight = LossOf(residual, options).weight;
      const int part = body_.flesh[residual.capsule].part;
      agrees_[part] += weight * radius * residual.value;
      counts_[part] += weight * radius * radius;
    }
  }
}

SilhouetteBody ThicknessEstimate::Apply() const {
  SilhouetteBody body = body_;
  for (FleshCapsule& capsule : body.flesh) {
    const double share = agrees_[capsule.part] / (counts_[capsule.part] + 1 / (kSpreadOfPeople * kSpreadOfPeople));
    const double scale = 1 + std::clamp(share, -kMostChange, kMostChange);
    capsule.radius_a *= scale;
    capsule.radius_b *= scale;
  }
  return body;
}

}  // namespace etude
