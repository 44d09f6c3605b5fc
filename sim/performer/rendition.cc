#include "sim/performer/rendition.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

/// The duration of a change between wrong and right, as a share of a performance.
constexpr double kChange = 0.25;

// The effects of faults at severity 1 (ours).
constexpr double kLostAmplitude = 0.8;
constexpr double kLateBeats = 1;
constexpr double kOffBeats = 1;            // largest shift before or after the beat, beats
constexpr double kMaxOffBeat = 0.7 / kPi;  // upper limit of the shift, share of the move: time never runs backwards
constexpr double kMinDancedShare = 0.35;   // share of the move that is danced before the person stops

/// Returns 1 while `share` is below `severity` and 0 while it is above, with a smooth change around `severity`.
double First(double share, double severity) {
  return 1 - Smootherstep((share - severity * (1 + kChange)) / kChange + 1);
}

/// Returns the controls of a leg, or of an arm.
std::span<const SideControl> ControlsOf(bool is_leg) {
  using enum SideControl;
  static constexpr std::array kArm = {kArmForward, kArmSide, kArmTwist, kElbow, kWrist};
  static constexpr std::array kLeg = {kLegFree,  kLegForward, kLegSide,  kLegTwist, kKnee,    kFootPoint,
                                      kFootSide, kFootAhead,  kFootLift, kFootHeel, kFootTurn};
  if (is_leg) return kLeg;
  return kArm;
}

struct LimbName {
  Side side;
  bool is_leg;
};

/// Returns the limb that `choice` in [0, 1) selects.
LimbName LimbOf(double choice) {
  constexpr std::array<LimbName, 4> kAllLimbs = {
      {{Side::kLeft, false}, {Side::kRight, false}, {Side::kLeft, true}, {Side::kRight, true}}};
  return kAllLimbs[static_cast<std::size_t>(choice * kAllLimbs.size())];
}

void LeaveOut(Controls& controls, const Controls& rest, const LimbName& limb, double severity) {
  for (SideControl control : ControlsOf(limb.is_leg)) {
    double& value = controls.Of(limb.side, control);
    value += severity * (rest.Of(limb.side, control) - value);
  }
}

SmoothOffsets DrawWays(const Person& person, std::uint64_t key) {
  constexpr double kOfStyle = 0.25;  // deviation between one person's performances ÷ deviation between people (ours)
  RandomStream random(WorldKey{.suite_seed = key, .scenario = "rendition"}, "ways");
  return {random, kOfStyle * person.looseness};
}

}  // namespace

Chance DrawChance(RandomStream& random, const Person& person) {
  const auto bounded = [&] { return std::clamp(random.Normal(), -2.5, 2.5); };
  Chance chance;
  chance.lag_s = std::max(0.0, person.lag_s + person.lag_spread_s * bounded());
  chance.tempo = person.tempo * std::exp(person.tempo_spread * bounded());
  chance.unevenness = person.drift * bounded();
  chance.ways = random.Bits();
  return chance;
}

Rendition::Rendition(const Style& meant, const Chance& chance, std::vector<GradedFault> faults, const Style* instead)
    : meant_(&meant),
      instead_(instead),
      chance_(chance),
      offsets_(DrawWays(meant.person(), chance.ways)),
      faults_(std::move(faults)) {
  assert(instead != nullptr || !Find(Fault::kWrongMove));
}

std::optional<GradedFault> Rendition::Find(Fault fault) const {
  const auto found = std::ranges::find(faults_, fault, &GradedFault::fault);
  return found != faults_.end() ? std::optional(*found) : std::nullopt;
}

Controls Rendition::Meant(double share, double vigour) const {
  return meant_->At(share * meant_->move().beats, vigour, offsets_);
}

Controls Rendition::Reordered(double share, double vigour) const {
  static constexpr std::array<int, 4> kOrder = {0, 2, 1, 3};
  static constexpr double kQuarter = 0.25, kBorderBlend = 0.22;
  const auto moved = [](std::size_t quarter) { return kQuarter * (kOrder[quarter] - static_cast<int>(quarter)); };
  // Near a border between two quarters, the dance continues both quarters and blends the earlier quarter into the later
  // quarter.
  const double border = std::clamp(std::round(share / kQuarter), 1.0, 3.0);
  const auto after = static_cast<std::size_t>(border), before = after - 1;
  const double over = Smootherstep((share - kQuarter * border) / kBorderBlend + 0.5);
  if (over <= 0) return Meant(share + moved(before), vigour);
  if (over >= 1) return Meant(share + moved(after), vigour);
  return Mix(Meant(share + moved(before), vigour), Meant(share + moved(after), vigour), over);
}

