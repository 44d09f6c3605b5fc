#include <etude/sim/pictures.h>
#include <fmt/format.h>

#include "engine/api/convert.h"
#include "sim/body/shape.h"
#include "sim/render/renderer.h"
#include "sim/rig/rig.h"
#include "sim/stage/stage.h"

namespace etude::sim {
namespace {

BodyMotion MotionToDraw(const engine::Motion& motion) {
  BodyMotion drawn = engine::ToBodyMotion(motion);
  if (drawn.poses.empty()) throw engine::BadInput("a motion without frames");
  return drawn;
}

etude::Camera CameraToDraw(const engine::Camera& camera) {
  const auto complain = [&](std::string_view what) {
    throw engine::BadInput(fmt::format("camera '{}': {}", camera.name, what));
  };
  if (camera.width < 1 || camera.height < 1 || camera.width > kMaxPictureSide || camera.height > kMaxPictureSide) {
    complain(fmt::format("a picture of {} x {} pixels; allowed: 1 to {} a side", camera.width, camera.height,
                         kMaxPictureSide));
  }
  const etude::Camera made = engine::ToEngineCamera(camera);
  if (!made.distortion.IsNone()) complain("a lens with distortion; allowed: none (k1, k2, p1, p2, k3 = 0)");
  return made;
}

Picture PictureOf(const View& view) {
  Picture picture;
  picture.width = view.colour.width;
  picture.height = view.colour.height;
  picture.colour.reserve(3 * view.colour.pixels.size());
  for (const Rgb8& pixel : view.colour.pixels) picture.colour.insert(picture.colour.end(), {pixel.r, pixel.g, pixel.b});
  picture.person.reserve(view.labels.pixels.size());
  for (const auto label : view.labels.pixels) picture.person.push_back(IsPerformer(label) ? 1 : 0);
  return picture;
}

}  // namespace

std::vector<engine::Camera> StereoCameras(const engine::Motion& motion, double baseline_m, std::uint64_t seed) {
  if (!(baseline_m >= 0.05 && baseline_m <= 2)) {
    throw engine::BadInput(fmt::format("a baseline of {} m; allowed: 0.05 to 2", baseline_m));
  }
  const WorldKey dice{.suite_seed = seed, .scenario = "library"};
  RigOptions rig;
  rig.shape = RigShape::kStereo;
  rig.heights_m = {1.4};
  rig.baseline_m = baseline_m;
  std::vector<engine::Camera> cameras;
  for (const etude::Camera& camera : SetUpCameras(rig, MotionToDraw(motion).poses, dice)) {
    cameras.push_back(engine::FromEngineCamera(cameras.empty() ? "left" : "right", camera));
  }
  return cameras;
}

struct Studio::Room {
  BodyMotion motion;
  std::vector<etude::Camera> cameras;
  std::uint64_t seed;
  StagedRoom stage;
  Renderer* renderer;

  Picture Draw(std::size_t camera, double seconds, const BodyPose* person) const {
    if (camera >= cameras.size()) {
      throw engine::BadInput(fmt::format("camera {}; allowed: 0 to {}", camera, cameras.size() - 1));
    }
    etude::Room room;
    room.texture_seed = seed;
    room.brightness = stage.FlickerAt(seconds);
    room.interior = stage.interior();
    std::vector<Figure> figures = stage.MoversAt(seconds);
    if (person != nullptr) figures.push_back(stage.PerformerAt(*person, PerformerColours()));
    return PictureOf(renderer->Render(room, figures, cameras[camera], Targets::kColourAndLabels));
  }
};

Studio::Studio(const engine::Motion& motion, std::span<const engine::Camera> cameras, const StudioOptions& options) {
  if (!(options.scene >= 0 && options.scene <= 1)) {
    throw engine::BadInput(fmt::format("a scene of {}; allowed: 0 to 1", options.scene));
  }
  if (cameras.empty()) throw engine::BadInput("no camera");
  room_ = std::make_unique<Room>(
      Room{.motion = MotionToDraw(motion), .cameras = {}, .seed = options.seed, .stage = {}, .renderer = nullptr});
  for (const engine::Camera& camera : cameras) room_->cameras.push_back(CameraToDraw(camera));
  room_->stage = StagedRoom({.seed = options.seed, .scene = options.scene}, room_->motion.poses, room_->cameras);
  room_->renderer = engine::OrThrow(SharedRenderer());
}
Studio::Studio(Studio&&) noexcept = default;
Studio& Studio::operator=(Studio&&) noexcept = default;
Studio::~Studio() = default;

Picture Studio::Shoot(std::size_t camera, std::size_t frame) const {
  const std::vector<BodyPose>& poses = room_->motion.poses;
  if (frame >= poses.size()) throw engine::BadInput(fmt::format("frame {}; allowed: 0 to {}", frame, poses.size() - 1));
  return room_->Draw(camera, static_cast<double>(frame) / room_->motion.rate_hz, &poses[frame]);
}

Picture Studio::ShootEmpty(std::size_t camera) const {
  return room_->Draw(camera, StagedRoom::kBackgroundSeconds, nullptr);
}

}  // namespace etude::sim
