#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/drawing/canvas.h"
#include "io/drawing/film.h"
#include "io/drawing/studio.h"
#include "reports/films/ik_race.h"

namespace etude {

/// A clock that says which iteration is seen at which frame of a film, the same for every method. Time is a logarithm,
/// each frame multiplies iteration + 1 by the same factor: the first steps, which change most, are seen one by one, the
/// last ones pass quickly. Start and end are held for a while.
class RaceClock {
 public:
  /// Makes a clock for films of methods of which the longest takes `last_iteration` ≥ 0 steps: 6 to 10 seconds.
  explicit RaceClock(int last_iteration);

  int LastIteration() const { return last_; }
  int Frames() const { return kOpening + run_ + kEnding; }
  /// Gives the iteration at a frame, 0 … the last one, never falling; the fraction is the time within an iteration.
  double IterationAt(int frame) const;
  /// Gives the place of an iteration, 0…1, on an axis that the clock crosses at constant speed.
  double ShareOf(double iteration) const;

 private:
  static constexpr int kOpening = kFilmRate / 2, kEnding = 3 * kFilmRate / 2;

  int last_;
  int run_;  ///< frames between opening and ending
};

/// One method's error: `values` at `iterations`.
struct ErrorCurve {
  std::vector<int> iterations;
  std::vector<double> values;
  Paint colour;
};

/// A plot of errors along iterations, both axes logarithmic, that draws itself as time goes.
class ErrorPlot {
 public:
  /// Plots errors with `suffix` behind a value, " cm", and `goal` > 0 as a line. Every curve has a value; without
  /// curves there is nothing but the title.
  ErrorPlot(std::string title, std::string suffix, double goal, std::vector<ErrorCurve> curves, const RaceClock& clock);

  /// Draws the curves as far as they are known at `iteration`.
  void Draw(Canvas& canvas, const Box& panel, double iteration) const;

 private:
  struct Frame;
  void DrawValueAxis(Canvas& canvas, const Frame& frame) const;
  void DrawIterationAxis(Canvas& canvas, const Frame& frame) const;
  void DrawCurve(Canvas& canvas, const Frame& frame, const ErrorCurve& curve, double iteration, double width) const;

  std::string title_, suffix_;
  double goal_;
  std::vector<ErrorCurve> curves_;
  RaceClock clock_;
  int lowest_ = 0, highest_ = 0;  ///< decades at the lower and upper edge
};

/// The place where both methods of a race are seen: one camera that holds every pose of either, the true pose as a
/// ghost. Words have room on the left.
class ConvergenceStage {
 public:
  /// Sets the stage for pictures of this size.
  ConvergenceStage(const IkRace& race, Renderer& renderer, int width, int height);

  /// Draws a body of that colour over the ghost. Rings mark its end effectors' targets, dots where the effectors are.
  Image<std::uint32_t> Picture(Renderer& renderer, const BodyPose& pose, const Paint& colour) const;

 private:
  glm::dvec3 Placed(const glm::dvec3& point) const;
  BodyPose Placed(const BodyPose& pose) const;
  ViewBounds BoundsOf(const IkRace& race) const;

  Box box_;
  FloorMove move_;
  double lift_;  ///< metres, so that nobody is below the floor
  BodyPose truth_;
  IkTargets targets_;
  mutable Studio studio_;  ///< keeps its last picture
  Mask ghost_, rim_;
};

/// One half of the convergence film: a method's state at a moment, as a picture and in numbers.
class ConvergencePanel {
 public:
  /// Both must outlive the panel.
  ConvergencePanel(const IkPath& path, const ConvergenceStage& stage, const Paint& colour);

  /// Draws the state at `iteration`; `panel` has the size of the stage's pictures.
  void Draw(Canvas& canvas, const Box& panel, Renderer& renderer, double iteration);

 private:
  struct Drawn {
    std::size_t entry;
    Image<std::uint32_t> picture;
  };

  const IkPath& path_;
  const ConvergenceStage& stage_;
  Paint colour_;
  std::vector<std::size_t> seen_;  ///< by entry: the latest one that looks different from the one before it
  std::optional<Drawn> drawn_;     ///< time only goes forward: the latest picture is the one that is needed again
};

/// Paper B's figures 5.1 and 5.2 in motion: a body settling under two methods side by side, and their errors drawing
/// themselves beneath.
class ConvergenceScene : public Scene {
 public:
  /// The renderer must outlive the scene.
  ConvergenceScene(IkRace race, std::string scenario, Renderer& renderer);
  ConvergenceScene(const ConvergenceScene&) = delete;
  ConvergenceScene& operator=(const ConvergenceScene&) = delete;

  int Frames() const override { return clock_.Frames(); }
  /// Gives the last frame: both curves whole, both methods at their end.
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
