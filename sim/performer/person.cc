#include "sim/performer/person.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// The numbers of one preset, by which a person's traits are drawn. Fields named `spread` are standard deviations. The
/// numbers are ours, except for the statures of school children, which come from growth charts for six to fourteen
/// years.
struct Preset {
  double min_m, max_m;         // range of the stature, which is drawn uniformly
  double lag_s, lag_spread_s;  // mean delay over people; its spread between the performances of one person
  double tempo, tempo_spread;  // typical value of the tempo; spread of its logarithm between people
  double own_tempo_spread, drift;
  double amplitude, amplitude_spread;
  double lower, lower_spread;  // gain of hips, trunk and legs relative to the arms' gain
  double gain_spread;          // spread of the logarithm of each gain
  double asymmetry;            // spread of the logarithm of the ratio of left to right
  double looseness;
  double tiring;
};

constexpr Preset kPresets[] = {
    {},  // mixed: another preset is drawn instead
    {1.00, 1.10, 0.55, 0.18, 0.85, 0.25, 0.14, 0.10, 0.72, 0.14, 0.70, 0.25, 0.30, 0.12, 1.55, 0.10},
    {1.10, 1.60, 0.32, 0.10, 0.92, 0.24, 0.10, 0.06, 0.82, 0.13, 0.75, 0.25, 0.26, 0.08, 1.35, 0.05},
    {1.50, 1.90, 0.24, 0.07, 0.95, 0.24, 0.08, 0.05, 0.84, 0.13, 0.70, 0.25, 0.25, 0.07, 1.25, 0.03},
    {1.55, 1.85, 0.08, 0.02, 1.00, 0.04, 0.02, 0.01, 1.00, 0.03, 1.00, 0.03, 0.04, 0.02, 0.15, 0.005},
    {1.50, 1.90, 0.24, 0.07, 0.95, 0.24, 0.08, 0.05, 0.84, 0.13, 0.70, 0.25, 0.25, 0.07, 1.25, 0.03},
};

/// Returns how childlike the body proportions at a stature are: 1 at one metre, 0 from 1.65 m on.
double ChildhoodOf(People kind, double stature_m) {
  if (kind != People::kToddler && kind != People::kSchoolChild) return 0;
  return std::clamp((1.65 - stature_m) / 0.65, 0.0, 1.0);
}

/// Draws a standard normal number, clamped to ±2.5.
double Bounded(RandomStream& random) { return std::clamp(random.Normal(), -2.5, 2.5); }

/// Draws a person's posture as differences from the ready stance. The standard deviations below belong to looseness 1,
/// in radians and metres.
Controls DrawPosture(RandomStream& random, double looseness) {
  Controls posture;
  const auto middle = [&](MiddleControl control, double size) {
    posture[control] = looseness * size * Bounded(random);
  };
  const auto sides = [&](SideControl control, double size) {
    const double common = Bounded(random);
    for (Side side : {Side::kLeft, Side::kRight}) {
      posture.Of(side, control) = looseness * size * (0.9 * common + 0.4 * Bounded(random));
    }
  };
  middle(MiddleControl::kTrunkBend, Radians(4));
  middle(MiddleControl::kTrunkSide, Radians(1.5));
  middle(MiddleControl::kTrunkTurn, Radians(3));
  middle(MiddleControl::kNeckBend, Radians(6));
  middle(MiddleControl::kNeckTurn, Radians(4));
  sides(SideControl::kArmForward, Radians(4));
  sides(SideControl::kArmSide, Radians(4));
  sides(SideControl::kArmTwist, Radians(8));
  sides(SideControl::kElbow, Radians(7));
  sides(SideControl::kWrist, Radians(8));
  sides(SideControl::kFootSide, 0.02);
  sides(SideControl::kFootTurn, Radians(5));
  return posture;
}

bool IsOfTheArm(SideControl control) { return control <= SideControl::kWrist; }

std::array<double, kControlCount> DrawGains(RandomStream& random, const Preset& preset) {
  // Scale all controls of hips, trunk and legs by one factor, and multiply every control by a factor of its own.
  constexpr double kMinLower = 0.25;
  const double lower = std::max(kMinLower, preset.lower + preset.lower_spread * Bounded(random));
  constexpr double kMin = 0.65, kMax = 1.5;
  const auto own = [&] { return std::clamp(std::exp(preset.gain_spread * Bounded(random)), kMin, kMax); };
  std::array<double, kControlCount> gains{};
  for (std::size_t i = 0; i < kMiddleControlCount; ++i) gains[i] = lower * own();
  // Make one side stronger than the other: the ratio of left to right is the same in all controls.
  const double strong_left = std::exp(0.5 * preset.asymmetry * Bounded(random));
  for (std::size_t i = 0; i < kSideControlCount; ++i) {
    const auto control = static_cast<SideControl>(i);
    const double common = (IsOfTheArm(control) ? 1 : lower) * own();
    gains[Controls::SideIndex(Side::kLeft, control)] = common * strong_left;
    gains[Controls::SideIndex(Side::kRight, control)] = common / strong_left;
  }
  return gains;
}

}  // namespace

