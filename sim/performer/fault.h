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
  kAmplitude,      ///< the movements are smaller than meant
  kWrongSide,      ///< left and right exchanged; impossible for a move that is its own mirror image
  kWrongMove,      ///< another move is danced
  kSkipped,        ///< the person stands still instead
  kLate,           ///< the whole move is late
  kOffBeat,        ///< the person hurries or drags within the move, and is on time again at the move's end
  kLimbMissing,    ///< one limb stays at rest
  kElbowStraight,  ///< elbows that should bend stay straight
  kWrongOrder,     ///< the parts of the move are danced in another order
  kStopped,        ///< the person stops before the end
};

/// A fault and its severity: 0 changes nothing, and 1 is the fault's worst form. Faults of execution (amplitude, late,
/// off beat, limb missing, elbow straight) grow in magnitude. Faults of content affect a share of the performance that
/// grows with the severity: its beginning (side, move, skipped, order; afterwards the person dances correctly) or its
/// end (stopped).
struct GradedFault {
  Fault fault = Fault::kAmplitude;
  double severity = 1;  ///< severity in [0, 1]
  double choice = 0;    ///< number in [0, 1) that selects a variant of the fault, for example which limb
};

/// Returns all faults, in the order of the enum.
const std::vector<Fault>& AllFaults();
/// Returns the name of a fault: "amplitude", "wrong_side", "wrong_move", "skipped", "late", "off_beat", "limb_missing",
/// "elbow_straight", "wrong_order", "stopped".
std::string_view FaultName(Fault fault);
/// Returns the names of AllFaults().
const std::vector<std::string>& FaultNameList();
/// Returns the fault with this name; nullopt if the name is unknown.
std::optional<Fault> FindFault(std::string_view name);
/// Returns "none", or the names of the faults joined by "+": "amplitude+late".
std::string FaultNames(const std::vector<GradedFault>& faults);

/// The deviation of a performance from the intended performance, in which the same person performs the requested move
/// with the same habits and the same random variation, but without faults. This deviation does not depend on the motion
/// of other people, on taught clips, or on recognisers.
struct PerformanceDeviation {
  /// The largest error of a limb, degrees. A limb's error is the root mean square, over the performance, of the angle
  /// between the limb's danced direction and its meant direction. Poses are compared at equal shares of the
  /// performance, independently of timing.
  double limb_deg = 0;
  /// The difference between the danced and the meant timing: root mean square over the performance, beats.
  double timing_beats = 0;
};

/// The true judgement of a performance.
enum class Truth {
  kRight,
  kGrey,  ///< neither right nor wrong; reported separately and not scored
  kWrong,
};
/// Returns "right", "grey" or "wrong".
std::string_view TruthName(Truth truth);

/// The limits of a deviation. A performance is right up to `right`, wrong above `wrong`, and grey between them (ours).
struct DeviationLimits {
  PerformanceDeviation right{.limb_deg = 12, .timing_beats = 0.25};
  PerformanceDeviation wrong{.limb_deg = 25, .timing_beats = 0.5};
};

/// Returns kRight if both measures of the deviation are within `limits.right`, kWrong if at least one exceeds its value
/// in `limits.wrong`, and kGrey otherwise.
Truth TruthOf(const PerformanceDeviation& deviation, const DeviationLimits& limits = {});

/// Computes `PerformanceDeviation::limb_deg` by comparing the meant and the danced pose at 32 shares of the
/// performance.
double LimbDeviationDeg(const std::function<BodyPose(double share)>& meant,
                        const std::function<BodyPose(double share)>& danced);
/// Computes `PerformanceDeviation::timing_beats`; the performance lasts `beats` beats. Each function maps a time, in
/// [0, 1] of the performance's length, to the share of the performance that is reached at that time, clamped to [0, 1].
/// Both functions are sampled at 64 times.
double TimingDeviationBeats(const std::function<double(double due)>& meant,
                            const std::function<double(double due)>& danced, double beats);

}  // namespace etude
