#include "sim/stage/furnish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/angles.h"
#include "sim/random/stream.h"
#include "sim/stage/palette.h"

namespace etude {
namespace {

// Collects the boxes of a piece of furniture in the piece's own frame: x to the left, y up, z away from the wall;
// metres. `place` is the point on the floor at the middle of the piece's back, or at its centre if the piece stands
// free; `heading` is the direction of its front.
class FurnitureBuilder {
 public:
  FurnitureBuilder(const glm::dvec3& place, double heading) : place_(place), heading_(heading) {}

  void Add(const glm::dvec3& low, const glm::dvec3& high, const SurfacePaint& paint) {
    const glm::dvec3 middle = 0.5 * (low + high);
    const double sine = std::sin(heading_), cosine = std::cos(heading_);
    const glm::dvec3 turned(cosine * middle.x + sine * middle.z, middle.y, cosine * middle.z - sine * middle.x);
    boxes_.push_back({place_ + turned, 0.5 * (high - low), heading_, paint});
  }

  const std::vector<FurnitureBox>& boxes() const { return boxes_; }

 private:
  glm::dvec3 place_;
  double heading_;
  std::vector<FurnitureBox> boxes_;
};

Hsv DrawMixed(RandomStream& random, double share) {
  const Hsv studio = DrawStudioColour(random), drawn = DrawColour(random);
  return Mixed(studio, drawn, share);
}

SurfacePaint WithGrain(const Hsv& colour, Pattern pattern, double size) {
  Hsv darker = colour;
  darker.value *= 0.86;
  return {.first = ToRgb(colour), .second = ToRgb(darker), .pattern = pattern, .size = size};
}

SurfacePaint DrawWood(RandomStream& random, double share) {
  const double width = random.Uniform(0.09, 0.2);
  return WithGrain(DrawMixed(random, share), Pattern::kPlanks, width);
}

SurfacePaint DrawFabric(RandomStream& random, double share) {
  const bool is_striped = random.Chance(0.35);
  const double width = random.Uniform(0.05, 0.12);
  return WithGrain(DrawMixed(random, share), is_striped ? Pattern::kStripes : Pattern::kSpeckle,
                   is_striped ? width : 0.015);
}

SurfacePaint Darker(SurfacePaint paint) {
  for (Rgb8* colour : {&paint.first, &paint.second}) {
    *colour = {static_cast<std::uint8_t>(colour->r * 3 / 4), static_cast<std::uint8_t>(colour->g * 3 / 4),
               static_cast<std::uint8_t>(colour->b * 3 / 4)};
  }
  return paint;
}

void AddLegs(FurnitureBuilder& builder, double half_x, double z_near, double z_far, double height, double half_leg,
             const SurfacePaint& paint) {
  for (const double x : {-half_x, half_x}) {
    for (const double z : {z_near, z_far}) {
      builder.Add({x - half_leg, 0, z - half_leg}, {x + half_leg, height, z + half_leg}, paint);
    }
  }
}

// Each function below makes one piece of furniture from boxes. Sizes, colours and details are random. Colours are
// interpolated by `share` between the studio's colours (0) and the colours of everyday objects (1). Each function draws
// a constant number of random numbers.

void MakeCupboard(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.4, 0.65), height = random.Uniform(0.9, 2.05), deep = random.Uniform(0.36, 0.48);
  const SurfacePaint wood = DrawWood(random, share), doors = DrawWood(random, share);
  builder.Add({-half, 0.06, 0.01}, {half, height, deep}, wood);
  builder.Add({-half + 0.03, 0.10, deep}, {-0.01, height - 0.04, deep + 0.015}, doors);
  builder.Add({0.01, 0.10, deep}, {half - 0.03, height - 0.04, deep + 0.015}, doors);
  builder.Add({-half + 0.04, 0, 0.03}, {half - 0.04, 0.06, deep - 0.04}, Darker(wood));
}

void MakeShelf(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.4, 0.6), height = random.Uniform(1.4, 2.1), deep = random.Uniform(0.26, 0.34);
  const SurfacePaint wood = DrawWood(random, share);
  builder.Add({-half, 0, 0.01}, {-half + 0.03, height, deep}, wood);
  builder.Add({half - 0.03, 0, 0.01}, {half, height, deep}, wood);
  builder.Add({-half, 0, 0.005}, {half, height, 0.02}, Darker(wood));
  constexpr int kBoards = 4;
  for (int i = 0; i <= kBoards; ++i) {
    const double y = (height - 0.03) * i / kBoards;
    builder.Add({-half, y, 0.01}, {half, y + 0.03, deep}, wood);
    const double left = random.Uniform(-half + 0.05, -0.1), right = random.Uniform(0.0, half - 0.05);
    const double tall = random.Uniform(0.5, 0.85) * (height / kBoards - 0.03);
    const Hsv one = DrawMixed(random, share), two = DrawMixed(random, share);
    const SurfacePaint books{.first = ToRgb(one), .second = ToRgb(two), .pattern = Pattern::kPatchwork, .size = 0.045};
    if (i < kBoards) builder.Add({left, y + 0.03, 0.03}, {right, y + 0.03 + tall, deep - 0.05}, books);
  }
}

