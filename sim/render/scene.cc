#include "sim/render/scene.h"

#include <algorithm>

namespace etude {
namespace {

bool Same(const FurnitureBox& a, const FurnitureBox& b) {
  return a.centre == b.centre && a.half_size == b.half_size && a.heading == b.heading && a.paint == b.paint;
}

bool Same(const WallPicture& a, const WallPicture& b) {
  return a.wall == b.wall && a.centre == b.centre && a.half_size == b.half_size && a.paint == b.paint &&
         a.frame == b.frame && a.glow == b.glow;
}

template <typename Thing>
bool Same(const std::vector<Thing>& a, const std::vector<Thing>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!Same(a[i], b[i])) return false;
  }
  return true;
}

struct Outfit {
  Rgb8 skin, top, trousers, shoes;
};

PartColours Dress(const Outfit& outfit) {
  PartColours colours{};
  const auto set = [&colours](Part part, Rgb8 colour) { colours[static_cast<std::size_t>(part)] = colour; };
  set(Part::kTrunk, outfit.top);
  set(Part::kHead, outfit.skin);
  set(Part::kLeftUpperArm, outfit.top);
  set(Part::kRightUpperArm, outfit.top);
  for (const Part part : {Part::kLeftForearm, Part::kLeftHand, Part::kRightForearm, Part::kRightHand}) {
    set(part, outfit.skin);
  }
  for (const Part part : {Part::kLeftThigh, Part::kLeftShank, Part::kRightThigh, Part::kRightShank}) {
    set(part, outfit.trousers);
  }
  set(Part::kLeftFoot, outfit.shoes);
  set(Part::kRightFoot, outfit.shoes);
  return colours;
}

}  // namespace

bool operator==(const Lights& a, const Lights& b) {
  return a.key == b.key && a.key_colour == b.key_colour && a.ambient_colour == b.ambient_colour && a.fill == b.fill &&
         a.fill_colour == b.fill_colour && a.window == b.window && a.window_colour == b.window_colour;
}

bool operator==(const Interior& a, const Interior& b) {
  return a.low == b.low && a.high == b.high && a.floor == b.floor && a.wall == b.wall && a.ceiling == b.ceiling &&
         a.skirting == b.skirting && a.studio == b.studio && a.rug == b.rug && a.rug_paint == b.rug_paint &&
         a.lights == b.lights && Same(a.furniture, b.furniture) && Same(a.pictures, b.pictures);
}

PixelRect Union(const PixelRect& a, const PixelRect& b) {
  if (a.IsEmpty() || b.IsEmpty()) return a.IsEmpty() ? b : a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

PartColours PerformerColours() {
  return Dress({.skin = {232, 168, 128}, .top = {230, 92, 66}, .trousers = {150, 46, 88}, .shoes = {240, 186, 76}});
}

Lights LightsOf(const Room& room) { return room.interior != nullptr ? room.interior->lights : Lights{.key = kLamp}; }

}  // namespace etude
