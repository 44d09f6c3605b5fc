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

/// A figure with its 95 % interval over units.
struct AgreementFigure {
  std::optional<double> value;
  std::optional<Interval> interval;  ///< nothing: fewer than kMinSample units
};

/// How well two measurements of one quantity agree over several pairs of curves, in the quantity's unit.
struct CurveAgreement {
  int units = 0;  ///< people, or pairs
  AgreementFigure rmse, bias;
  AgreementFigure low, high;  ///< 95 % limits of agreement; they need two units
  AgreementFigure icc;        ///< ICC(A,1)
};

/// Measures the agreement over pairs; `units` names the unit to which each pair belongs. RMSE, bias and ICC(A,1) are
/// those of all frames together. The limits are those for repeated measures where the true value varies (Bland and
/// Altman 2007, section 3): a one-way analysis of variance of the differences by unit gives the variance within a unit
/// and that between units, whose sum is that of one more difference; a frame is a replicate. Intervals are BCa
/// intervals of units drawn with replacement, from a stream keyed by `seed` and `purpose`.
CurveAgreement MeasureAgreement(std::span<const AgreementSums> pairs, std::span<const std::string> units,
                                std::uint64_t seed, const std::string& purpose);

/// The agreement of one angle under one condition of a scenario, for one method.
struct AngleAgreement {
  std::vector<SweptValue> condition;
  std::string method, angle;
  CurveAgreement agreement;
};

/// Measures all angles of which a run's cells keep sums (kAgreementAxis), in the order of the cells.
std::vector<AngleAgreement> AgreementByAngle(const RunData& run);

}  // namespace etude