void MakeSofa(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.7, 0.88), seat = random.Uniform(0.38, 0.46), back = random.Uniform(0.75, 0.9);
  const SurfacePaint fabric = DrawFabric(random, share), cushion = DrawFabric(random, share);
  builder.Add({-half, 0.06, 0.03}, {half, seat, 0.82}, fabric);
  builder.Add({-half, seat, 0.03}, {half, back, 0.24}, fabric);
  builder.Add({-half - 0.12, 0.04, 0.03}, {-half, seat + 0.2, 0.84}, Darker(fabric));
  builder.Add({half, 0.04, 0.03}, {half + 0.12, seat + 0.2, 0.84}, Darker(fabric));
  builder.Add({-half + 0.08, seat, 0.24}, {-half + 0.48, seat + 0.36, 0.36}, cushion);
  builder.Add({half - 0.46, seat, 0.24}, {half - 0.06, seat + 0.34, 0.36}, cushion);
}

void MakeTable(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.5, 0.75), height = random.Uniform(0.68, 0.76), deep = random.Uniform(0.6, 0.8);
  const SurfacePaint wood = DrawWood(random, share);
  builder.Add({-half, height - 0.04, 0.05}, {half, height, 0.05 + deep}, wood);
  AddLegs(builder, half - 0.06, 0.1, deep, height - 0.04, 0.025, Darker(wood));
  const double x = random.Uniform(-half + 0.2, half - 0.2);
  const SurfacePaint things = DrawFabric(random, share);
  builder.Add({x - 0.12, height, 0.2}, {x + 0.12, height + random.Uniform(0.1, 0.28), 0.4}, things);
}

// Makes a low cabinet with a screen on top. The screen is the last box.
void MakeScreen(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.5, 0.7), low = random.Uniform(0.42, 0.55), wide = random.Uniform(0.42, 0.58);
  const SurfacePaint wood = DrawWood(random, share);
  builder.Add({-half, 0.05, 0.02}, {half, low, 0.4}, wood);
  builder.Add({-0.12, low, 0.16}, {0.12, low + 0.05, 0.28}, Darker(wood));
  const SurfacePaint black{.first = {34, 34, 38}, .second = {34, 34, 38}};
  builder.Add({-wide, low + 0.05, 0.19}, {wide, low + 0.05 + 1.15 * wide, 0.24}, black);
}

// Makes a plant's pot as one box. The plant's leaves move; class Movers draws them.
void MakePlantPot(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.13, 0.2), height = random.Uniform(0.25, 0.42), out = random.Uniform(0.35, 0.5);
  const SurfacePaint pot = WithGrain(DrawMixed(random, share), Pattern::kPlain, 0.1);
  builder.Add({-half, 0, out - half}, {half, height, out + half}, pot);
}

