#include "bench/tasks/pose_distance/blind_spots.h"

#include <initializer_list>
#include <vector>

#include "engine/base/angles.h"

namespace etude {
namespace {

using enum SideControl;

struct Setting {
  SideControl control;
  double degrees;
};

/// The standing body with its right limbs as said.
Controls Right(std::initializer_list<Setting> settings) {
  Controls controls;
  for (const Setting& setting : settings) controls.Of(Side::kRight, setting.control) = Radians(setting.degrees);
  return controls;
}

/// Likewise, on the left leg: the right one is free.
Controls RightLeg(std::initializer_list<Setting> settings) {
  Controls controls = Right(settings);
  controls.Of(Side::kRight, kLegFree) = 1;
  return controls;
}

Controls BothArms(SideControl control, double degrees) {
  Controls controls = Right({{control, degrees}});
  controls.Of(Side::kLeft, control) = Radians(degrees);
  return controls;
}

Controls Twisted(double degrees) {
  Controls controls;
  controls[MiddleControl::kTrunkTurn] = Radians(degrees);
  return controls;
}

std::vector<BlindSpot> MakeBlindSpots() {
  return {
      {"arm forward or sideways", Right({{kArmForward, 90}}), Right({{kArmSide, 90}})},
      {"both arms forward or T", BothArms(kArmForward, 90), BothArms(kArmSide, 90)},
      {"elbow at 90°, hand up or down", Right({{kArmForward, 90}, {kElbow, 90}}),
       Right({{kArmForward, 90}, {kArmTwist, 180}, {kElbow, 90}})},
      {"straight leg at 40°, front or side", RightLeg({{kLegForward, 40}}), RightLeg({{kLegSide, 40}})},
      {"straight leg at 40° or 90°", RightLeg({{kLegForward, 40}}), RightLeg({{kLegForward, 90}})},
      {"knee bent by 90° or 120°", RightLeg({{kKnee, 90}}), RightLeg({{kKnee, 120}})},
      {"arm hanging or at 20°", Controls{}, Right({{kArmForward, 20}})},
      {"trunk twisted by 60°", Controls{}, Twisted(60)},
  };
}

}  // namespace

std::span<const BlindSpot> BlindSpots() {
  static const std::vector<BlindSpot> spots = MakeBlindSpots();
  return spots;
}

}  // namespace etude
