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

/// Maps frames of a film to iterations, the same for every method. The scale is logarithmic: each frame multiplies
/// iteration + 1 by the same factor, so that the first iterations, in which most changes happen, are shown one by one,
/// and the last iterations pass quickly. The film rests on the first and on the last state for a while.
class RaceClock {
 public:
  /// Makes a clock for a film of 6 to 10 seconds. `last_iteration` ≥ 0 is the number of iterations of the slowest
  /// method in the film.
  explicit RaceClock(int last_iteration);

  int LastIteration() const { return last_; }
  int Frames() const { return kOpening + run_ + kEnding; }
  /// Returns the iteration at a frame, 0 … the last iteration; it never decreases. The fractional part of the result
  /// is the progress within an iteration.
  double IterationAt(int frame) const;
  /// Returns the position of an iteration, 0…1, on an axis along which the film advances at constant speed.
  double ShareOf(double iteration) const;

 private:
  static constexpr int kOpening = kFilmRate / 2, kEnding = 3 * kFilmRate / 2;

  int last_;
  int run_;  ///< number of frames between the first and the last state; these two states are held
};

/// The error of one method over iterations: `values[i]` is the error at `iterations[i]`.
struct ErrorCurve {
  std::vector<int> iterations;
  std::vector<double> values;
  Paint colour;
};

/// A plot of errors over iterations, both axes logarithmic, that is drawn up to the current iteration.
class ErrorPlot {
 public:
  /// Plots errors. `suffix` is the unit that follows a value (" cm"); a `goal` above 0 is drawn as a line. Every curve
  /// must have a value; without curves, only the title is drawn.
  ErrorPlot(std::string title, std::string suffix, double goal, std::vector<ErrorCurve> curves, const RaceClock& clock);

  /// Draws, in `panel`, the curves up to `iteration`.
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
  int lowest_ = 0, highest_ = 0;  ///< exponents of ten at the lower and the upper end of the error axis
};

/// Renders the bodies of the two methods in the film. One camera, which sees every pose of both methods, renders all
/// pictures. The true pose appears as a ghost, and the left part of each picture is free for text.
class ConvergenceStage {
 public:
  /// Prepares pictures of `width` × `height` pixels.
  ConvergenceStage(const IkRace& race, Renderer& renderer, int width, int height);

  /// Draws a body in `colour` over the ghost of the true pose. Rings mark the targets of the body's end effectors, and
  /// dots mark the end effectors.
  Image<std::uint32_t> Picture(Renderer& renderer, const BodyPose& pose, const Paint& colour) const;

 private:
  glm::dvec3 Placed(const glm::dvec3& point) const;
  BodyPose Placed(const BodyPose& pose) const;
  ViewBounds BoundsOf(const IkRace& race) const;

  Box box_;
  FloorMove move_;
  double lift_;  ///< height by which the figures are raised so that no body is below the floor, metres
  BodyPose truth_;
  IkTargets targets_;
  mutable Studio studio_;  ///< mutable, because a studio caches its last picture
  Mask ghost_, rim_;
};

/// One half of the convergence film: a method's state at one iteration, as a picture and as numbers.
class ConvergencePanel {
 public:
  /// `path` and `stage` must outlive the panel.
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
  /// `seen_[i]` is the index of the entry whose picture is shown for entry i of the path. A pose gets a new picture
  /// only if it visibly differs from the pose in the last picture.
  std::vector<std::size_t> seen_;
  std::optional<Drawn> drawn_;  ///< the latest picture, cached because several frames may show it
};

/// A film of paper B's figures 5.1 and 5.2: a body whose pose converges under two methods side by side, and, below
/// them, the curves of the methods' errors.
class ConvergenceScene : public Scene {
 public:
  /// Makes the film of a race. The renderer must outlive the scene.
  ConvergenceScene(IkRace race, std::string scenario, Renderer& renderer);
  ConvergenceScene(const ConvergenceScene&) = delete;
  ConvergenceScene& operator=(const ConvergenceScene&) = delete;

  int Frames() const override { return clock_.Frames(); }
  /// Returns the last frame, with complete curves and the final poses.
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