// Makes a pile of three boxes.
void MakePile(RandomStream& random, double share, FurnitureBuilder& builder) {
  double y = 0, half = random.Uniform(0.26, 0.36);
  for (int i = 0; i < 3; ++i) {
    const double height = random.Uniform(0.2, 0.36), x = random.Uniform(-0.08, 0.08);
    const double grain = random.Uniform(-0.05, 0.05);
    const SurfacePaint board = WithGrain(DrawMixed(random, share), Pattern::kTwoTone, grain);
    builder.Add({x - half, y, 0.05}, {x + half, y + height, 0.05 + 1.5 * half}, board);
    y += height;
    half *= random.Uniform(0.7, 0.95);
  }
}

void MakeChair(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.19, 0.23), seat = random.Uniform(0.43, 0.48), back = random.Uniform(0.82, 0.95);
  const SurfacePaint wood = DrawWood(random, share), cover = DrawFabric(random, share);
  builder.Add({-half, seat - 0.05, -half}, {half, seat, half}, cover);
  AddLegs(builder, half - 0.02, -half + 0.02, half - 0.02, seat - 0.05, 0.018, wood);
  builder.Add({-half, seat, -half}, {-half + 0.03, back, -half + 0.03}, wood);
  builder.Add({half - 0.03, seat, -half}, {half, back, -half + 0.03}, wood);
  builder.Add({-half, back - 0.2, -half}, {half, back, -half + 0.025}, wood);
}

void MakeCrate(RandomStream& random, double share, FurnitureBuilder& builder) {
  const double half = random.Uniform(0.2, 0.32), height = random.Uniform(0.36, 0.6);
  const SurfacePaint wood = DrawWood(random, share);
  const double lid = random.Uniform(0.02, 0.05);
  builder.Add({-half, 0, -0.8 * half}, {half, height, 0.8 * half}, wood);
  builder.Add({-half - 0.015, height, -0.8 * half - 0.015}, {half + 0.015, height + lid, 0.8 * half + 0.015},
              Darker(wood));
}

// The threshold of each piece: the piece can be in the room only if `scene` is at least this value.
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

// Paints walls and floor; each surface has its own random numbers.
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
  // Returns a colour between the yellow of a bulb and the blue of a cloudy sky.
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
  // Add each poster if `scene` has reached the poster's own threshold.
  int number = 0;
  for (const double threshold : {kPoster1, kPoster2, kPoster3}) {
    RandomStream random(key, "poster-" + std::to_string(++number));
    const WallPicture poster = DrawPicture(random, room, share);
    if (scene >= threshold) room.pictures.push_back(poster);
  }
  // Add a window.
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
  // Hang the window on the wall, and let light through it into the room.
  if (scene < kWindow) return;
  room.pictures.push_back(window);
  Lights& lights = room.lights;
  const bool back = window.wall == WallPicture::Wall::kBack;
  const double side = window.wall == WallPicture::Wall::kLeft ? room.low.x : room.high.x;
  lights.window = back ? glm::dvec3(window.centre, room.low.z) : glm::dvec3(side, window.centre.y, window.centre.x);
  // The window's light shines from the wall inwards and does not reach the window's own wall.
  const double strength = 0.30 * daylight * (scene - kWindow) / (1 - kWindow);
  lights.window_colour = strength * glm::dvec3(0.92, 0.98, 1.08);
}

// A place along a wall for one piece of furniture: the middle of the piece's back, and the piece's heading.
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

// Returns a random permutation (Fisher–Yates).
std::array<Slot, 8> Shuffled(std::array<Slot, 8> slots, RandomStream& random) {
  for (std::size_t i = slots.size() - 1; i > 0; --i) std::swap(slots[i], slots[random.IndexBelow(i + 1)]);
  return slots;
}

