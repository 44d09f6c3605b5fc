#include "sim/performer/style.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using enum MiddleControl;
using enum SideControl;

/// The standard deviation of a control's offsets (for offsets of size 1), and the control's range. Ranges are an
/// adult's (paper B, table 3.1); they are reduced where a limb would touch the trunk.
struct ControlSpan {
  double spread, lower, upper;
};

constexpr ControlSpan InDegrees(double spread, double lower, double upper) {
  return {Radians(spread), Radians(lower), Radians(upper)};
}

// The spans in the order of the controls. Columns: standard deviation, lower end, upper end; in metres, or in degrees
// if so marked.
constexpr std::array<ControlSpan, kMiddleControlCount> kMiddleSpans = {{
    {0.015, -0.2, 0.2},     // kHipsSide
    {0.01, -0.16, 0.1},     // kHipsAhead
    {0.015, -0.06, 0.3},    // kHipsDrop
    InDegrees(4, -25, 25),  // kHipsTurn
    InDegrees(2, -22, 22),  // kHipsTilt
    {0, 0, 1},              // kJump
    InDegrees(6, -15, 95),  // kTrunkBend
    InDegrees(4, -33, 33),  // kTrunkSide
    InDegrees(6, -40, 40),  // kTrunkTurn
    InDegrees(6, -35, 35),  // kNeckBend
    InDegrees(4, -30, 30),  // kNeckSide
    InDegrees(6, -50, 50),  // kNeckTurn
}};
constexpr std::array<ControlSpan, kSideControlCount> kSideSpans = {{
    InDegrees(15, -40, 170),  // kArmForward
    InDegrees(14, -20, 80),   // kArmSide
    InDegrees(16, -60, 60),   // kArmTwist
    InDegrees(17, 0, 140),    // kElbow
    InDegrees(10, -50, 60),   // kWrist
    {0, 0, 1},                // kLegFree
    InDegrees(8, -20, 100),   // kLegForward
    InDegrees(5, -10, 45),    // kLegSide
    InDegrees(5, -30, 35),    // kLegTwist
    InDegrees(10, 0, 125),    // kKnee
    InDegrees(6, -15, 45),    // kFootPoint
    {0.01, -0.05, 0.3},       // kFootSide
    {0.01, -0.15, 0.15},      // kFootAhead
    {0, 0, 0.3},              // kFootLift
    InDegrees(0, 0, 40),      // kFootHeel
    InDegrees(3, -15, 30),    // kFootTurn
}};

/// Returns the spans of all controls, in order.
const std::array<ControlSpan, kControlCount>& Spans() {
  static const std::array<ControlSpan, kControlCount> spans = [] {
    std::array<ControlSpan, kControlCount> all{};
    std::ranges::copy(kMiddleSpans, all.begin());
    for (Side side : {Side::kLeft, Side::kRight}) {
      for (std::size_t i = 0; i < kSideControlCount; ++i) {
        all[Controls::SideIndex(side, static_cast<SideControl>(i))] = kSideSpans[i];
      }
    }
    return all;
  }();
  return spans;
}

bool IsSpot(SideControl control) { return control == kFootSide || control == kFootAhead || control == kFootTurn; }

/// Returns true only for kLegFree, which is 0 or 1 and never scaled or offset.
bool IsSwitch(std::size_t control) {
  return control == Controls::SideIndex(Side::kLeft, kLegFree) ||
         control == Controls::SideIndex(Side::kRight, kLegFree);
}

/// The weights of an offset's terms: the constant, then the cosine and sine of three harmonics. The squares sum to
/// .978, so the constant has nearly half of the variance.
constexpr std::array<double, 7> kTermShares = {0.66, 0.38, 0.38, 0.28, 0.28, 0.22, 0.22};

/// For each term, draws a standard normal number, clamped to ±2.5, and multiplies it by the term's weight.
std::array<double, 7> DrawTerms(RandomStream& random) {
  std::array<double, 7> terms{};
  for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = kTermShares[i] * std::clamp(random.Normal(), -2.5, 2.5);
  return terms;
}

/// Returns a deviation limited to `room`: small deviations hardly change, and large deviations approach `room`.
double Saturated(double deviation, double room) {
  if (room <= 0) return 0;
  return room * (1 - std::exp(-deviation / room));
}

}  // namespace

SmoothOffsets::SmoothOffsets(RandomStream& random, double size) {
  for (std::size_t i = 0; i < kMiddleControlCount; ++i) {
    terms_[i] = DrawTerms(random);
    for (double& term : terms_[i]) term *= size * Spans()[i].spread;
  }
  // The offset of a control is the sum of two parts: one is the same for both sides, and the other is drawn for each
  // side. These are the weights of the parts. The squares of the weights sum to one.
  constexpr double kCommon = 0.8, kAlone = 0.6;
  for (std::size_t i = 0; i < kSideControlCount; ++i) {
    const auto control = static_cast<SideControl>(i);
    const auto common = DrawTerms(random);
    for (Side side : {Side::kLeft, Side::kRight}) {
      const auto alone = DrawTerms(random);
      const std::size_t index = Controls::SideIndex(side, control);
      for (std::size_t k = 0; k < kTerms; ++k) {
        const bool moves = k > 0 && IsSpot(control);  // a standing foot must not slide, so its offset is constant
        terms_[index][k] = moves ? 0 : size * Spans()[index].spread * (kCommon * common[k] + kAlone * alone[k]);
      }
    }
  }
}

