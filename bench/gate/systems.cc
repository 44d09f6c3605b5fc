#include "bench/gate/systems.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "engine/base/names.h"

namespace etude {
namespace {

/// The largest difference of a metric's values between two systems.
struct Difference {
  const char* metric;
  double most;
};

/// A system on which the quick suite was run, and the differences of its results from those on Debian 12. The test
/// tests/cli/systems_test.py measures these differences; docs/guide/install.md shows them.
struct MeasuredSystem {
  const char* name;
  const char *compiler, *glibc, *ceres, *mesa;  ///< beginnings of the libraries' versions, as text
  int cells_that_differ;
  std::span<const Difference> differences;
};

constexpr int kQuickCells = 2192;
/// The differences between Debian sid and Debian 12. All concern task capture: Mesa 26.2 draws some pixels a few levels
/// differently, and the last digits of a camera's parameters differ.
constexpr std::array<Difference, 13> kSidDiffers = {{
    {"auc_200mm", 3.2e-4},
    {"bone_length_error_cm", 4e-16},
    {"joint_angle_error_deg", 0.0123},
    {"jerk_error_mps3", 13.6},
    {"limb_direction_error_deg", 7.2e-15},
    {"mpjpe_before_ik_mm", 0.0621},
    {"mpjpe_mm", 0.0638},
    {"mpjpe_seen_mm", 0.0638},
    {"pa_mpjpe_mm", 0.0747},
    {"pck_50mm", 9.6e-4},
    {"position_error_cm", 1.5e-4},
    {"reprojection_rms_px", 4.6e-15},
    {"triangulation_error_mm", 2.3e-13},
}};
constexpr std::array<MeasuredSystem, 3> kMeasured = {{
    {"Debian 12", "12.", "2.36", "2.1.", "Mesa 22.3.", 0, {}},
    {"Debian 13", "14.", "2.41", "2.2.", "Mesa 25.0.", 0, {}},
    {"Debian sid of November 2026", "16.", "2.43", "2.2.", "Mesa 26.2.", 80, kSidDiffers},
}};

const MeasuredSystem* FindMeasured(const RunSystem& system) {
  const auto* const found = std::ranges::find_if(kMeasured, [&](const MeasuredSystem& measured) {
    return system.compiler.starts_with(measured.compiler) && system.glibc == measured.glibc &&
           system.ceres.starts_with(measured.ceres) &&
           (system.renderer.empty() || system.renderer.find(measured.mesa) != std::string::npos);
  });
  return found == kMeasured.end() ? nullptr : found;
}

std::string Describe(const RunSystem& system, const MeasuredSystem* measured) {
  const std::size_t mesa = system.renderer.find("Mesa ");
  return fmt::format("GCC {}, glibc {}, Ceres {}{}{} ({})", system.compiler, system.glibc, system.ceres,
                     system.renderer.empty() ? "" : ", ", system.renderer.substr(mesa == std::string::npos ? 0 : mesa),
                     measured == nullptr ? "not measured" : measured->name);
}

using LargestDifferences = std::map<std::string, double, std::less<>>;

/// Returns the largest difference of each metric's values between two snapshots; metrics without a difference are left
/// out.
LargestDifferences DifferencesOf(const Snapshot& before, const Snapshot& after) {
  LargestDifferences largest;
  const auto add = [&](const SnapshotCells& a, const SnapshotCells& b) {
    for (const SnapshotValues& of_a : a.metrics) {
      const auto of_b = std::ranges::find(b.metrics, of_a.metric, &SnapshotValues::metric);
      if (of_b == b.metrics.end()) continue;
      for (std::size_t trial = 0; trial < std::min(of_a.values.size(), of_b->values.size()); ++trial) {
        if (!of_a.values[trial] || !of_b->values[trial]) continue;
        const double gap = std::abs(*of_a.values[trial] - *of_b->values[trial]);
        if (gap > 0) largest[of_a.metric] = std::max(largest[of_a.metric], gap);
      }
    }
  };
  for (const SnapshotScenario& a : before.scenarios) {
    const auto b = std::ranges::find(after.scenarios, a.name, &SnapshotScenario::name);
    if (b == after.scenarios.end()) continue;
    for (const SnapshotCells& cells : a.cells) {
      const auto same = std::ranges::find_if(b->cells, [&](const SnapshotCells& other) {
        return other.condition == cells.condition && other.method == cells.method;
      });
      if (same != b->cells.end()) add(cells, *same);
    }
  }
  return largest;
}

/// Returns bounds on the differences between two systems: the sums of their differences from Debian 12.
LargestDifferences MeasuredBetween(const MeasuredSystem& a, const MeasuredSystem& b) {
  LargestDifferences measured;
  for (const MeasuredSystem* system : {&a, &b}) {
    for (const Difference& one : system->differences) measured[one.metric] += one.most;
  }
  return measured;
}

std::string InWords(const LargestDifferences& differences) {
  std::vector<std::string> words;
  for (const auto& [metric, most] : differences) words.push_back(fmt::format("{} by {:.2g}", metric, most));
  return Join(words);
}

}  // namespace

std::vector<std::string> CompareSystems(const RunSystem& a, const RunSystem& b, const Snapshot& before,
                                        const Snapshot& after) {
  if (a == b) return {};
  const MeasuredSystem *const of_a = FindMeasured(a), *const of_b = FindMeasured(b);
  std::vector<std::string> lines = {"A: " + Describe(a, of_a), "B: " + Describe(b, of_b)};
  if (of_a == nullptr || of_b == nullptr) {
    lines.emplace_back(
        "Differences may be due to the systems. How much results differ between these two systems has not been "
        "measured.");
    return lines;
  }
  const LargestDifferences measured = MeasuredBetween(*of_a, *of_b);
  const int cells = of_a->cells_that_differ + of_b->cells_that_differ;
  lines.push_back(cells == 0
                      ? fmt::format("In a test of these two systems, none of the {} cells of the quick suite differed.",
                                    kQuickCells)
                      : fmt::format("In a test of these two systems, at most {} of the {} cells of the quick suite "
                                    "differed (largest differences: {}).",
                                    cells, kQuickCells, InWords(measured)));
  LargestDifferences beyond = DifferencesOf(before, after);
  std::erase_if(beyond, [&](const auto& one) {
    const auto found = measured.find(one.first);
    return found != measured.end() && one.second <= found->second;
  });
  if (!beyond.empty())
    lines.push_back(fmt::format("In this comparison, differences are larger than in that test: {}.", InWords(beyond)));
  return lines;
}

}  // namespace etude
