#include "sim/stage/stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/base/angles.h"
#include "sim/body/shape.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

// Where the performer is at any moment, with some air.
FreeFloor FloorOf(std::span<const BodyPose> poses) {
  constexpr double kAir = 0.3, kInfinity = std::numeric_limits<double>::infinity();
  FreeFloor free{glm::dvec2(kInfinity), glm::dvec2(-kInfinity)};
  for (const BodyPose& pose : poses) {
    for (const glm::dvec3& joint : pose.joints) {
      free.low = glm::min(free.low, glm::dvec2(joint.x, joint.z) - kAir);
      free.high = glm::max(free.high, glm::dvec2(joint.x, joint.z) + kAir);
    }
  }
  return poses.empty() ? FreeFloor{glm::dvec2(-0.5), glm::dvec2(0.5)} : free;
}

}  // namespace

double ColourShare(double scene) {
  // Hue segmentation bears much: these steps make its IoU fall about evenly (README.md).
  constexpr std::array kSteps = {0.0, 0.85, 0.92, 0.95, 1.0};
  const double step = std::clamp(scene, 0.0, 1.0) * (kSteps.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(step), kSteps.size() - 2);
  return std::lerp(kSteps[below], kSteps[below + 1], step - static_cast<double>(below));
}

StagedRoom::StagedRoom(const StageOptions& options, std::span<const BodyPose> poses, std::span<const Camera> cameras) {
  is_hooded_ = options.wardrobe == Wardrobe::kCoded;
  if (!(options.scene > 0)) return;
  const double share = ColourShare(options.scene);
  const FreeFloor free = FloorOf(poses);
  furnished_ = Furnish(options.seed, options.scene, share, free, cameras);
  movers_.emplace(options.seed, options.scene, share, *furnished_, free);
  performer_.emplace(MakeOutfit(options.seed, "performer", options.wardrobe, share));
  RandomStream random({options.seed, "stage", 0}, "flicker");
  flicker_ = options.scene * random.Uniform(0.01, 0.05);
  flicker_phase_ = random.Uniform();
}

Figure StagedRoom::PerformerAt(const BodyPose& pose, const PartColours& studio) const {
  if (performer_) return performer_->At(pose);
  Figure capsules{BodyCapsules(pose), studio};
  capsules.is_hooded = is_hooded_;
  return capsules;
}

std::vector<Figure> StagedRoom::MoversAt(double seconds) const {
  return movers_ ? movers_->At(seconds) : std::vector<Figure>{};
}

std::optional<BodyPose> StagedRoom::BystanderAt(double seconds) const {
  return movers_ ? movers_->BystanderAt(seconds) : std::nullopt;
}

double StagedRoom::FlickerAt(double seconds) const {
  // A mains a little off 50 Hz, so that 30 pictures a second show a slow beat.
  constexpr double kLampHz = 2 * 50.02;
  return 1 + flicker_ * std::sin(2 * kPi * (kLampHz * seconds + flicker_phase_));
}

}  // namespace etude
