#pragma once

#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "io/drawing/canvas.h"
#include "io/drawing/film.h"
#include "reports/films/shown_cell.h"
#include "reports/transitions/recorded_requests.h"
#include "sim/render/renderer.h"

namespace etude {

/// A coach that changes from one move to another, seen from the front by a camera that follows the coach. Around each
/// transition point, bars show the partial distances of the two frames that the transition joins.
class CoachPanel {
 public:
  /// Cuts the recording to at most `longest` frames around the first transition point. Fails if the recording's extras
  /// cannot be read.
  static Result<CoachPanel> Make(const ShownCell& cell, int longest);

  int Frames() const { return static_cast<int>(motion_.poses.size()); }
  /// Returns the first frame after the first transition point; with an in-between clip there are two points.
  int FirstPoint() const { return facts_.transition_frames.front(); }
  /// Returns the title, with both clips and the method: "clap → side kick, by fuzzy-bridge".
  std::string Title() const;
  void Draw(Canvas& canvas, const Box& panel, Renderer& renderer, int frame, bool shown_before) const;

 private:
  Camera CameraAt(int frame, double width, double height) const;
  /// Keeps at most `longest` frames around the first transition point.
  void CutTo(int longest);
  std::string CountdownAt(int frame) const;
  void DrawTimeline(Canvas& canvas, const Box& panel, int frame) const;
  void DrawDistances(Canvas& canvas, const Box& panel, int frame) const;

  Character bear_;
  BodyMotion motion_;
  std::vector<glm::dvec3> followed_;  ///< the point that the camera follows, one point per frame
  /// Extras of the recording, with frame numbers of the cut motion; at least one transition point.
  TransitionFacts facts_;
  std::string method_;
};

/// The film of a run that recorded a coach but no capture. It shows the coach changing moves.
class StageScene : public Scene {
 public:
  /// The maximum number of frames of the motion that is shown.
  static constexpr int kLongest = 7 * kFilmRate;

  StageScene(Renderer& renderer, CoachPanel coach) : renderer_(renderer), coach_(std::move(coach)) {}

  int Frames() const override;
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  Renderer& renderer_;
  CoachPanel coach_;
};

}  // namespace etude
