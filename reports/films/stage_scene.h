#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/character.h"
#include "reports/films/canvas.h"
#include "reports/films/capture_panel.h"
#include "reports/films/cast.h"
#include "reports/films/film.h"
#include "reports/transitions/recorded_requests.h"
#include "sim/render/renderer.h"

namespace etude {

/// The left half of the film: the coach changes from one move to another, seen from the front by a
/// camera that follows when it must. Around each transition point stand its distances.
class CoachPanel {
 public:
  /// Cuts the recording to at most `longest` frames around the first transition point. Fails when the recording's facts
  /// cannot be read.
  static Result<CoachPanel> Make(const CastCell& cell, int longest);

  int Frames() const { return static_cast<int>(motion_.poses.size()); }
  /// Gives the first frame after the change (after the first change, when it goes through an in-between clip).
  int FirstPoint() const { return facts_.transition_frames.front(); }
  /// Gives the title: "clap → side kick, by fuzzy-bridge".
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
  std::vector<glm::dvec3> followed_;  ///< what the camera follows, one per frame
  TransitionFacts facts_;             ///< of the motion as cut; at least one transition point
  std::string method_;
};

/// The run's film: the coach changes moves; beside it a performer, as two cameras saw and recovered the body. One of
/// the two alone has the whole frame.
class StageScene : public Scene {
 public:
  /// The most frames of a coach's motion that are shown.
  static constexpr int kLongest = 7 * kFilmRate;

  /// Shows the coach, the capture, or both; at least one is there.
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
