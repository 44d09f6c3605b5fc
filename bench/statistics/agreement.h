#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/joint_angles.h"
#include "bench/model/run_data.h"
#include "bench/statistics/interval.h"

namespace etude {

/// A figure with its 95 % confidence interval, which is computed by resampling units.
struct AgreementFigure {
  std::optional<double> value;
  std::optional<Interval> interval;  ///< nullopt if there are fewer than kMinSample units
};

/// The agreement of two measurements of one quantity over several pairs of curves, in the quantity's unit.
struct CurveAgreement {
  int units = 0;  ///< number of people, or of pairs of curves
  AgreementFigure rmse, bias;
  AgreementFigure low, high;  ///< 95 % limits of agreement; at least two units are needed
  AgreementFigure icc;        ///< intraclass correlation ICC(A,1)
};

/// Measures the agreement over pairs of curves. `units` names the unit to which each pair belongs. RMSE, bias and
/// ICC(A,1) are computed over all frames together. The limits of agreement are those for repeated measures with a
/// varying true value (Bland and Altman 2007, section 3): a one-way analysis of variance of the differences by unit
/// gives the variance within units and the variance between units, with frames as the replicates. The sum of the two
/// is the variance of a single new difference. Intervals are BCa intervals of units drawn with replacement, from a
/// random stream keyed by `seed` and `purpose`.
CurveAgreement MeasureAgreement(std::span<const AgreementSums> pairs, std::span<const std::string> units,
                                std::uint64_t seed, const std::string& purpose);

/// The agreement of one angle under one condition of a scenario, for one method.
struct AngleAgreement {
  std::vector<SweptValue> condition;
  std::string method, angle;
  CurveAgreement agreement;
};

/// Measures the agreement of every angle of a run. The cells store an angle's sums (AgreementSums) as a series with the
/// axis kAgreementAxis. The angles are in the order of the cells.
std::vector<AngleAgreement> AgreementByAngle(const RunData& run);

}  // namespace etude
