#include "sim/stage/stage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "engine/base/angles.h"
#include "sim/body/shape.h"
#include "sim/choreography/move.h"
#include "sim/random/stream.h"
#include "sim/stage/palette.h"
#include "sim/stage/wardrobe.h"

namespace etude {
namespace {

// The values of `scene` from which on the ball and the second person are present. (The plant and the screen appear with
// their furniture.)
constexpr double kBall = 0.55, kBystander = 0.60;
constexpr double kShotSeconds = 1.7;  // duration of each picture that the screen shows, seconds

double Wave(double seconds, double rate_hz, double phase) { return std::sin(2 * kPi * (rate_hz * seconds + phase)); }

BodyPose Placed(const BodyPose& pose, double size, double heading, const glm::dvec3& place) {
  BodyPose scaled = ToOrigin(pose).Apply(pose);
  for (glm::dvec3& joint : scaled.joints) joint *= size;
  return FloorMove{heading, place.x, place.z}.Apply(scaled);
}

// Returns the floor that the performer uses, plus a margin.
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

Movers::Movers(std::uint64_t seed, double scene, double colour_share, const FurnishedRoom& room, const FreeFloor& free)
    : seed_(seed), scene_(scene), colour_share_(colour_share), places_(room.places) {
  const WorldKey key{seed, "stage", 0};
  RandomStream plant(key, "leaves"), ball(key, "ball"), person(key, "bystander");

  leaf_colour_ = ToRgb(Mixed({150, 0.5, 0.5}, {plant.Uniform(80, 130), 0.5, plant.Uniform(0.35, 0.6)}, colour_share));
  // Place the plant's leaves around the pot, each turned by the golden angle from the previous leaf.
  const double tall = plant.Uniform(0.35, 0.9);
  constexpr int kLeaves = 14;
  for (int i = 0; i < kLeaves; ++i) {
    const double angle = 2 * kPi * (i * 0.381966 + 0.05 * plant.Uniform()), out = plant.Uniform(0.12, 0.34);
    const double up = tall * (0.35 + 0.65 * plant.Uniform()), phase = plant.Uniform(), rate = plant.Uniform(0.3, 0.7);
    leaves_.push_back({{out * std::cos(angle), up, out * std::sin(angle)}, phase, rate});
  }

  // Place the ball behind the performer.
  const double behind = std::max(room.interior.low.z + 0.45, std::min(-1.25, free.low.y - 0.2));
  Ball drawn;
  drawn.middle = {ball.Uniform(-0.6, 0.6), 0, behind + 0.15};
  drawn.reach = ball.Uniform(1.4, 2.4);
  drawn.radius = ball.Uniform(0.09, 0.17);
  drawn.height = ball.Uniform(0.2, 0.9);
  drawn.period_s = ball.Uniform(5, 9);
  drawn.phase = ball.Uniform();
  drawn.colour = ToRgb(Mixed(DrawStudioColour(ball), DrawColour(ball), colour_share));
  if (scene >= kBall) ball_ = drawn;

  // Add the second person, who dances a built-in move.
  const std::vector<std::string> moves = BuiltinMoveNames();
  const std::string& name = moves[person.IndexBelow(moves.size())];
  const glm::dvec3 place{person.Uniform(-1.0, 1.0), 0, behind};
  const double size = person.Uniform(0.86, 1.06), heading = person.Uniform(-1.4, 1.4);
  const double stroll = person.Uniform(0.3, 1.1), period = person.Uniform(7, 12), phase = person.Uniform();
  if (scene < kBystander || free.low.y - 0.2 < room.interior.low.z + 0.45) return;  // no room behind the performer
  const auto move = LoadBuiltinMove(name);
  if (!move) return;
  bystander_ = Bystander{DressedPerson(MakeOutfit(seed, "bystander", Wardrobe::kStudio, colour_share)),
                         move->motion,
                         place,
                         size,
                         heading,
                         stroll,
                         period,
                         phase};
}

Figure Movers::PlantAt(double seconds) const {
  Figure plant{.shape = {}, .seen_as = Part::kClutter};
  plant.colours.fill(leaf_colour_);
  const double sway = 0.01 + 0.09 * scene_;  // amplitude at the leaves' tips, metres
  for (const Leaf& leaf : leaves_) {
    const double wave = sway * Wave(seconds, leaf.rate_hz, leaf.phase);
    const glm::dvec3 tip = places_.plant + leaf.tip + wave * glm::dvec3(1, -0.2, 0.4);
    const glm::dvec3 knee = places_.plant + glm::dvec3(0.45, 0.75, 0.45) * leaf.tip + 0.3 * wave * glm::dvec3(1, 0, 0);
    plant.shape.push_back({Part::kTrunk, places_.plant - glm::dvec3(0, 0.03, 0), knee, 0.012});
    plant.shape.push_back({Part::kTrunk, knee, tip, 0.028});
  }
  return plant;
}

Figure Movers::ScreenAt(double seconds) const {
  // Every picture on the screen has its own random numbers.
  const auto shot = static_cast<std::int64_t>(std::floor(seconds / kShotSeconds));
  RandomStream random({seed_, "stage", 0}, "screen/shot/" + std::to_string(shot));
  const Hsv studio = DrawStudioColour(random), one = DrawColour(random), two = DrawColour(random);
  const double size = random.Uniform(0.08, 0.25), phase = random.Uniform();
  const double flicker = 1 + 0.25 * scene_ * (Wave(seconds, 2.3, phase) + 0.5 * Wave(seconds, 6.1, 2 * phase));
  Hsv bright = Mixed(studio, one, colour_share_), other = Mixed(studio, two, colour_share_);
  bright.value = std::clamp(0.85 * flicker, 0.0, 1.0);
  other.value = std::clamp(0.6 * flicker, 0.0, 1.0);

  // Make a rectangle on the front of the box.
  const FurnitureBox& box = places_.screen;
  const glm::dvec3 across(std::cos(box.heading), 0, -std::sin(box.heading)),
      out(std::sin(box.heading), 0, std::cos(box.heading));
  const glm::dvec3 middle = box.centre + (box.half_size.z + 0.004) * out;
  Surface surface;
  for (const glm::dvec2& corner : {glm::dvec2{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const glm::dvec2 place = corner * (glm::dvec2(box.half_size) - 0.02);
    surface.positions.push_back(middle + place.x * across + place.y * glm::dvec3(0, 1, 0));
    surface.normals.push_back(out);
    surface.rest.emplace_back(place.x, place.y, 0);
  }
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  surface.parts = {Part::kClutter, Part::kClutter};
  surface.is_closed = true;  // true, because the back of the surface is inside the box
  surface.paint =
      SurfacePaint{.first = ToRgb(bright), .second = ToRgb(other), .pattern = Pattern::kChecks, .size = size};
  return {.shape = {}, .surfaces = {surface}, .seen_as = Part::kClutter};
}

Figure Movers::BallAt(double seconds) const {
  const double across = Wave(seconds, 1 / ball_->period_s, ball_->phase);
  const double bounce = std::abs(Wave(seconds, 0.55, ball_->phase));
  const glm::dvec3 place = ball_->middle + glm::dvec3(ball_->reach * across, ball_->radius + ball_->height * bounce, 0);
  Figure figure{.shape = {{Part::kTrunk, place, place, ball_->radius}}, .seen_as = Part::kClutter};
  figure.colours.fill(ball_->colour);
  return figure;
}

std::optional<BodyPose> Movers::BystanderAt(double seconds) const {
  if (!bystander_) return std::nullopt;
  const Bystander& who = *bystander_;
  const auto count = static_cast<std::int64_t>(who.motion.poses.size());
  const auto frame = static_cast<std::int64_t>(std::lround(seconds * who.motion.rate_hz));
  const BodyPose& pose = who.motion.poses[static_cast<std::size_t>(((frame % count) + count) % count)];
  const double stroll = who.stroll_m * scene_ * Wave(seconds, 1 / who.period_s, who.phase);
  return Placed(pose, who.size, who.heading, who.place + glm::dvec3(stroll, 0, 0));
}

std::vector<Figure> Movers::At(double seconds) const {
  std::vector<Figure> figures;
  if (places_.has_plant) figures.push_back(PlantAt(seconds));
  if (places_.has_screen) figures.push_back(ScreenAt(seconds));
  if (ball_) figures.push_back(BallAt(seconds));
  if (const auto pose = BystanderAt(seconds)) {
    figures.push_back(bystander_->person.At(*pose));
    figures.back().seen_as = Part::kBystander;
  }
  return figures;
}

double ColourShare(double scene) {
  // The share of everyday colours at equally spaced values of `scene`. Segmentation by hue becomes difficult only at
  // large shares. With these values, the IoU of segmentation falls about evenly with `scene` (README.md).
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
  // The mains frequency is slightly off 50 Hz, so pictures at 30 Hz show a slow beat.
  constexpr double kLampHz = 2 * 50.02;
  return 1 + flicker_ * std::sin(2 * kPi * (kLampHz * seconds + flicker_phase_));
}

}  // namespace etude
