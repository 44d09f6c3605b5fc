#include "sim/choreography/controls.h"

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kDegree = kPi / 180.0;
constexpr double kCentimetre = 0.01;

constexpr std::array<ControlName, kMiddleControlCount> kMiddleNames = {{
    {"hips", "side_cm", kCentimetre},
    {"hips", "ahead_cm", kCentimetre},
    {"hips", "drop_cm", kCentimetre},
    {"hips", "turn", kDegree},
    {"hips", "tilt", kDegree},
    {"jump_cm", "", kCentimetre},
    {"trunk", "bend", kDegree},
    {"trunk", "side", kDegree},
    {"trunk", "turn", kDegree},
    {"neck", "bend", kDegree},
    {"neck", "side", kDegree},
    {"neck", "turn", kDegree},
}};

constexpr std::array<ControlName, kSideControlCount> kSideNames = {{
    {"arm", "forward", kDegree},
    {"arm", "side", kDegree},
    {"arm", "twist", kDegree},
    {"elbow", "", kDegree},
    {"wrist", "", kDegree},
    {"", "", 1},
    {"leg", "forward", kDegree},
    {"leg", "side", kDegree},
    {"leg", "twist", kDegree},
    {"knee", "", kDegree},
    {"foot", "point", kDegree},
    {"foot", "side_cm", kCentimetre},
    {"foot", "ahead_cm", kCentimetre},
    {"foot", "lift_cm", kCentimetre},
    {"foot", "heel", kDegree},
    {"foot", "turn", kDegree},
}};

constexpr std::array kChangesSignInTheMirror = {
    MiddleControl::kHipsSide,  MiddleControl::kHipsTurn, MiddleControl::kHipsTilt, MiddleControl::kTrunkSide,
    MiddleControl::kTrunkTurn, MiddleControl::kNeckSide, MiddleControl::kNeckTurn};

}  // namespace

std::span<const ControlName, kMiddleControlCount> MiddleControlNames() { return kMiddleNames; }
std::span<const ControlName, kSideControlCount> SideControlNames() { return kSideNames; }

Controls Mirrored(const Controls& controls) {
  Controls mirrored = controls;
  for (MiddleControl control : kChangesSignInTheMirror) mirrored[control] = -controls[control];
  for (std::size_t i = 0; i < kSideControlCount; ++i) {
    const auto control = static_cast<SideControl>(i);
    mirrored.Of(Side::kLeft, control) = controls.Of(Side::kRight, control);
    mirrored.Of(Side::kRight, control) = controls.Of(Side::kLeft, control);
  }
  return mirrored;
}

Controls Sum(const Controls& a, const Controls& b) {
  Controls sum;
  for (std::size_t i = 0; i < kControlCount; ++i) sum.values[i] = a.values[i] + b.values[i];
  return sum;
}

Controls Mix(const Controls& from, const Controls& to, double share) {
  Controls mixed;
  for (std::size_t i = 0; i < kControlCount; ++i) {
    mixed.values[i] = (1.0 - share) * from.values[i] + share * to.values[i];
  }
  return mixed;
}

Controls Exaggerated(const Controls& controls, const Controls& centre, double factor) {
  Controls scaled = Mix(centre, controls, factor);
  for (Side side : {Side::kLeft, Side::kRight}) {
    scaled.Of(side, SideControl::kLegFree) = controls.Of(side, SideControl::kLegFree);
  }
  return scaled;
}

}  // namespace etude
