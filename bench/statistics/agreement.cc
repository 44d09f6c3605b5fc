#include "bench/statistics/agreement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "bench/statistics/bootstrap_units.h"

namespace etude {
namespace {

constexpr std::size_t kFigures = 5;

using Figures = std::array<std::optional<double>, kFigures>;  ///< RMSE, bias, lower and upper limit of agreement, ICC

/// Returns the standard deviation of a single new difference between the two measurements (Bland and Altman 2007).
/// Returns nothing for fewer than two units.
std::optional<double> DeviationOf(std::span<const AgreementSums> units, const AgreementSums& all) {
  double within = 0, between = 0, squares = 0;
  const double n = all.count, groups = static_cast<double>(units.size()), bias = *BiasOf(all);
  if (groups < 2 || n <= groups) return std::nullopt;
  for (const AgreementSums& unit : units) {
    const double off = *BiasOf(unit) - bias;
    within += std::max(0.0, unit.square_truth + unit.square_found - 2 * unit.product);
    between += unit.count * off * off;
    squares += unit.count * unit.count;
  }
  within /= n - groups;
  between /= groups - 1;
  const double replicates = (n * n - squares) / ((groups - 1) * n);
  return std::sqrt(within + std::max(0.0, (between - within) / replicates));
}

/// Returns the figures over all frames of the units. Each unit has at least one frame.
Figures FiguresOf(std::span<const AgreementSums> units) {
  AgreementSums all;
  for (const AgreementSums& unit : units) all = Together(all, unit);
  if (all.count == 0) return {};
  const auto deviation = DeviationOf(units, all);
  // Quantile of the normal distribution for 95 % limits of agreement (Bland and Altman).
  constexpr double kNormal = 1.96;
  const double bias = *BiasOf(all);
  Figures figures = {RmsOf(all), bias, std::nullopt, std::nullopt, IccOf(all)};
  if (deviation) figures[2] = bias - kNormal * *deviation;
  if (deviation) figures[3] = bias + kNormal * *deviation;
  return figures;
}

}  // namespace

CurveAgreement MeasureAgreement(std::span<const AgreementSums> pairs, std::span<const std::string> units,
                                std::uint64_t seed, const std::string& purpose) {
  // Add up the sums of all pairs of curves of each unit, in the order of units.
  std::map<std::string, AgreementSums> by_unit;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].count == 0) continue;
    AgreementSums& sums = by_unit[units[i]];
    sums = Together(sums, pairs[i]);
  }
  std::vector<AgreementSums> sums;
  for (const auto& [unit, of_unit] : by_unit) sums.push_back(of_unit);
  const Figures figures = FiguresOf(sums);
  const auto intervals = BootstrapUnits<AgreementSums>(sums, figures, {{seed, "bootstrap", 0}, purpose}, FiguresOf);
  CurveAgreement agreement;
  agreement.units = static_cast<int>(sums.size());
  AgreementFigure* const targets[kFigures] = {&agreement.rmse, &agreement.bias, &agreement.low, &agreement.high,
                                              &agreement.icc};
  for (std::size_t k = 0; k < kFigures; ++k) *targets[k] = {figures[k], intervals[k]};
  return agreement;
}

std::vector<AngleAgreement> AgreementByAngle(const RunData& run) {
  std::vector<AngleAgreement> found;
  for (const SeriesGroup& group : GroupSeries(run, kAgreementAxis)) {
    std::vector<AgreementSums> pairs;
    std::vector<std::string> units;
    for (std::size_t i = 0; i < group.values.size(); ++i) {
      const auto sums = DecodeSums(group.values[i]);
      if (!sums) continue;
      pairs.push_back(*sums);
      units.push_back(group.units[i]);
    }
    if (pairs.empty()) continue;
    // Each angle has a random stream of its own.
    found.push_back({group.condition, group.method, group.name,
                     MeasureAgreement(pairs, units, run.seed, "agreement/" + group.place)});
  }
  return found;
}

}  // namespace etude
