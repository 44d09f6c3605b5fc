#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "bench/metrics/transition_join.h"
#include "engine/motion/support.h"

namespace etude {

/// A limit that a human body keeps, and the metric that is compared with the limit. The metric is computed from the
/// motion alone (docs/reference/metrics.md, Transitions).
struct BodyRule {
  std::string_view metric;
  double limit = 0;        ///< largest value of a clean transition, in the unit of `metric`
  std::string_view unmet;  ///< why a value may be missing; empty if no value is ever missing
};

/// The rules of clean_share since version 4. BodyMeasures holds its values in this order.
constexpr std::array kBodyRules = {
    BodyRule{"zmp_off_cm", 25, "the ground never bears half of the weight"},
    BodyRule{"slip_mps2", 2, "the body has no support"},
    BodyRule{"glide_cm", 2, ""},
    BodyRule{"foot_turn_deg", 60, ""},
    BodyRule{"beyond_joint_deg", 0, ""},
    BodyRule{"overlap_cm", 0, ""},
    BodyRule{"sunk_cm", 3, ""},
};
/// The measured values, one for each of kBodyRules; nullopt if a value is missing.
using BodyMeasures = std::array<std::optional<double>, kBodyRules.size()>;

/// Measures the body's motion during a join by kBodyRules: the values say how far the motion is from one that a human
/// body can perform. `support` is the result of JoinSupport: one entry per frame from `view.first` on. Faults of the
/// clips themselves do not count against the join: a value becomes 0 if it is at most 1.25 times the value of a clip
/// at that time, and glide_cm and sunk_cm are measured relative to the clips. docs/reference/metrics.md gives the
/// rule of each measure.
BodyMeasures MeasureBody(const JoinView& view, std::span<const Support> support);

/// Returns true if no value exceeds its limit by more than rounding. A missing value exceeds no limit.
bool IsPossible(const BodyMeasures& measures);

}  // namespace etude
