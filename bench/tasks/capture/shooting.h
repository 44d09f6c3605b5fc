#pragma once

#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "sim/camera/camera_model.h"
#include "sim/render/renderer.h"

namespace etude {

/// Returns the pose at a fractional frame by Catmull-Rom interpolation of each joint's position: a cubic from the
/// frame before to the frame after. At a whole number k, this is poses[k]. Before the first and after the last frame,
/// the pose is constant.
BodyPose PoseAt(std::span<const BodyPose> poses, double frame);

/// Returns the figure of the performer at a fractional frame.
Figure PerformerAt(const CaptureWorld& world, double frame);

/// Returns a copy of `effects` with only the effects on the camera's time and geometry (clocks, shutter, lens). Effects
/// that degrade the picture are left out. The copy is for pictures of the truth.
CameraEffects FaultlessPictures(const CameraEffects& effects);

/// Shoots the pictures of a take.
class Shooting {
 public:
  Shooting(const CaptureWorld& world, const CameraEffects& effects, const WorldKey& key, Renderer& renderer);

  /// Shoots a camera's picture of a frame with the camera's clock, lens and sensor. `targets` selects labels and depth
  /// in addition to colour.
  View Shoot(std::size_t camera, std::size_t frame, Targets targets);
  /// Shoots the stage with `props` but without the performer. Without props, this is the background picture. Moving
  /// objects are where they were before the take.
  ColourImage ShootStage(std::size_t camera, const std::vector<Figure>& props = {});

  /// Returns the performer's pose at the time of the picture's middle row.
  BodyPose SeenPose(std::size_t camera, std::size_t frame) const;

  const CameraModel& camera(std::size_t index) const { return cameras_[index]; }

 private:
  const CaptureWorld& world_;
  Renderer& renderer_;
  std::vector<CameraModel> cameras_;
};

}  // namespace etude
