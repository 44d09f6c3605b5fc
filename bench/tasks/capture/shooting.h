#pragma once

#include <span>
#include <vector>

#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/world.h"
#include "sim/camera/camera_model.h"
#include "sim/render/renderer.h"

namespace etude {

/// The pose at a time between frames, told in frames: a cubic through the two frames on either side (Catmull-Rom), so
/// that nothing jumps; exactly poses[k] at k; beyond the ends the first or the last.
BodyPose PoseAt(std::span<const BodyPose> poses, double frame);

/// Gives the pose that is seen at a time.
Figure PerformerAt(const CaptureWorld& world, double frame);

/// Keeps of the effects where and when cameras look, and nothing that harms what they see: the effects for pictures of
/// the truth.
CameraEffects FaultlessPictures(const CameraEffects& effects);

/// The cameras of a take at work.
class Shooting {
 public:
  Shooting(const CaptureWorld& world, const CameraEffects& effects, const WorldKey& key, Renderer& renderer);

  /// A camera's own frame, as its clock, lens and sensor have it; labels and depth if asked for.
  View Shoot(std::size_t camera, std::size_t frame, Targets targets);
  /// The stage without the performer, with what moves there where it was before the take, and what `props` stand on it:
  /// none for the background picture.
  ColourImage ShootStage(std::size_t camera, const std::vector<Figure>& props = {});

  /// The pose that is seen in a frame: that at the time of the picture's middle row.
  BodyPose SeenPose(std::size_t camera, std::size_t frame) const;

  const CameraModel& camera(std::size_t index) const { return cameras_[index]; }

 private:
  const CaptureWorld& world_;
  Renderer& renderer_;
  std::vector<CameraModel> cameras_;
};

}  // namespace etude
