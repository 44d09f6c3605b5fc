#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// What a person can do wrong in one performance of a move.
enum class Fault {
  kAmplitude,      ///< smaller than meant
  kWrongSide,      ///< left and right exchanged; only moves that are not their own mirror image
  kWrongMove,      ///< another move
  kSkipped,        ///< stands and waits
  kLate,           ///< the whole move after its time
  kOffBeat,        ///< hurries or drags on the way and is in time again at the end
  kLimbMissing,    ///< one limb does not take part
  kElbowStraight,  ///< elbows that should bend do not
  kWrongOrder,     ///< the parts of the move in another order
  kStopped,        ///< stops half-way
};

/// A fault and how bad it is: 0 changes nothing, 1 is as bad as this fault gets. A fault of how (amplitude, late, off
/// the beat, limb missing, elbow straight) grows in depth; a fault of what (side, move, skipped, order, stopped) takes
/// a growing share of the performance, after which the person notices and does it right.
struct GradedFault {
  Fault fault = Fault::kAmplitude;
  double severity = 1;  ///< in [0, 1]
  double choice = 0;    ///< in [0, 1), settles what the fault leaves open: which limb, whether it hurries or drags
};

/// All faults, in the order of the enum.
const std::vector<Fault>& AllFaults();
/// "amplitude", "wrong_side", "wrong_move", "skipped", "late", "off_beat", "limb_missing", "elbow_straight",
/// "wrong_order", "stopped".
std::string_view FaultName(Fault fault);
/// The names of AllFaults().
const std::vector<std::string>& FaultNameList();
/// Nothing where no fault has this name.
std::optional<Fault> FindFault(std::string_view name);
/// "none", or the names joined by "+": "amplitude+late".
std::string FaultNames(const std::vector<GradedFault>& faults);

}  // namespace etude
