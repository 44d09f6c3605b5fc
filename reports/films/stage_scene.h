#pragma once

#include <map>
#include <optional>
#include <utility>

#include "reports/films/capture_panel.h"
#include "reports/films/coach_panel.h"
#include "reports/films/film.h"

namespace etude {

/// The run's film: the coach changes moves; beside it a performer, as two cameras saw and recovered the body. Of which
/// there is one alone, it has the frame.
class StageScene : public Scene {
 public:
  /// The longest coach's motion that is shown, frames.
  static constexpr int kLongest = 7 * kFilmRate;

  /// At least one of the two is there.
  StageScene(Renderer& renderer, std::optional<CoachPanel> coach, std::optional<CapturePanel> capture);

  int Frames() const override;
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  const ColourImage& ViewPicture(std::size_t camera, int frame, const Box& box);

  Renderer& renderer_;
  std::optional<CoachPanel> coach_;
  std::optional<CapturePanel> capture_;
  std::map<std::pair<std::size_t, int>, ColourImage> views_;
};

}  // namespace etude
