#include "bench/tasks/capture/shooting.h"

#include <algorithm>

#include "sim/body/shape.h"

namespace etude {
namespace {

/// A time between two frames.
struct BetweenFrames {
  std::size_t before = 0;
  double share = 0;  ///< 0…1, the fraction of the way to the next frame

  BetweenFrames(std::size_t frames, double frame) {
    const double inside = std::clamp(frame, 0.0, static_cast<double>(frames - 1));
    before = static_cast<std::size_t>(inside);
    share = inside - static_cast<double>(before);
  }
};

double BrightnessAt(const std::vector<double>& brightness, double frame) {
  const BetweenFrames at(brightness.size(), frame);
  if (at.share == 0) return brightness[at.before];
  return (1 - at.share) * brightness[at.before] + at.share * brightness[at.before + 1];
}

}  // namespace

BodyPose PoseAt(std::span<const BodyPose> poses, double frame) {
  const BetweenFrames at(poses.size(), frame);
  if (at.share == 0) return poses[at.before];
  const std::size_t last = poses.size() - 1;
  const BodyPose& b = poses[at.before];
  const BodyPose& c = poses[at.before + 1];
  const BodyPose& a = poses[at.before == 0 ? 0 : at.before - 1];
  const BodyPose& d = poses[std::min(at.before + 2, last)];
  BodyPose pose = b;
  const double t = at.share, u = 1 - t;
  for (const Role role : AllRoles()) {
    const glm::dvec3 leaving = 0.5 * (c[role] - a[role]), arriving = 0.5 * (d[role] - b[role]);
    pose[role] =
        u * u * (1 + 2 * t) * b[role] + t * t * (3 - 2 * t) * c[role] + t * u * u * leaving - t * t * u * arriving;
  }
  return pose;
}

Figure PerformerAt(const CaptureWorld& world, double frame) {
  const BodyPose pose = PoseAt(world.truth, frame);
  if (!world.own) return world.stage.PerformerAt(pose, world.colours);
  const double inside = std::clamp(frame, 0.0, static_cast<double>(world.truth.size() - 1));
  Figure figure = world.own->figure->At(static_cast<double>(world.own->first) + inside, world.own->move);
  figure.shadow = BodyCapsules(pose);
  return figure;
}

CameraEffects FaultlessPictures(const CameraEffects& effects) {
  return {.sync_offset_ms = effects.sync_offset_ms,
          .clock_drift_ppm = effects.clock_drift_ppm,
          .rolling_shutter_ms = effects.rolling_shutter_ms,
          .radial_distortion = effects.radial_distortion,
          .tangential_distortion = effects.tangential_distortion,
          .noise = 0};
}

Shooting::Shooting(const CaptureWorld& world, const CameraEffects& effects, const WorldKey& key, Renderer& renderer)
    : world_(world), renderer_(renderer) {
  cameras_.reserve(world.cameras.size());
  for (std::size_t i = 0; i < world.cameras.size(); ++i) {
    cameras_.emplace_back(world.cameras[i], effects, kJudgedRateHz,
                          CameraIdentity{key, fmt::format("capture/camera-{}", i), /*is_reference=*/i == 0});
  }
}

View Shooting::Shoot(std::size_t camera, std::size_t frame, Targets targets) {
  CameraModel& model = cameras_[camera];
  const auto scene = [&](double time, const RowRange& rows, Targets wanted) {
    const double seconds = time / kJudgedRateHz;
    Room room = world_.room;
    room.brightness *= BrightnessAt(world_.brightness, time) * world_.stage.FlickerAt(seconds);
    room.interior = world_.stage.interior();
    std::vector<Figure> figures = world_.stage.MoversAt(seconds);
    figures.push_back(PerformerAt(world_, time));
    return renderer_.RenderRows(room, figures, model.pinhole(), wanted, rows);
  };
  return model.Shoot(frame, scene, targets);
}

BodyPose Shooting::SeenPose(std::size_t camera, std::size_t frame) const {
  return PoseAt(world_.truth, cameras_[camera].shutter().TimeOf(frame));
}

ColourImage Shooting::ShootStage(std::size_t camera, const std::vector<Figure>& props) {
  CameraModel& model = cameras_[camera];
  return model.ShootBackground([&](double, const RowRange& rows, Targets wanted) {
    Room room = world_.room;
    room.interior = world_.stage.interior();
    std::vector<Figure> figures = world_.stage.MoversAt(StagedRoom::kBackgroundSeconds);
    figures.insert(figures.end(), props.begin(), props.end());
    return renderer_.RenderRows(room, figures, model.pinhole(), wanted, rows);
  });
}

}  // namespace etude