const std::vector<std::string>& PeopleNames() {
  static const std::vector<std::string> names = {"mixed", "toddler", "school-child", "adult", "expert", "absent"};
  return names;
}

People FindPeople(std::string_view name) {
  const auto found = std::ranges::find(PeopleNames(), name);
  assert(found != PeopleNames().end());
  return static_cast<People>(found - PeopleNames().begin());
}

People KindInMixture(double share) {
  if (share < 0.15) return People::kToddler;
  if (share < 0.50) return People::kSchoolChild;
  return share < 0.85 ? People::kAdult : People::kExpert;
}

Person DrawPerson(const WorldKey& key, People people) {
  RandomStream random(key, "person");
  const double kind = random.Uniform();
  Person person{.kind = people == People::kMixed ? KindInMixture(kind) : people};
  const Preset& preset = kPresets[static_cast<std::size_t>(person.kind)];
  person.stature_m = random.Uniform(preset.min_m, preset.max_m);
  person.body = DimensionsOf(person.stature_m, ChildhoodOf(person.kind, person.stature_m));
  person.place = {.yaw = Radians(8) * Bounded(random), .x = 0.12 * Bounded(random), .z = 0.12 * Bounded(random)};
  person.lag_s = preset.lag_s * std::exp(0.25 * Bounded(random));
  person.lag_spread_s = preset.lag_spread_s;
  person.tempo = preset.tempo * std::exp(preset.tempo_spread * Bounded(random));
  person.tempo_spread = preset.own_tempo_spread;
  person.drift = preset.drift;
  constexpr double kMinAmplitude = 0.55;  // lower limit of the amplitude for a person who takes part
  person.amplitude = std::max(kMinAmplitude, preset.amplitude + preset.amplitude_spread * Bounded(random));
  person.tiring = preset.tiring * std::exp(0.4 * Bounded(random));
  person.looseness = preset.looseness;
  person.gains = DrawGains(random, preset);
  person.posture = DrawPosture(random, preset.looseness);
  person.style = random.Bits();
  return person;
}

double VigourAfter(const Person& person, double danced_s) {
  constexpr double kMin = 0.6;
  return std::max(kMin, std::exp(-person.tiring * danced_s / 60));
}

BodyDimensions DimensionsOf(double stature_m, double childhood) {
  constexpr double kCanonicalStature = 1.7;
  /// The proportions of a four-year-old child, as shares of stature.
  constexpr BodyDimensions kChild = {.hip_half_width = 0.055,
                                     .thigh = 0.213,
                                     .shank = 0.211,
                                     .ankle_height = 0.041,
                                     .toe_height = 0.016,
                                     .foot_reach = 0.105,
                                     .spine = 0.132,
                                     .chest = 0.203,
                                     .shoulder_half_width = 0.108,
                                     .shoulder_fall = 0.016,
                                     .head_rise = 0.108,
                                     .upper_arm = 0.172,
                                     .forearm = 0.140,
                                     .hand = 0.108,
                                     .home_half_width = 0.075};
  // Interpolate every size, as a share of stature, between adult and child.
  const BodyDimensions adult;
  BodyDimensions body;
  for (double BodyDimensions::*size :
       {&BodyDimensions::hip_half_width, &BodyDimensions::thigh, &BodyDimensions::shank, &BodyDimensions::ankle_height,
        &BodyDimensions::toe_height, &BodyDimensions::foot_reach, &BodyDimensions::spine, &BodyDimensions::chest,
        &BodyDimensions::shoulder_half_width, &BodyDimensions::shoulder_fall, &BodyDimensions::head_rise,
        &BodyDimensions::upper_arm, &BodyDimensions::forearm, &BodyDimensions::hand,
        &BodyDimensions::home_half_width}) {
    const double share = adult.*size / kCanonicalStature;
    body.*size = stature_m * (share + childhood * (kChild.*size - share));
  }
  return body;
}

}  // namespace etude
