#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/motion/character.h"
#include "io/drawing/canvas.h"
#include "io/drawing/film.h"
#include "io/drawing/studio.h"
#include "reports/films/transition_plots.h"
#include "reports/films/transition_race.h"

namespace etude {

/// Renders the bodies of all methods of a race with one fixed camera. At the request, every body faces the camera.
class TransitionStage {
 public:
  /// Prepares pictures of this size that show the times `first` … `last`, in frames after the request.
  TransitionStage(const TransitionRace& race, int first, int last, int width, int height);

  /// Renders frame `frame` of a path. If `ghost` is given, adds frame `ghost` of the same path as a translucent ghost.
  Image<std::uint32_t> Picture(Renderer& renderer, const TransitionPath& path, std::size_t index, int frame,
                               std::optional<int> ghost) const;

 private:
  ViewBounds BoundsOf(const TransitionRace& race, int first, int last) const;

  int width_, height_;
  Character bear_;
  /// The rigid motion on the floor that places a body; index: path, then frame.
  std::vector<std::vector<FloorMove>> placements_;
  mutable Studio studio_;  ///< mutable, because a studio caches its last picture
};

/// One method's column of the film that compares transitions: the person, the plot of jumps, and the partial distances
/// at the transition points.
class TransitionPanel {
 public:
  static constexpr double kCaptionHeight = 52, kStripHeight = 132, kGap = 8;

  /// All references must outlive the panel. `index` is the index of `path` in the race from which `stage` was made.
  TransitionPanel(const TransitionPath& path, std::size_t index, const TransitionStage& stage, const JumpStrip& strip)
      : path_(path), index_(index), stage_(stage), strip_(strip) {}

  /// Returns the rectangle of a column that shows the person; the caption is below this rectangle.
  static Box BodyBox(const Box& column);
  void Draw(Canvas& canvas, const Box& column, Renderer& renderer, int time);

 private:
  struct Drawn {
    int frame;
    std::optional<int> ghost;
    Image<std::uint32_t> picture;
  };
  void DrawBody(Canvas& canvas, const Box& box, Renderer& renderer, int time);
  void DrawWords(Canvas& canvas, const Box& box, int time) const;
  std::string ClipAt(int time) const;

  const TransitionPath& path_;
  std::size_t index_;
  const TransitionStage& stage_;
  const JumpStrip& strip_;
  std::optional<Drawn> drawn_;  ///< the last picture, cached because slow motion shows each picture several times
};

/// The film of one request under one to four methods side by side. It shows when each method changes clips, how smooth
/// the transition is, and the partial distances at the transition points.
class TransitionScene : public Scene {
 public:
  /// Makes the film of a race. The renderer must outlive the scene.
  TransitionScene(TransitionRace race, std::string scenario, Renderer& renderer);
  TransitionScene(const TransitionScene&) = delete;
  TransitionScene& operator=(const TransitionScene&) = delete;

  int Frames() const override { return clock_.Frames(); }
  /// Returns a frame just after all methods have made their transitions.
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
