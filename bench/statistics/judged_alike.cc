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

/// Returns the share of what was judged of either method that was judged of only one; 1 if their roots differ.
double PartsApart(const JudgedPair& world) {
  std::size_t common = 0;
  bool same_root = true;
  const auto &one = *world.baseline.parts, &other = *world.method.parts;
  for (const std::string& part : one) {
    const bool is_common = std::ranges::find(other, part) != other.end();
    common += is_common ? 1 : 0;
    same_root = same_root && (is_common || !part.starts_with("root "));
  }
  const std::size_t all = one.size() + other.size() - common;
  if (!same_root) return 1;
  return all > 0 ? 1 - static_cast<double>(common) / static_cast<double>(all) : 0;
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
  // Measure how far apart the judged parts, rates and shares are; a few worlds of many hardly matter.
  double of_baseline = 0, of_method = 0, apart = 0;
  std::size_t others = 0;
  const double count = static_cast<double>(worlds.size());
  const auto is_other_part = [](const JudgedPair& world) { return *world.baseline.parts != *world.method.parts; };
  const auto is_faster = [&](const JudgedPair& world) { return metric.by_rate && HaveOtherRates(world); };
  for (const JudgedPair& world : worlds) {
    of_baseline += world.baseline.share / count;
    of_method += world.method.share / count;
    others += is_other_part(world) || is_faster(world) ? 1 : 0;
    const double shares = std::abs(world.baseline.share - world.method.share);
    apart += (is_faster(world) ? 1 : std::max(PartsApart(world), shares)) / count;
  }
  constexpr double kRounding = 1e-9, kPerCent = 100;
  if (apart < kMaxShareDifference - kRounding) return "";
  // Describe the first world that differs.
  const std::string where =
      others < worlds.size() ? fmt::format(", in {} of {} worlds", others, worlds.size()) : std::string();
  if (const auto other = std::ranges::find_if(worlds, is_other_part); other != worlds.end()) {
    const std::string only_baseline = OnlyIn(*other->baseline.parts, *other->method.parts, baseline);
    const std::string only_method = OnlyIn(*other->method.parts, *other->baseline.parts, method);
    return fmt::format("not judged alike: {}{}{}{}", only_baseline,
                       only_baseline.empty() || only_method.empty() ? "" : "; ", only_method, where);
  }
  if (const auto faster = std::ranges::find_if(worlds, is_faster); faster != worlds.end()) {
    return fmt::format("not judged alike: “{}” has {:g} Hz, “{}” {:g} Hz{}, and the value depends on the rate",
                       baseline, faster->baseline.rate_hz, method, faster->method.rate_hz, where);
  }
  return fmt::format(
      "not judged alike: “{}” is judged on {:.1f} % of what the truth shows, “{}” on {:.1f} % ({:.1f} points apart "
      "in a world, on average)",
      baseline, kPerCent * of_baseline, method, kPerCent * of_method, kPerCent * apart);
}

}  // namespace etude