Controls Rendition::Danced(double share, double vigour) const {
  Controls danced = Meant(share, vigour);
  if (faults_.empty()) return danced;
  const Controls rest = RestOf(meant_->person());
  // Apply faults of content, in the first part of the performance.
  if (const auto order = Find(Fault::kWrongOrder)) {
    const double weight = First(share, order->severity);
    if (weight > 0) danced = Mix(danced, Reordered(share, vigour), weight);
  }
  if (const auto move = Find(Fault::kWrongMove)) {
    const double weight = First(share, move->severity);
    if (weight > 0) danced = Mix(danced, instead_->At(share * meant_->move().beats, vigour, offsets_), weight);
  }
  if (const auto side = Find(Fault::kWrongSide)) {
    danced = Mix(danced, Mirrored(danced), First(share, side->severity));
  }
  // Apply faults of execution, in the whole performance.
  if (const auto limb = Find(Fault::kLimbMissing)) LeaveOut(danced, rest, LimbOf(limb->choice), limb->severity);
  if (const auto elbow = Find(Fault::kElbowStraight)) {
    for (Side side : {Side::kLeft, Side::kRight}) danced.Of(side, SideControl::kElbow) *= 1 - elbow->severity;
  }
  if (const auto amplitude = Find(Fault::kAmplitude)) {
    danced = Exaggerated(danced, rest, 1 - kLostAmplitude * amplitude->severity);
  }
  return danced;
}

double Rendition::Presence(double share) const {
  double presence = 1;
  if (const auto skipped = Find(Fault::kSkipped)) presence *= 1 - First(share, skipped->severity);
  if (const auto stopped = Find(Fault::kStopped)) {
    const double stops = 1 - (1 - kMinDancedShare) * stopped->severity;
    presence *= 1 - Smootherstep((share - stops) / kChange);
  }
  return presence;
}

double Rendition::MeantShare(double due) const {
  if (due <= 0 || due >= 1) return due;
  return due + chance_.unevenness * std::sin(2 * kPi * due) / (2 * kPi);
}

double Rendition::Lateness() const {
  const auto late = Find(Fault::kLate);
  return late ? late->severity * kLateBeats / meant_->move().beats : 0;
}

double Rendition::DancedShare(double due) const {
  const double late = due - Lateness();
  double share = MeantShare(late);
  if (const auto off = Find(Fault::kOffBeat); off && late > 0 && late < 1) {
    const double most = std::min(kOffBeats / meant_->move().beats, kMaxOffBeat);
    share += (off->choice < 0.5 ? 1 : -1) * off->severity * most * std::sin(kPi * late);
  }
  return share;
}

double Rendition::DueOf(double share) const {
  double low = std::min(0.0, share), high = std::max(1.0, share) + Lateness();
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (DancedShare(middle) < share ? low : high) = middle;
  }
  return high;
}

PerformanceDeviation Rendition::Deviation() const {
  if (faults_.empty()) return {};
  const BodyDimensions& body = meant_->person().body;
  const Controls rest = RestOf(meant_->person());
  const auto meant = [&](double share) { return PoseOf(Meant(share), body); };
  const auto danced = [&](double share) { return PoseOf(Mix(rest, Danced(share), Presence(share)), body); };
  return {.limb_deg = LimbDeviationDeg(meant, danced),
          .timing_beats = TimingDeviationBeats([&](double due) { return MeantShare(due); },
                                               [&](double due) { return DancedShare(due); }, meant_->move().beats)};
}

bool CanShow(const GradedFault& fault, const Move& move, const Move* instead) {
  const Person taught;
  const Style style(taught, move), other(taught, instead != nullptr ? *instead : move);
  GradedFault worst = fault;
  worst.severity = 1;
  const Rendition rendition(style, {}, {worst}, &other);
  // If a move equals its own mirror image half a performance later, nobody can see kWrongSide.
  if (fault.fault == Fault::kWrongSide) {
    const auto shifted = [&](double share) { return PoseOf(rendition.Meant(share + 0.5)); };
    const auto mirrored = [&](double share) { return PoseOf(rendition.Danced(share)); };
    if (TruthOf({.limb_deg = LimbDeviationDeg(shifted, mirrored)}) != Truth::kWrong) return false;
  }
  return TruthOf(rendition.Deviation()) == Truth::kWrong;
}

ShowableFaults::ShowableFaults(std::span<const Move> moves) {
  const auto choices = [](Fault fault) -> std::vector<double> {
    if (fault == Fault::kLimbMissing) return {0.125, 0.375, 0.625, 0.875};
    if (fault == Fault::kOffBeat) return {0.25, 0.75};
    return {0};
  };
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const Move* instead = moves.size() > 1 ? &moves[(i + 1) % moves.size()] : nullptr;
    std::vector<GradedFault>& showable = faults_.emplace_back();
    for (Fault fault : AllFaults()) {
      if (fault == Fault::kWrongMove && instead == nullptr) continue;
      for (double choice : choices(fault)) {
        const GradedFault graded{fault, 1, choice};
        if (CanShow(graded, moves[i], instead)) showable.push_back(graded);
      }
    }
  }
}

}  // namespace etude
