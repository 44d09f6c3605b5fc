#include <etude/sim/pictures.h>
#include <fmt/format.h>

#include <algorithm>

#include "engine/api/checks.h"
#include "sim/body/shape.h"
#include "sim/render/renderer.h"
#include "sim/rig/rig.h"
#include "sim/stage/stage.h"

namespace etude::sim {
namespace {

const BodyMotion& MotionToDraw(const BodyMotion& motion) {
  if (engine::Checked(motion).poses.empty()) throw engine::BadInput("a motion without frames");
  return motion;
}

Camera CameraToDraw(const NamedCamera& named) {
  const auto& [width, height, fx, fy, cx, cy, skew] = named.camera.intrinsics;
  if (width < 1 || height < 1 || width > kMaxPictureSide || height > kMaxPictureSide) {
    throw engine::BadInput(
        fmt::format("camera '{}': found a picture size of {} x {} pixels; allowed: 1 to {} pixels on each side",
                    named.name, width, height, kMaxPictureSide));
  }
  if (named.camera.distortion.IsNone()) return named.camera;
  throw engine::BadInput(fmt::format(
      "camera '{}': the lens has distortion; allowed: a lens without distortion (k1, k2, p1, p2, k3 = 0)", named.name));
}

Picture PictureOf(View view) {
  Picture picture{.colour = std::move(view.colour), .person = Mask(view.labels.width, view.labels.height)};
  std::ranges::transform(view.labels.pixels, picture.person.pixels.begin(), IsPerformer);
  return picture;
}

}  // namespace

std::vector<NamedCamera> StereoCameras(const BodyMotion& motion, double baseline_m, std::uint64_t seed) {
  if (!(baseline_m >= 0.05 && baseline_m <= 2)) {
    throw engine::BadInput(fmt::format("the baseline is {} m; allowed: 0.05 to 2 m", baseline_m));
  }
  const WorldKey dice{.suite_seed = seed, .scenario = "library"};
  RigOptions rig;
  rig.shape = RigShape::kStereo;
  rig.heights_m = {1.4};
  rig.baseline_m = baseline_m;
  std::vector<NamedCamera> cameras;
  for (const Camera& camera : SetUpCameras(rig, MotionToDraw(motion).poses, dice)) {
    cameras.push_back({cameras.empty() ? "left" : "right", camera});
  }
  return cameras;
}

struct Studio::Room {
  BodyMotion motion;
  std::vector<Camera> cameras;
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

Studio::Studio(const BodyMotion& motion, std::span<const NamedCamera> cameras, const StudioOptions& options) {
  if (!(options.scene >= 0 && options.scene <= 1)) {
    throw engine::BadInput(fmt::format("scene is {}; allowed: 0 to 1", options.scene));
  }
  if (cameras.empty()) throw engine::BadInput("no camera");
  room_ = std::make_unique<Room>(
      Room{.motion = MotionToDraw(motion), .cameras = {}, .seed = options.seed, .stage = {}, .renderer = nullptr});
  for (const NamedCamera& camera : cameras) room_->cameras.push_back(CameraToDraw(camera));
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
