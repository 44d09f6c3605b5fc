#include "sim/stage/furnish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "engine/base/angles.h"
#include "sim/random/stream.h"
#include "sim/render/renderer.h"
#include "sim/stage/palette.h"
#include "sim/stage/pieces_of_furniture.h"

namespace etude {
namespace {

// From which `scene` on each piece stands in the room.
constexpr double kPoster1 = 0.05, kCupboard = 0.10, kPlant = 0.15, kRug = 0.20, kShelf = 0.25, kPoster2 = 0.30;
constexpr double kWindow = 0.35, kSofa = 0.40, kScreen = 0.45, kTable = 0.50, kPoster3 = 0.55, kChair = 0.65;
constexpr double kPile = 0.75, kCrate = 0.85;

SurfacePaint RoomPaint(RandomStream& random, const Hsv& studio, double share, std::span<const Pattern> patterns,
                       std::span<const double> sizes) {
  const Hsv drawn = DrawColour(random), other = DrawColour(random);
  const Hsv first = Mixed(studio, drawn, share);
  const std::size_t pick = random.IndexBelow(patterns.size());
  Hsv second = Mixed(first, other, 0.12 * share);
  second.value = first.value * random.Uniform(0.78, 0.93);
  return {.first = ToRgb(first), .second = ToRgb(second), .pattern = patterns[pick], .size = sizes[pick]};
}

// Walls and floor, by their own dice.
void PaintRoom(const WorldKey& key, double share, Interior& room) {
  RandomStream walls(key, "walls"), floor(key, "floor"), rug(key, "rug"), ceiling(key, "ceiling");
  constexpr std::array kWallPatterns = {Pattern::kPlain, Pattern::kStripes, Pattern::kSpeckle, Pattern::kTwoTone};
  constexpr std::array kWallSizes = {0.1, 0.24, 0.03, 1.05};
  constexpr std::array kFloorPatterns = {Pattern::kPlanks, Pattern::kTiles, Pattern::kSpeckle};
  constexpr std::array kFloorSizes = {0.13, 0.42, 0.025};
  room.wall = RoomPaint(walls, {192, 0.45, 0.64}, share, kWallPatterns, kWallSizes);
  room.floor = RoomPaint(floor, {218, 0.47, 0.64}, share, kFloorPatterns, kFloorSizes);
  Hsv white = Mixed({200, 0.25, 0.75}, {ceiling.Uniform(20, 60), 0.16, 0.9}, share);
  room.ceiling = {.first = ToRgb(white), .second = ToRgb(white)};
  Hsv skirting = ToHsv(room.wall.first);
  skirting.value *= 0.6;
  room.skirting = ToRgb(skirting);

  constexpr std::array kRugPatterns = {Pattern::kSpeckle, Pattern::kChecks, Pattern::kBands};
  constexpr std::array kRugSizes = {0.02, 0.5, 0.35};
  room.rug_paint = RoomPaint(rug, {165, 0.4, 0.6}, share, kRugPatterns, kRugSizes);
  room.rug = {rug.Uniform(-0.5, 0.5), rug.Uniform(-0.6, 0.4), rug.Uniform(0.9, 1.6), rug.Uniform(0.7, 1.2)};
}

void Light(const WorldKey& key, double scene, Interior& room) {
  RandomStream random(key, "lights");
  Lights& lights = room.lights;
  const glm::dvec3 offset{random.Uniform(-0.9, 1.5), random.Uniform(-0.1, 0.05), random.Uniform(-1.3, 0.5)};
  lights.key += scene * offset;
  // Between a bulb's yellow and a cloudy sky's blue.
  const auto tint = [&](double warmth, double strength) {
    return glm::dvec3(1) + scene * strength * warmth * glm::dvec3(0.10, 0.0, -0.14);
  };
  const double key_warmth = random.Uniform(-0.4, 1), sky_warmth = random.Uniform(-1, 0.3);
  lights.key_colour = tint(key_warmth, 1) * (1 - 0.12 * scene);
  lights.ambient_colour = tint(sky_warmth, 0.7) * (1 - 0.15 * scene);
  const double azimuth = random.Uniform(0, 2 * kPi), lift = random.Uniform(0.2, 0.6);
  lights.fill = glm::normalize(glm::dvec3(std::sin(azimuth), lift, std::cos(azimuth)));
  const double fill = random.Uniform(0.04, 0.12);
  lights.fill_colour = scene * fill * tint(-sky_warmth, 1);
}

WallPicture DrawPicture(RandomStream& random, const Interior& room, double share) {
  WallPicture picture;
  picture.wall = static_cast<WallPicture::Wall>(random.IndexBelow(3));
  const bool back = picture.wall == WallPicture::Wall::kBack;
  picture.centre = {back ? random.Uniform(room.low.x + 0.9, room.high.x - 0.9) : random.Uniform(-1.8, 1.0),
                    random.Uniform(1.5, 1.9)};
  picture.half_size = {random.Uniform(0.22, 0.5), random.Uniform(0.25, 0.5)};
  const Hsv studio = DrawStudioColour(random), drawn = DrawColour(random), second = DrawColour(random);
  const Hsv first = Mixed(studio, drawn, share);
  picture.paint = {.first = ToRgb(first),
                   .second = ToRgb(Mixed(studio, second, share)),
                   .pattern = random.Chance(0.6) ? Pattern::kPatchwork : Pattern::kBands,
                   .size = random.Uniform(0.07, 0.2)};
  Hsv frame = first;
  frame.value *= 0.5;
  picture.frame = ToRgb(frame);
  return picture;
}

void HangPictures(const WorldKey& key, double scene, double share, Interior& room) {
  int number = 0;
  for (const double threshold : {kPoster1, kPoster2, kPoster3}) {
    RandomStream random(key, "poster-" + std::to_string(++number));
    const WallPicture poster = DrawPicture(random, room, share);
    if (scene >= threshold) room.pictures.push_back(poster);
  }
  RandomStream random(key, "window");
  WallPicture window = DrawPicture(random, room, share);
  window.half_size = {random.Uniform(0.5, 0.8), random.Uniform(0.55, 0.75)};
  window.centre.y = 1.75;
  const double daylight = random.Uniform(0.6, 1.0);
  window.paint = {.first = ToRgb({205, 0.25, 0.95}),
                  .second = ToRgb({120, 0.3, 0.6}),
                  .pattern = Pattern::kTwoTone,
                  .size = random.Uniform(-0.4, 0.1)};
  window.frame = {225, 222, 214};
  window.glow = daylight;
  if (scene < kWindow) return;
  room.pictures.push_back(window);
  Lights& lights = room.lights;
  const bool back = window.wall == WallPicture::Wall::kBack;
  const double side = window.wall == WallPicture::Wall::kLeft ? room.low.x : room.high.x;
  lights.window = back ? glm::dvec3(window.centre, room.low.z) : glm::dvec3(side, window.centre.y, window.centre.x);
  // The glass lights the room from the wall inwards: a little before it, so that its own wall gets none.
  const double strength = 0.30 * daylight * (scene - kWindow) / (1 - kWindow);
  lights.window_colour = strength * glm::dvec3(0.92, 0.98, 1.08);
}

// A place along a wall, where one piece can stand: the middle of its back, and where it looks.
struct Slot {
  glm::dvec3 place{0};
  double heading = 0;
};

std::array<Slot, 8> Slots(const Interior& room) {
  const double back = room.low.z, left = room.low.x, right = room.high.x;
  return {{{{left + 1.1, 0, back}, 0},
           {{left + 2.9, 0, back}, 0},
           {{right - 2.9, 0, back}, 0},
           {{right - 1.1, 0, back}, 0},
           {{left, 0, -1.2}, kPi / 2},
           {{left, 0, 0.7}, kPi / 2},
           {{right, 0, -1.2}, -kPi / 2},
           {{right, 0, 0.7}, -kPi / 2}}};
}

// A permutation by dice (Fisher and Yates).
std::array<Slot, 8> Shuffled(std::array<Slot, 8> slots, RandomStream& random) {
  for (std::size_t i = slots.size() - 1; i > 0; --i) std::swap(slots[i], slots[random.IndexBelow(i + 1)]);
  return slots;
}

bool StandsOn(const FurnitureBox& box, const FreeFloor& free) {
  const double reach = std::max(box.half_size.x, box.half_size.z);
  return box.centre.x + reach > free.low.x && box.centre.x - reach < free.high.x && box.centre.z + reach > free.low.y &&
         box.centre.z - reach < free.high.y;
}

// Between the performer and one of the cameras, at the edge of the free floor, where it hides part of the legs.
Slot InFrontOf(const Camera& camera, const FreeFloor& free, double aside, double turn) {
  const glm::dvec2 middle = 0.5 * (free.low + free.high), half = 0.5 * (free.high - free.low);
  glm::dvec2 towards(camera.p_WC.x - middle.x, camera.p_WC.z - middle.y);
  const double away = glm::length(towards);
  towards = away > 0 ? towards / away : glm::dvec2(0, 1);
  // To the border of the rectangle, and half a metre on.
  const double to_border = std::min(std::abs(towards.x) > 1e-6 ? half.x / std::abs(towards.x) : 1e9,
                                    std::abs(towards.y) > 1e-6 ? half.y / std::abs(towards.y) : 1e9);
  const double distance = std::min(to_border + 0.45, 0.62 * away);
  const glm::dvec2 place = middle + distance * towards + aside * glm::dvec2(-towards.y, towards.x);
  return {{place.x, 0, place.y}, turn};
}

}  // namespace

FurnishedRoom Furnish(std::uint64_t seed, double scene, double colour_share, const FreeFloor& free,
                      std::span<const Camera> cameras) {
  const WorldKey key{seed, "stage", 0};
  RandomStream size(key, "size"), order(key, "slots"), front(key, "in-front");
  FurnishedRoom made;
  Interior& room = made.interior;
  room.low = {-size.Uniform(3.5, 4.3), 0, kWallZ};
  room.high = {size.Uniform(3.5, 4.3), size.Uniform(3.1, 3.5), 5.6};
  room.studio = std::max(0.0, 1 - scene / 0.2);
  PaintRoom(key, colour_share, room);
  if (scene < kRug) room.rug = glm::dvec4(0);
  Light(key, scene, room);
  HangPictures(key, scene, colour_share, room);

  const std::array<Slot, 8> slots = Shuffled(Slots(room), order);
  const auto stand = [&](const char* purpose, double threshold, auto make, const Slot& slot) {
    RandomStream random(key, purpose);
    const std::vector<FurnitureBox> piece = make(random, colour_share, slot.place, slot.heading);
    if (scene < threshold) return false;
    for (const FurnitureBox& box : piece) {
      if (StandsOn(box, free)) return false;
    }
    room.furniture.insert(room.furniture.end(), piece.begin(), piece.end());
    return true;
  };
  stand("cupboard", kCupboard, MakeCupboard, slots[0]);
  made.places.has_plant = stand("plant", kPlant, MakePlantPot, slots[1]);
  if (made.places.has_plant) {
    const FurnitureBox& pot = room.furniture.back();
    made.places.plant = pot.centre + glm::dvec3(0, pot.half_size.y, 0);
  }
  stand("shelf", kShelf, MakeShelf, slots[2]);
  stand("sofa", kSofa, MakeSofa, slots[3]);
  made.places.has_screen = stand("screen", kScreen, MakeScreen, slots[4]);
  if (made.places.has_screen) made.places.screen = room.furniture.back();
  stand("table", kTable, MakeTable, slots[5]);
  stand("pile", kPile, MakePile, slots[6]);

  // These two hide part of the performer from the cameras.
  const double chair_aside = front.Uniform(-0.35, 0.35), chair_turn = front.Uniform(-kPi, kPi);
  const double crate_aside = front.Uniform(-0.35, 0.35), crate_turn = front.Uniform(-kPi, kPi);
  const std::size_t first = front.IndexBelow(2);
  if (cameras.empty()) return made;
  const Camera& by_chair = cameras[first % cameras.size()];
  const Camera& by_crate = cameras[(first + 1) % cameras.size()];
  stand("chair", kChair, MakeChair, InFrontOf(by_chair, free, chair_aside, chair_turn));
  stand("crate", kCrate, MakeCrate, InFrontOf(by_crate, free, crate_aside, crate_turn));
  return made;
}

}  // namespace etude
