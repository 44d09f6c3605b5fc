#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/recordings/capture_extras.h"
#include "io/drawing/canvas.h"
#include "io/drawing/film.h"
#include "reports/films/cast.h"
#include "sim/camera/lens.h"
#include "sim/render/renderer.h"
#include "sim/stage/stage.h"

namespace etude {

/// One method's capture: the views of its cameras, the person as found in the pictures (tinted, outlined) and the
/// skeleton as recovered from them.
class CapturePanel {
 public:
  /// Fails when the recording's facts cannot be read, or do not belong to its tracks.
  static Result<CapturePanel> Make(const RunData& run, const CastCell& cell);

  int Frames() const { return static_cast<int>(truth_.poses.size()); }
  double RateHz() const { return truth_.rate_hz; }
  std::size_t Cameras() const { return extras_.views.size(); }
  /// Names a camera: "First camera".
  std::string CameraName(std::size_t camera) const;
  /// Gives a picture of each camera as it was taken in the middle of the motion.
  std::vector<Still> Stills() const;
  /// Gives the title: "adaptive on clap".
  std::string Title() const;
  const std::string& Method() const { return method_; }
  /// Names the clip that was performed: "clap"; empty when the recording does not tell.
  const std::string& Clip() const { return clip_; }
  /// Tells the error: "43 mm now, 51 mm on average"; empty when it was not measured.
  std::string ErrorWords(int frame) const;

  /// Renders one camera's view, without noise.
  View Seen(Renderer& renderer, std::size_t camera, int frame, Targets targets) const;

  /// Gives the moments that the recording keeps (`CaptureExtras::moments`).
  const std::vector<CaptureExtras::Moment>& Moments() const { return extras_.moments; }
  const Mask& MaskOf(std::size_t camera, int frame) const {
    return extras_.views[camera].masks[static_cast<std::size_t>(frame)];
  }
  const BodyMotion& Truth() const { return truth_; }
  const BodyPose& Recovered(int frame) const { return recovered_.poses[static_cast<std::size_t>(frame)]; }
  const Camera& CameraOf(std::size_t camera) const { return extras_.views[camera].truth; }
  /// Gives the part of the camera's pictures that holds the person in every frame, pixels.
  const Box& CropOf(std::size_t camera) const { return crops_[camera]; }

  /// Draws the part of one camera's picture around the person, with mask and skeleton over it, without words, over the
  /// whole canvas. The same canvas size gives the same picture, so callers may keep it.
  void Draw(Canvas& canvas, Renderer& renderer, std::size_t camera, int frame) const;

 private:
  BodyMotion truth_, recovered_;
  CaptureExtras extras_;
  StagedRoom stage_;
  std::vector<LensWarp> lenses_;   ///< one per camera
  std::vector<Box> crops_;         ///< one per camera, pixels of its pictures
  std::vector<double> errors_mm_;  ///< one per frame; empty when the run kept no such curve
  std::optional<double> error_mm_;
  std::string method_, clip_;
};

/// Draws the body's bones and joints as the camera sees them; `panel` is where its whole picture lies.
void DrawSkeleton(Canvas& canvas, const BodyPose& pose, const Camera& camera, const Box& panel);

/// Gives the pixels of the mask that touch something outside it.
Mask OutlineOf(const Mask& mask);

}  // namespace etude
