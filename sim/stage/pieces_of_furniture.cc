#include "sim/stage/pieces_of_furniture.h"

#include <cmath>

#include "sim/stage/palette.h"

namespace etude {
namespace {

// Collects boxes in a piece's own frame: x to its left as it looks, y up, z out of the wall. Metres.
class Joiner {
 public:
  Joiner(const glm::dvec3& place, double heading) : place_(place), heading_(heading) {}

  void Add(const glm::dvec3& low, const glm::dvec3& high, const SurfacePaint& paint) {
    const glm::dvec3 middle = 0.5 * (low + high);
    const double sine = std::sin(heading_), cosine = std::cos(heading_);
    const glm::dvec3 turned(cosine * middle.x + sine * middle.z, middle.y, cosine * middle.z - sine * middle.x);
    boxes_.push_back({place_ + turned, 0.5 * (high - low), heading_, paint});
  }

  std::vector<FurnitureBox> Take() && { return std::move(boxes_); }

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

void AddLegs(Joiner& joiner, double half_x, double z_near, double z_far, double height, double half_leg,
             const SurfacePaint& paint) {
  for (const double x : {-half_x, half_x}) {
    for (const double z : {z_near, z_far}) {
      joiner.Add({x - half_leg, 0, z - half_leg}, {x + half_leg, height, z + half_leg}, paint);
    }
  }
}

}  // namespace

std::vector<FurnitureBox> MakeCupboard(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.4, 0.65), height = random.Uniform(0.9, 2.05), deep = random.Uniform(0.36, 0.48);
  const SurfacePaint wood = DrawWood(random, share), doors = DrawWood(random, share);
  Joiner joiner(place, heading);
  joiner.Add({-half, 0.06, 0.01}, {half, height, deep}, wood);
  joiner.Add({-half + 0.03, 0.10, deep}, {-0.01, height - 0.04, deep + 0.015}, doors);
  joiner.Add({0.01, 0.10, deep}, {half - 0.03, height - 0.04, deep + 0.015}, doors);
  joiner.Add({-half + 0.04, 0, 0.03}, {half - 0.04, 0.06, deep - 0.04}, Darker(wood));
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakeShelf(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.4, 0.6), height = random.Uniform(1.4, 2.1), deep = random.Uniform(0.26, 0.34);
  const SurfacePaint wood = DrawWood(random, share);
  Joiner joiner(place, heading);
  joiner.Add({-half, 0, 0.01}, {-half + 0.03, height, deep}, wood);
  joiner.Add({half - 0.03, 0, 0.01}, {half, height, deep}, wood);
  joiner.Add({-half, 0, 0.005}, {half, height, 0.02}, Darker(wood));
  constexpr int kBoards = 4;
  for (int i = 0; i <= kBoards; ++i) {
    const double y = (height - 0.03) * i / kBoards;
    joiner.Add({-half, y, 0.01}, {half, y + 0.03, deep}, wood);
    const double left = random.Uniform(-half + 0.05, -0.1), right = random.Uniform(0.0, half - 0.05);
    const double tall = random.Uniform(0.5, 0.85) * (height / kBoards - 0.03);
    const Hsv one = DrawMixed(random, share), two = DrawMixed(random, share);
    const SurfacePaint books{.first = ToRgb(one), .second = ToRgb(two), .pattern = Pattern::kPatchwork, .size = 0.045};
    if (i < kBoards) joiner.Add({left, y + 0.03, 0.03}, {right, y + 0.03 + tall, deep - 0.05}, books);
  }
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakeSofa(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.7, 0.88), seat = random.Uniform(0.38, 0.46), back = random.Uniform(0.75, 0.9);
  const SurfacePaint fabric = DrawFabric(random, share), cushion = DrawFabric(random, share);
  Joiner joiner(place, heading);
  joiner.Add({-half, 0.06, 0.03}, {half, seat, 0.82}, fabric);
  joiner.Add({-half, seat, 0.03}, {half, back, 0.24}, fabric);
  joiner.Add({-half - 0.12, 0.04, 0.03}, {-half, seat + 0.2, 0.84}, Darker(fabric));
  joiner.Add({half, 0.04, 0.03}, {half + 0.12, seat + 0.2, 0.84}, Darker(fabric));
  joiner.Add({-half + 0.08, seat, 0.24}, {-half + 0.48, seat + 0.36, 0.36}, cushion);
  joiner.Add({half - 0.46, seat, 0.24}, {half - 0.06, seat + 0.34, 0.36}, cushion);
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakeTable(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.5, 0.75), height = random.Uniform(0.68, 0.76), deep = random.Uniform(0.6, 0.8);
  const SurfacePaint wood = DrawWood(random, share);
  Joiner joiner(place, heading);
  joiner.Add({-half, height - 0.04, 0.05}, {half, height, 0.05 + deep}, wood);
  AddLegs(joiner, half - 0.06, 0.1, deep, height - 0.04, 0.025, Darker(wood));
  const double x = random.Uniform(-half + 0.2, half - 0.2);
  const SurfacePaint things = DrawFabric(random, share);
  joiner.Add({x - 0.12, height, 0.2}, {x + 0.12, height + random.Uniform(0.1, 0.28), 0.4}, things);
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakeScreen(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.5, 0.7), low = random.Uniform(0.42, 0.55), wide = random.Uniform(0.42, 0.58);
  const SurfacePaint wood = DrawWood(random, share);
  Joiner joiner(place, heading);
  joiner.Add({-half, 0.05, 0.02}, {half, low, 0.4}, wood);
  joiner.Add({-0.12, low, 0.16}, {0.12, low + 0.05, 0.28}, Darker(wood));
  const SurfacePaint black{.first = {34, 34, 38}, .second = {34, 34, 38}};
  joiner.Add({-wide, low + 0.05, 0.19}, {wide, low + 0.05 + 1.15 * wide, 0.24}, black);
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakePlantPot(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.13, 0.2), height = random.Uniform(0.25, 0.42), out = random.Uniform(0.35, 0.5);
  const SurfacePaint pot = WithGrain(DrawMixed(random, share), Pattern::kPlain, 0.1);
  Joiner joiner(place, heading);
  joiner.Add({-half, 0, out - half}, {half, height, out + half}, pot);
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakePile(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  Joiner joiner(place, heading);
  double y = 0, half = random.Uniform(0.26, 0.36);
  for (int i = 0; i < 3; ++i) {
    const double height = random.Uniform(0.2, 0.36), x = random.Uniform(-0.08, 0.08);
    const double grain = random.Uniform(-0.05, 0.05);
    const SurfacePaint board = WithGrain(DrawMixed(random, share), Pattern::kTwoTone, grain);
    joiner.Add({x - half, y, 0.05}, {x + half, y + height, 0.05 + 1.5 * half}, board);
    y += height;
    half *= random.Uniform(0.7, 0.95);
  }
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakeChair(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.19, 0.23), seat = random.Uniform(0.43, 0.48), back = random.Uniform(0.82, 0.95);
  const SurfacePaint wood = DrawWood(random, share), cover = DrawFabric(random, share);
  Joiner joiner(place, heading);
  joiner.Add({-half, seat - 0.05, -half}, {half, seat, half}, cover);
  AddLegs(joiner, half - 0.02, -half + 0.02, half - 0.02, seat - 0.05, 0.018, wood);
  joiner.Add({-half, seat, -half}, {-half + 0.03, back, -half + 0.03}, wood);
  joiner.Add({half - 0.03, seat, -half}, {half, back, -half + 0.03}, wood);
  joiner.Add({-half, back - 0.2, -half}, {half, back, -half + 0.025}, wood);
  return std::move(joiner).Take();
}

std::vector<FurnitureBox> MakeCrate(RandomStream& random, double share, const glm::dvec3& place, double heading) {
  const double half = random.Uniform(0.2, 0.32), height = random.Uniform(0.36, 0.6);
  const SurfacePaint wood = DrawWood(random, share);
  const double lid = random.Uniform(0.02, 0.05);
  Joiner joiner(place, heading);
  joiner.Add({-half, 0, -0.8 * half}, {half, height, 0.8 * half}, wood);
  joiner.Add({-half - 0.015, height, -0.8 * half - 0.015}, {half + 0.015, height + lid, 0.8 * half + 0.015},
             Darker(wood));
  return std::move(joiner).Take();
}

}  // namespace etude
