#pragma once

#include <string>
#include <vector>

#include "reports/films/film.h"
#include "reports/films/transition_clock.h"
#include "reports/films/transition_panel.h"

namespace etude {

/// One request under two to four methods side by side: who changes when, how smoothly, and by which distances.
class SwitchScene : public Scene {
 public:
  /// The renderer must outlive the scene.
  SwitchScene(SwitchRace race, std::string scenario, Renderer& renderer);
  SwitchScene(const SwitchScene&) = delete;
  SwitchScene& operator=(const SwitchScene&) = delete;

  int Frames() const override { return clock_.Frames(); }
  /// Just after everyone has changed.
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  const SwitchRace race_;
  const std::string scenario_;
  Renderer& renderer_;
  const SwitchClock clock_;
  const SwitchStage stage_;
  const JumpStrip strip_;
  std::vector<SwitchPanel> panels_;
};

}  // namespace etude
