#include "bench/statistics/judged_alike.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "engine/base/names.h"

namespace etude {
namespace {

/// Returns the parts of `one` that `other` lacks, as text: "only “a” is judged on left_wrist"; "" if there are none.
std::string OnlyIn(const std::vector<std::string>& one, const std::vector<std::string>& other,
                   const std::string& name) {
  std::vector<std::string> only;
  for (const std::string& part : one) {
    if (std::ranges::find(other, part) == other.end()) only.push_back(part);
  }
  return only.empty() ? "" : fmt::format("only “{}” is judged on {}", name, Join(only));
}

bool HaveOtherRates(const JudgedPair& world) {
  constexpr double kTolerance = 0.01;
  const double a = world.baseline.rate_hz, b = world.method.rate_hz;
  return std::abs(a - b) > kTolerance * std::max(a, b);
}

}  // namespace

std::string WhyNotAlike(const MetricInfo& metric, const std::vector<JudgedPair>& worlds, const std::string& baseline,
                        const std::string& method) {
  if (metric.is_success || worlds.empty()) return "";
  // Compare the judged parts, then the rates.
  const auto other = std::ranges::find_if(
      worlds, [](const JudgedPair& world) { return *world.baseline.parts != *world.method.parts; });
  if (other != worlds.end()) {
    const std::string of_baseline = OnlyIn(*other->baseline.parts, *other->method.parts, baseline);
    const std::string of_method = OnlyIn(*other->method.parts, *other->baseline.parts, method);
    return fmt::format("not judged alike: {}{}{}", of_baseline, of_baseline.empty() || of_method.empty() ? "" : "; ",
                       of_method);
  }
  const auto faster = metric.by_rate ? std::ranges::find_if(worlds, HaveOtherRates) : worlds.end();
  if (faster != worlds.end()) {
    return fmt::format("not judged alike: “{}” has {:g} Hz, “{}” {:g} Hz, and the value depends on the rate", baseline,
                       faster->baseline.rate_hz, method, faster->method.rate_hz);
  }
  // Compare the judged shares.
  double of_baseline = 0, of_method = 0, apart = 0;
  const double count = static_cast<double>(worlds.size());
  for (const JudgedPair& world : worlds) {
    of_baseline += world.baseline.share / count;
    of_method += world.method.share / count;
    apart += std::abs(world.baseline.share - world.method.share) / count;
  }
  constexpr double kRounding = 1e-9, kPerCent = 100;
  if (apart < kMaxShareDifference - kRounding) return "";
  return fmt::format(
      "not judged alike: “{}” is judged on {:.1f} % of what the truth shows, “{}” on {:.1f} % ({:.1f} points apart "
      "in a world, on average)",
      baseline, kPerCent * of_baseline, method, kPerCent * of_method, kPerCent * apart);
}

}  // namespace etude
