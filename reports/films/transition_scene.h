#pragma once

#include <string>
#include <vector>

#include "reports/films/film.h"
#include "reports/films/transition_panel.h"
#include "reports/films/transition_race.h"

namespace etude {

/// The film of one request under two to four methods side by side: when each changes, how smoothly, and by which
/// distances.
class TransitionScene : public Scene {
 public:
  /// The renderer must outlive the scene.
  TransitionScene(TransitionRace race, std::string scenario, Renderer& renderer);
  TransitionScene(const TransitionScene&) = delete;
  TransitionScene& operator=(const TransitionScene&) = delete;

  int Frames() const override { return clock_.Frames(); }
  /// Gives a frame just after everyone has changed.
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  const TransitionRace race_;
  const std::string scenario_;
  Renderer& renderer_;
  const TransitionClock clock_;
  const TransitionStage stage_;
  const JumpStrip strip_;
  std::vector<TransitionPanel> panels_;
};

}  // namespace etude
