#pragma once

#include <array>

#include "reports/films/convergence_panel.h"
#include "reports/films/error_plot.h"
#include "reports/films/film.h"
#include "reports/films/ik_race.h"

namespace etude {

/// Paper B's figures 5.1 and 5.2 in motion: a body settling under two methods side by side, and their errors drawing
/// themselves beneath.
class ConvergenceScene : public Scene {
 public:
  /// The renderer must outlive the scene.
  ConvergenceScene(IkRace race, std::string scenario, Renderer& renderer);
  ConvergenceScene(const ConvergenceScene&) = delete;
  ConvergenceScene& operator=(const ConvergenceScene&) = delete;

  int Frames() const override { return clock_.Frames(); }
  /// The last: both curves whole, both methods at their end.
  int PosterFrame() const override { return Frames() - 1; }
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  bool HasTargets() const;

  const IkRace race_;
  const std::string scenario_;
  Renderer& renderer_;
  const RaceClock clock_;
  const ConvergenceStage stage_;
  std::array<ConvergencePanel, 2> panels_;
  const ErrorPlot position_, orientation_;
};

}  // namespace etude
