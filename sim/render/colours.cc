#include "sim/render/renderer.h"

namespace etude {
namespace {

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

PartColours PerformerColours() {
  return Dress({.skin = {232, 168, 128}, .top = {230, 92, 66}, .trousers = {150, 46, 88}, .shoes = {240, 186, 76}});
}

}  // namespace etude
