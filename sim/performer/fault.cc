#include "sim/performer/fault.h"

#include <array>

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

}  // namespace etude