Controls SmoothOffsets::At(double share) const {
  const double angle = 2 * kPi * share, c = std::cos(angle), s = std::sin(angle);
  const double c2 = c * c - s * s, s2 = 2 * c * s;
  const std::array<double, kTerms> waves = {1, c, s, c2, s2, c * c2 - s * s2, s * c2 + c * s2};
  Controls offsets;
  for (std::size_t i = 0; i < kControlCount; ++i) {
    for (std::size_t k = 0; k < kTerms; ++k) offsets.values[i] += terms_[i][k] * waves[k];
  }
  return offsets;
}

Style::Style(const Person& person, const Move& move) : person_(person), move_(move) {
  RandomStream random(WorldKey{.suite_seed = person.style, .scenario = "style"}, move.name);
  offsets_ = SmoothOffsets(random, person.looseness);
  for (double& share : rhythm_) share = 0.02 * person.looseness * std::clamp(random.Normal(), -2.0, 2.0);
}

// Sample the choreography at the beat that the person's own rhythm has reached.
Controls Style::At(double beat, double vigour, const SmoothOffsets& chance) const {
  const double share = beat / move_.beats, angle = 2 * kPi * share;
  const double own_beat = beat + move_.beats * (rhythm_[0] * std::sin(angle) + 0.5 * rhythm_[1] * std::sin(2 * angle));
  const Controls authored = move_.curves.At(own_beat), ready = ReadyStance();
  const Controls own = offsets_.At(share), chance_offsets = chance.At(share);
  // Scale the controls about the ready stance, and add posture and offsets.
  Controls danced;
  for (std::size_t i = 0; i < kControlCount; ++i) {
    const double reach = person_.amplitude * vigour * person_.gains[i];
    danced.values[i] = ready.values[i] + reach * (authored.values[i] - ready.values[i]) + person_.posture.values[i] +
                       own.values[i] + chance_offsets.values[i];
  }
  return WithinReach(danced, authored);
}

Controls RestOf(const Person& person) {
  Controls rest = ReadyStance();
  for (std::size_t i = 0; i < kControlCount; ++i) rest.values[i] += person.posture.values[i];
  return WithinReach(rest, ReadyStance());
}

Controls WithinReach(const Controls& wanted, const Controls& authored) {
  // Limit every control to the range of the joint.
  Controls within;
  for (std::size_t i = 0; i < kControlCount; ++i) {
    const double from = authored.values[i], deviation = wanted.values[i] - from;
    const ControlSpan& span = Spans()[i];
    within.values[i] = IsSwitch(i)      ? from
                       : deviation >= 0 ? from + Saturated(deviation, span.upper - from)
                                        : from - Saturated(-deviation, from - span.lower);
  }
  // Keep a hanging arm outside the trunk.
  for (Side side : {Side::kLeft, Side::kRight}) {
    const double raised = Smoothstep(Radians(25), Radians(60), within.Of(side, kArmForward));
    const double from = authored.Of(side, kArmSide), deviation = within.Of(side, kArmSide) - from;
    const double lower = Radians(5) - raised * Radians(25);
    if (deviation < 0) within.Of(side, kArmSide) = from - Saturated(-deviation, from - lower);
  }
  return within;
}

Sway::Sway(RandomStream& random) {
  for (double& phase : phases_) phase = random.Uniform(0, 2 * kPi);
}

Controls Sway::At(double time_s) const {
  const auto wave = [&](std::size_t i, double period_s) { return std::sin(2 * kPi * time_s / period_s + phases_[i]); };
  const double weight = wave(0, 5.3), breath = wave(2, 3.4), arms = wave(4, 4.7);
  Controls sway;
  sway[MiddleControl::kHipsSide] = 0.018 * weight;
  sway[MiddleControl::kHipsAhead] = 0.008 * wave(1, 3.9);
  sway[MiddleControl::kTrunkSide] = Radians(1.5) * weight;
  sway[MiddleControl::kTrunkBend] = Radians(0.8) * breath;
  sway[MiddleControl::kNeckTurn] = Radians(6) * wave(3, 7.1);
  for (Side side : {Side::kLeft, Side::kRight}) {
    sway.Of(side, SideControl::kArmSide) = Radians(1) * breath;
    sway.Of(side, SideControl::kArmForward) = Radians(2) * arms;
  }
  return sway;
}

}  // namespace etude
