#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The faults that a person can make in one performance of a move.
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
/// Returns the name of a fault: "amplitude", "wrong_side", "wrong_move", "skipped", "late", "off_beat", "limb_missing",
/// "elbow_straight", "wrong_order", "stopped".
std::string_view FaultName(Fault fault);
/// Returns the names of AllFaults().
const std::vector<std::string>& FaultNameList();
/// Returns the fault of a name, or nothing where no fault has this name.
std::optional<Fault> FindFault(std::string_view name);
/// Returns "none", or the names of the faults joined by "+": "amplitude+late".
std::string FaultNames(const std::vector<GradedFault>& faults);

/// The stray of a performance: its distance from what the person meant, that is from the same person's own performance
/// of the move asked for, with the same habits and the same luck, but without a fault. No other person's motion, no
/// taught clip and no recogniser has a part in it.
struct Stray {
  /// The angle between the direction of the worst limb as danced and as meant, root mean square over the performance,
  /// degrees. Compared at equal shares of the performance, whatever the clock says.
  double limb_deg = 0;
  /// The distance of the performance from its clock, ahead or behind: root mean square over its time, beats.
  double timing_beats = 0;
};

/// The truth about a performance.
enum class Truth {
  kRight,
  kGrey,  ///< neither: reported apart, no method gains or loses by it
  kWrong,
};
/// Returns "right", "grey" or "wrong".
std::string_view TruthName(Truth truth);

/// The limits where right ends and where wrong begins (ours).
struct StrayLimits {
  Stray right{.limb_deg = 12, .timing_beats = 0.25};
  Stray wrong{.limb_deg = 25, .timing_beats = 0.5};
};

/// Returns right when both measures are within the first limits, wrong when one of them is beyond the second, else
/// grey.
Truth TruthOf(const Stray& stray, const StrayLimits& limits = {});

/// Measures `limb_deg` of a performance given by its pose at any share of it, as meant and as danced; from 32 shares.
double LimbStrayDeg(const std::function<BodyPose(double share)>& meant,
                    const std::function<BodyPose(double share)>& danced);
/// Measures `timing_beats` of a performance of so many beats from the shares that are meant and danced when the clock
/// is due at 0…1, clamped to the performance; from 64 moments.
double TimingStrayBeats(const std::function<double(double due)>& meant, const std::function<double(double due)>& danced,
                        double beats);

}  // namespace etude
