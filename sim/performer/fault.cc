#include "sim/performer/fault.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/named.h"

namespace etude {
namespace {

constexpr std::array<Named<Fault>, 10> kFaults = {{{"amplitude", Fault::kAmplitude},
                                                   {"wrong_side", Fault::kWrongSide},
                                                   {"wrong_move", Fault::kWrongMove},
                                                   {"skipped", Fault::kSkipped},
                                                   {"late", Fault::kLate},
                                                   {"off_beat", Fault::kOffBeat},
                                                   {"limb_missing", Fault::kLimbMissing},
                                                   {"elbow_straight", Fault::kElbowStraight},
                                                   {"wrong_order", Fault::kWrongOrder},
                                                   {"stopped", Fault::kStopped}}};

using enum Role;

/// The number of compared limb directions: trunk, shoulder line, upper arms, forearms, thighs and shanks.
constexpr std::size_t kStrayLimbs = 10;

/// Returns the centre of part i, if [0, 1] is divided into `count` equal parts.
double MiddleOf(int i, int count) { return (i + 0.5) / count; }

/// Returns the unit directions of the compared limbs in the frame of `pose`, which faces +Z if the person faces the
/// coach. A limb of length zero has a zero direction, whose angle to any other direction is 0.
std::array<glm::dvec3, kStrayLimbs> LimbDirections(const BodyPose& pose) {
  std::array<glm::dvec3, kStrayLimbs> directions{};
  std::size_t i = 0;
  const auto add = [&](const Bone& bone) {
    const glm::dvec3 limb = pose[bone.child] - pose[bone.parent];
    const double length = glm::length(limb);
    if (length > 0) directions[i] = limb / length;
    ++i;
  };
  add({kHipCentre, kShoulderCentre});
  add({kRightShoulder, kLeftShoulder});
  for (const Bone& bone : ArmAndLegBones()) add(bone);
  return directions;
}

}  // namespace

const std::vector<Fault>& AllFaults() {
  static const std::vector<Fault> faults = [] {
    std::vector<Fault> all;
    for (const Named<Fault>& row : kFaults) all.push_back(row.value);
    return all;
  }();
  return faults;
}

std::string_view FaultName(Fault fault) { return kFaults[static_cast<std::size_t>(fault)].name; }

const std::vector<std::string>& FaultNameList() {
  static const std::vector<std::string> names = NamesOf(kFaults);
  return names;
}

std::optional<Fault> FindFault(std::string_view name) { return FindValue(kFaults, name); }

std::string FaultNames(const std::vector<GradedFault>& faults) {
  std::string names;
  for (const GradedFault& graded : faults) {
    if (!names.empty()) names += '+';
    names += FaultName(graded.fault);
  }
  return names.empty() ? "none" : names;
}

std::string_view TruthName(Truth truth) {
  constexpr std::array<std::string_view, 3> kNames = {"right", "grey", "wrong"};
  return kNames[static_cast<std::size_t>(truth)];
}

Truth TruthOf(const PerformanceDeviation& deviation, const DeviationLimits& limits) {
  const auto is_within = [&](const PerformanceDeviation& limit) {
    return deviation.limb_deg <= limit.limb_deg && deviation.timing_beats <= limit.timing_beats;
  };
  if (is_within(limits.right)) return Truth::kRight;
  return is_within(limits.wrong) ? Truth::kGrey : Truth::kWrong;
}

double LimbDeviationDeg(const std::function<BodyPose(double share)>& meant,
                        const std::function<BodyPose(double share)>& danced) {
  constexpr int kShares = 32;
  std::array<double, kStrayLimbs> squares{};
  for (int k = 0; k < kShares; ++k) {
    const auto from = LimbDirections(meant(MiddleOf(k, kShares))), to = LimbDirections(danced(MiddleOf(k, kShares)));
    for (std::size_t i = 0; i < kStrayLimbs; ++i) {
      const double degrees = Degrees(AngleBetween(from[i], to[i]));
      squares[i] += degrees * degrees / kShares;
    }
  }
  return std::sqrt(*std::ranges::max_element(squares));
}

double TimingDeviationBeats(const std::function<double(double due)>& meant,
                            const std::function<double(double due)>& danced, double beats) {
  constexpr int kMoments = 64;
  double square = 0;
  for (int k = 0; k < kMoments; ++k) {
    const double due = MiddleOf(k, kMoments);
    const double off = std::clamp(danced(due), 0.0, 1.0) - std::clamp(meant(due), 0.0, 1.0);
    square += off * off / kMoments;
  }
  return beats * std::sqrt(square);
}

}  // namespace etude
