#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/order_statistics.h"
#include "engine/motion/fault_limits.h"
#include "engine/motion/ground_faults.h"

namespace etude {
namespace {

void FindJumps(const GroundView& ground, std::vector<MotionFault>& faults) {
  using namespace fault_limits;
  const double times = TimesAt(ground.motion().rate_hz, kSlowJump_hz);
  for (const Displacement& d : ground.displacements()) {
    if (std::hypot(d.size.x, d.size.z) <= times * kJumpAlongFloor_m && glm::length(d.size) <= times * kJump_m) continue;
    faults.push_back(ground.FaultOf(FaultKind::kJumps, {d.before, d.after}, glm::length(d.size)));
  }
}

constexpr double kSameLevel_m = 0.025;  // levels count as equal up to this difference

/// Frames that share a vertical displacement.
struct Level {
  FrameRange frames;
  double offset = 0;
};

/// Chooses the level at which the body has the right height, and returns the vertical displacement of this level. The
/// function chooses the level with the lowest cost. Four properties reduce the cost of a level:
/// - The feet rest near the floor. (This property is ignored if the floor was found from the motion.)
/// - The level lasts long.
/// - The clip begins at this level.
/// - The clip ends at this level.
double ReferenceOffset(const GroundView& ground, const std::vector<Level>& levels) {
  constexpr double kLowest = -0.01, kHighest = 0.1;  // metres
  constexpr double kPerMetre = 2, kForTime = 0.04, kForEnd = 0.03;
  const double rest = ground.LowestRest() - ground.floor();
  std::optional<double> best;
  double reference = 0;
  for (const Level& candidate : levels) {
    double time = 0;
    for (const Level& level : levels) {
      if (std::abs(level.offset - candidate.offset) < kSameLevel_m) time += level.frames.last - level.frames.first + 1;
    }
    const double height = rest + candidate.offset;
    const double beyond = std::max({0.0, kLowest - height, height - kHighest});
    double cost = kForTime * (1 - time / ground.frames()) + (ground.is_floor_found() ? 0 : kPerMetre * beyond);
    for (const Level* end : {&levels.front(), &levels.back()}) {
      if (std::abs(end->offset - candidate.offset) >= kSameLevel_m) cost += kForEnd;
    }
    if (best && cost >= *best) continue;
    best = cost;
    reference = candidate.offset;
  }
  return reference;
}

/// The frames that were reported as displaced. `reference` is the sum of the lasting vertical displacements, metres, at
/// which the body has the right height.
struct Told {
  std::vector<bool> frames;
  double reference = 0;
};

/// Returns the median height of the lowest joint at a level.
double LowestAt(const GroundView& ground, const std::vector<Level>& levels, double offset) {
  std::vector<double> lowest;
  for (const Level& level : levels) {
    if (std::abs(level.offset - offset) >= kSameLevel_m) continue;
    lowest.insert(lowest.end(), ground.lowest().begin() + level.frames.first,
                  ground.lowest().begin() + level.frames.last + 1);
  }
  return Median(std::move(lowest));
}

Told FindDisplacedLevels(const GroundView& ground, std::vector<MotionFault>& faults) {
  constexpr double kStep = 0.02, kMinSeconds = 0.1, kMinShown = 0.5;
  // Split the motion at its vertical displacements.
  std::vector<Level> levels = {{{0, ground.frames() - 1}, 0}};
  double offset = 0;
  for (const Displacement& d : ground.displacements()) {
    offset += d.lasting.y;
    if (std::abs(d.lasting.y) <= kStep) continue;
    levels.back().frames.last = d.after - 1;
    levels.push_back({{d.after, ground.frames() - 1}, offset});
  }
  Told told{.frames = std::vector<bool>(ground.frames()),
            .reference = levels.size() > 1 ? ReferenceOffset(ground, levels) : 0};
  for (const Level& level : levels) {
    const double height = level.offset - told.reference;
    if (std::abs(height) <= fault_limits::kLevel_m || ground.Seconds(level.frames) <= kMinSeconds) continue;
    // The lowest joint must show it, too: sums of many small displacements may only be errors.
    const double seen = LowestAt(ground, levels, level.offset) - LowestAt(ground, levels, told.reference);
    if (seen * std::copysign(1.0, height) < kMinShown * std::abs(height)) continue;
    const FaultKind kind = height > 0 ? FaultKind::kFloats : FaultKind::kSinks;
    faults.push_back(ground.FaultOf(kind, level.frames, std::abs(height)));
    for (int f = level.frames.first; f <= level.frames.last; ++f) told.frames[f] = true;
  }
  return told;
}

/// Returns true if a foot rests in at least half of these frames: the body then stands on something.
bool FindsRest(const GroundView& ground, const FrameRange& span) {
  constexpr double kSlow = 0.15, kEnough = 0.5;
  int resting = 0;
  for (int f = span.first; f <= span.last; ++f) {
    const auto rests = [&](Role joint) { return glm::length(ground.Velocity(f, joint)) < kSlow; };
    resting += std::ranges::any_of(kFootJoints, rests) ? 1 : 0;
  }
  return resting >= kEnough * (span.last - span.first + 1);
}

/// Returns a fault if the body is too high or too low in the whole clip.
std::optional<MotionFault> FindWrongHeight(const GroundView& ground, const Told& told) {
  constexpr double kHighAtAll = 0.08, kEnoughUpright = 0.3, kMinUprightShare = 0.5;
  const FrameRange all{0, ground.frames() - 1};
  const double rest = ground.LowestRest() + told.reference - ground.floor();
  const bool is_high =
      rest > fault_limits::kFloatInAll_m && Quantile(ground.lowest(), 0.1) - ground.floor() > kHighAtAll;
  if (is_high && ground.UprightShare() > kMinUprightShare) return ground.FaultOf(FaultKind::kFloats, all, rest);
  if (rest < -fault_limits::kSink_m && ground.UprightShare() > kEnoughUpright)
    return ground.FaultOf(FaultKind::kSinks, all, -rest);
  return std::nullopt;
}

/// Appends the stretches in which the feet are below the floor, outside of displaced frames.
void FindLow(const GroundView& ground, const Told& told, std::vector<MotionFault>& faults) {
  std::vector<bool> is_deep(ground.frames());
  for (int f = 0; f < ground.frames(); ++f) {
    const double feet = ground.FootHeight(f) + ground.Offset(f).y - told.reference;
    is_deep[f] =
        !told.frames[f] && ground.Lowest(f) - ground.floor() < -fault_limits::kSink_m && feet < -fault_limits::kSink_m;
  }
  for (const FrameRange& span : RangesOf(is_deep)) {
    if (ground.Seconds(span) < fault_limits::kSink_s) continue;
    const double low = *std::min_element(ground.lowest().begin() + span.first, ground.lowest().begin() + span.last + 1);
    faults.push_back(ground.FaultOf(FaultKind::kSinks, span, ground.floor() - low));
  }
}

/// Appends the stretches in which the body is too high, without the frames that FindDisplacedLevels reported. The three
/// Hovering rules are tried in order until one finds a fault. Nobody jumps for a second, but some people sit on high
/// chairs or stand on steps. The limits are above what recorded dance shows: toes stay up to 5 cm above their 5th
/// percentile for two seconds, and up to 9 cm for one second.
void FindHigh(const GroundView& ground, const Told& told, std::vector<MotionFault>& faults) {
  for (const fault_limits::Hovering& kind : fault_limits::kHoverings) {
    std::vector<bool> hovers(ground.frames());
    for (int f = 0; f < ground.frames(); ++f) {
      hovers[f] = !told.frames[f] && ground.Lowest(f) - ground.floor() > kind.height_m &&
                  (!kind.is_upright || ground.IsUpright(f));
    }
    bool is_found = false;
    for (const FrameRange& span : RangesOf(hovers)) {
      if (ground.Seconds(span) <= kind.longest_s) continue;
      const double height =
          Median({ground.lowest().begin() + span.first, ground.lowest().begin() + span.last + 1}) - ground.floor();
      if (height > fault_limits::kStand_m && FindsRest(ground, span)) continue;
      faults.push_back(ground.FaultOf(FaultKind::kFloats, span, height));
      is_found = true;
    }
    if (is_found) return;
  }
}

}  // namespace

void FindLevelFaults(const GroundView& ground, std::vector<MotionFault>& faults) {
  FindJumps(ground, faults);
  const Told told = FindDisplacedLevels(ground, faults);
  if (const auto always = FindWrongHeight(ground, told)) {
    faults.push_back(*always);
    return;
  }
  FindLow(ground, told, faults);
  FindHigh(ground, told, faults);
}

}  // namespace etude
