#pragma once

#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "sim/camera/camera_model.h"
#include "sim/render/renderer.h"

namespace etude {

/// Returns the pose at a fractional frame: a cubic through the two frames on either side (Catmull-Rom), so that motion
/// is smooth; exactly poses[k] at k. Before the first and after the last frame it is constant.
BodyPose PoseAt(std::span<const BodyPose> poses, double frame);

/// Returns the figure of the performer at a fractional frame.
Figure PerformerAt(const CaptureWorld& world, double frame);

/// Returns only the effects that decide where and when cameras look (clocks, shutter, lens), without the effects that
/// degrade the picture. Used for pictures of the truth.
CameraEffects FaultlessPictures(const CameraEffects& effects);

/// Shoots the pictures of a take.
class Shooting {
 public:
  Shooting(const CaptureWorld& world, const CameraEffects& effects, const WorldKey& key, Renderer& renderer);

  /// Shoots a camera's frame with its clock, lens and sensor; with labels and depth on request.
  View Shoot(std::size_t camera, std::size_t frame, Targets targets);
  /// Shoots the stage with `props` but without the performer; without props this is the background picture. Moving
  /// things are where they were before the take.
  ColourImage ShootStage(std::size_t camera, const std::vector<Figure>& props = {});

  /// Returns the pose at the time of the picture's middle row.
  BodyPose SeenPose(std::size_t camera, std::size_t frame) const;

  const CameraModel& camera(std::size_t index) const { return cameras_[index]; }

 private:
  const CaptureWorld& world_;
  Renderer& renderer_;
  std::vector<CameraModel> cameras_;
};

}  // namespace etude