bool StandsOn(const FurnitureBox& box, const FreeFloor& free) {
  const double reach = std::max(box.half_size.x, box.half_size.z);
  return box.centre.x + reach > free.low.x && box.centre.x - reach < free.high.x && box.centre.z + reach > free.low.y &&
         box.centre.z - reach < free.high.y;
}

// Returns a place for a piece of furniture, between the performer and a camera, at the edge of the free floor. A piece
// in this place hides a part of the performer's legs.
Slot InFrontOf(const Camera& camera, const FreeFloor& free, double aside, double turn) {
  const glm::dvec2 middle = 0.5 * (free.low + free.high), half = 0.5 * (free.high - free.low);
  glm::dvec2 towards(camera.p_WC.x - middle.x, camera.p_WC.z - middle.y);
  const double away = glm::length(towards);
  towards = away > 0 ? towards / away : glm::dvec2(0, 1);
  // Go from the centre of the free floor to the border of this floor, and 45 cm farther.
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
  // Make walls, floor, lights and pictures.
  Interior& room = made.interior;
  room.low = {-size.Uniform(3.5, 4.3), 0, kWallZ};
  room.high = {size.Uniform(3.5, 4.3), size.Uniform(3.1, 3.5), 5.6};
  room.studio = std::max(0.0, 1 - scene / 0.2);
  PaintRoom(key, colour_share, room);
  if (scene < kRug) room.rug = glm::dvec4(0);
  Light(key, scene, room);
  HangPictures(key, scene, colour_share, room);

  // Put each piece at a random place along the walls. Leave out pieces that would be on the free floor.
  const std::array<Slot, 8> slots = Shuffled(Slots(room), order);
  const auto add_piece = [&](const char* purpose, double threshold, auto make, const Slot& slot) {
    RandomStream random(key, purpose);
    FurnitureBuilder builder(slot.place, slot.heading);
    make(random, colour_share, builder);
    const std::vector<FurnitureBox>& piece = builder.boxes();
    if (scene < threshold) return false;
    if (std::ranges::any_of(piece, [&](const FurnitureBox& box) { return StandsOn(box, free); })) return false;
    room.furniture.insert(room.furniture.end(), piece.begin(), piece.end());
    return true;
  };
  add_piece("cupboard", kCupboard, MakeCupboard, slots[0]);
  made.places.has_plant = add_piece("plant", kPlant, MakePlantPot, slots[1]);
  if (made.places.has_plant) {
    const FurnitureBox& pot = room.furniture.back();
    made.places.plant = pot.centre + glm::dvec3(0, pot.half_size.y, 0);
  }
  add_piece("shelf", kShelf, MakeShelf, slots[2]);
  add_piece("sofa", kSofa, MakeSofa, slots[3]);
  made.places.has_screen = add_piece("screen", kScreen, MakeScreen, slots[4]);
  if (made.places.has_screen) made.places.screen = room.furniture.back();
  add_piece("table", kTable, MakeTable, slots[5]);
  add_piece("pile", kPile, MakePile, slots[6]);

  // Put the last two pieces of furniture where they hide a part of the performer from a camera.
  const double chair_aside = front.Uniform(-0.35, 0.35), chair_turn = front.Uniform(-kPi, kPi);
  const double crate_aside = front.Uniform(-0.35, 0.35), crate_turn = front.Uniform(-kPi, kPi);
  const std::size_t first = front.IndexBelow(2);
  if (cameras.empty()) return made;
  const Camera& by_chair = cameras[first % cameras.size()];
  const Camera& by_crate = cameras[(first + 1) % cameras.size()];
  add_piece("chair", kChair, MakeChair, InFrontOf(by_chair, free, chair_aside, chair_turn));
  add_piece("crate", kCrate, MakeCrate, InFrontOf(by_crate, free, crate_aside, crate_turn));
  return made;
}

}  // namespace etude
