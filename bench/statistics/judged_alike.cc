#include "bench/statistics/judged_alike.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "engine/base/names.h"

namespace etude {
namespace {

/// The data that a metric needs, by its inputs. A scenario's own metric states no inputs; it sees the joints.
struct Needs {
  explicit Needs(const MetricInfo& metric) : joints(metric.inputs.empty()) {
    for (const auto& [key, meaning] : metric.inputs) {
      joints = joints || key == "found" || key == "truth" || key.ends_with("_turns") || key.ends_with("_angles");
      root = root || key.ends_with("_root");
      truth = truth || key.starts_with("tru");
    }
  }
  bool joints, root = false, truth = false;
};

/// Returns the parts that matter for a metric.
std::vector<std::string> PartsOf(const JudgedPair::Side& side, const Needs& needs) {
  std::vector<std::string> parts = *side.parts;
  std::erase_if(parts,
                [&](const std::string& part) { return part.starts_with(kRootPart) ? !needs.root : !needs.joints; });
  return parts;
}

/// Returns the parts of `one` that `other` lacks, as text: "only “a” is judged on left_wrist"; "" if there are none.
std::string OnlyIn(const std::vector<std::string>& one, const std::vector<std::string>& other,
                   const std::string& name) {
  std::vector<std::string> only;
  for (const std::string& part : one) {
    if (std::ranges::find(other, part) == other.end()) only.push_back(part);
  }
  return only.empty() ? "" : fmt::format("only “{}” is judged on {}", name, Join(only));
}

/// Returns the share that was judged for only one of the two methods, among the parts that were judged for at least
/// one; 1 if their roots differ.
double PartsApart(const std::vector<std::string>& one, const std::vector<std::string>& other) {
  std::size_t common = 0;
  bool same_root = true;
  for (const std::string& part : one) {
    const bool is_common = std::ranges::find(other, part) != other.end();
    common += is_common ? 1 : 0;
    same_root = same_root && (is_common || !part.starts_with(kRootPart));
  }
  const std::size_t all = one.size() + other.size() - common;
  if (!same_root) return 1;
  return all > 0 ? 1 - static_cast<double>(common) / static_cast<double>(all) : 0;
}

/// Returns the rate on which a metric's value depends.
double RateOf(const JudgedPair::Side& side, const Needs& needs) {
  return needs.truth && side.compared_hz > 0 ? side.compared_hz : side.rate_hz;
}

}  // namespace

std::string WhyNotAlike(const MetricInfo& metric, const std::vector<JudgedPair>& worlds, const std::string& baseline,
                        const std::string& method) {
  if (metric.is_success || worlds.empty()) return "";
  const Needs needs(metric);
  const auto rates = [&](const JudgedPair& world) {
    return std::pair(RateOf(world.baseline, needs), RateOf(world.method, needs));
  };
  const auto is_faster = [&](const JudgedPair& world) {
    constexpr double kTolerance = 0.01;
    const auto [a, b] = rates(world);
    return metric.by_rate && std::abs(a - b) > kTolerance * std::max(a, b);
  };
  const auto parts_apart = [&](const JudgedPair& world) {
    if (*world.baseline.parts == *world.method.parts) return 0.0;
    return PartsApart(PartsOf(world.baseline, needs), PartsOf(world.method, needs));
  };
  const auto has_other_parts = [&](const JudgedPair& world) { return parts_apart(world) > 0; };
  // Measure how far apart the judged parts, rates and shares are; a few worlds of many hardly matter.
  double of_baseline = 0, of_method = 0, apart = 0;
  std::size_t others = 0;
  const double count = static_cast<double>(worlds.size());
  for (const JudgedPair& world : worlds) {
    of_baseline += world.baseline.share / count;
    of_method += world.method.share / count;
    others += has_other_parts(world) || is_faster(world) ? 1 : 0;
    const double shares = std::abs(world.baseline.share - world.method.share);
    apart += (is_faster(world) ? 1 : std::max(parts_apart(world), shares)) / count;
  }
  constexpr double kRounding = 1e-9, kPerCent = 100;
  if (apart < kMaxShareDifference - kRounding) return "";
  // Describe the first world that differs.
  const std::string where =
      others < worlds.size() ? fmt::format(", in {} of {} worlds", others, worlds.size()) : std::string();
  if (const auto other = std::ranges::find_if(worlds, has_other_parts); other != worlds.end()) {
    const auto one = PartsOf(other->baseline, needs), two = PartsOf(other->method, needs);
    const std::string only_baseline = OnlyIn(one, two, baseline), only_method = OnlyIn(two, one, method);
    return fmt::format("not judged alike: {}{}{}{}", only_baseline,
                       only_baseline.empty() || only_method.empty() ? "" : "; ", only_method, where);
  }
  if (const auto faster = std::ranges::find_if(worlds, is_faster); faster != worlds.end()) {
    const auto [a, b] = rates(*faster);
    return fmt::format("not judged alike: “{}” has {:g} Hz, “{}” {:g} Hz{}, and the value depends on the rate",
                       baseline, a, method, b, where);
  }
  return fmt::format(
      "not judged alike: “{}” is judged on {:.1f} % of what the truth shows, “{}” on {:.1f} % ({:.1f} points apart "
      "in a world, on average)",
      baseline, kPerCent * of_baseline, method, kPerCent * of_method, kPerCent * apart);
}

}  // namespace etude
