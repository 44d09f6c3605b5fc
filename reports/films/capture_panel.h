#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/recordings/capture_extras.h"
#include "io/drawing/canvas.h"
#include "io/drawing/film.h"
#include "reports/films/shown_cell.h"
#include "sim/camera/lens.h"
#include "sim/render/renderer.h"
#include "sim/stage/stage.h"

namespace etude {

/// One method's capture: the cameras' views, with the segmented person tinted and outlined, and the recovered skeleton.
class CapturePanel {
 public:
  /// Fails if the recording's extras cannot be read, or do not match the lengths of the recording's motions.
  static Result<CapturePanel> Make(const RunData& run, const ShownCell& cell);

  int Frames() const { return static_cast<int>(truth_.poses.size()); }
  double RateHz() const { return truth_.rate_hz; }
  std::size_t Cameras() const { return extras_.views.size(); }
  /// Returns a camera's name: "First camera" or "Second camera" if there are two cameras, else "Camera 3".
  std::string CameraName(std::size_t camera) const;
  /// Returns the picture that each camera took at the middle frame of the motion.
  std::vector<Still> Stills() const;
  /// Returns the title, the method and the clip: "adaptive on clap".
  std::string Title() const;
  const std::string& Method() const { return method_; }
  /// Returns the name of the performed clip: "clap"; empty if the recording does not state the clip.
  const std::string& Clip() const { return clip_; }
  /// Returns the mean joint error in words: "43 mm now, 51 mm on average"; empty if the run did not measure this error.
  std::string ErrorWords(int frame) const;

  /// Renders one camera's view without noise.
  View Seen(Renderer& renderer, std::size_t camera, int frame, Targets targets) const;

  /// Returns the frames whose intermediate results the recording keeps (`CaptureExtras::moments`).
  const std::vector<CaptureExtras::Moment>& Moments() const { return extras_.moments; }
  const Mask& MaskOf(std::size_t camera, int frame) const {
    return extras_.views[camera].masks[static_cast<std::size_t>(frame)];
  }
  const BodyMotion& Truth() const { return truth_; }
  const BodyPose& Recovered(int frame) const { return recovered_.poses[static_cast<std::size_t>(frame)]; }
  const Camera& CameraOf(std::size_t camera) const { return extras_.views[camera].truth; }
  /// Returns the crop of the camera's pictures that contains the person in every frame, pixels.
  const Box& CropOf(std::size_t camera) const { return crops_[camera]; }

  /// Draws the crop around the person in one camera's picture, with mask and skeleton over it and without text. The
  /// crop fills the canvas. Calls with the same canvas size, camera and frame draw the same picture, so callers may
  /// cache the picture.
  void Draw(Canvas& canvas, Renderer& renderer, std::size_t camera, int frame) const;

 private:
  BodyMotion truth_, recovered_;
  CaptureExtras extras_;
  StagedRoom stage_;
  std::vector<LensWarp> lenses_;  ///< each camera's lens distortion
  std::vector<Box> crops_;        ///< crop around the person, one per camera, in pixels of the camera's pictures
  /// Mean joint error, one per frame; empty if the run did not record errors of frames.
  std::vector<double> errors_mm_;
  std::optional<double> error_mm_;
  std::string method_, clip_;
};

/// Draws bones and joints as the camera sees them; `panel` is the rectangle on the canvas that the camera's whole
/// picture would cover.
void DrawSkeleton(Canvas& canvas, const BodyPose& pose, const Camera& camera, const Box& panel);

/// Returns the outline of a mask: those pixels of the mask that touch a pixel outside the mask.
Mask OutlineOf(const Mask& mask);

}  // namespace etude
