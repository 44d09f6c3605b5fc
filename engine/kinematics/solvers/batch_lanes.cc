// Compiled once for every kind of vectors that x86-64 CPUs have; the best one is chosen when the program runs. Highway
// (rather than xsimd or std::experimental::simd) because it can do so from one file compiled for the baseline: each
// kind has a namespace of its own and only the functions in it use its instructions. With a file per kind and compiler
// flags for wider vectors, inline functions and templates of other headers would be compiled for these, too, and the
// linker might choose such a copy for everybody, on CPUs that cannot run it.
#include "engine/kinematics/solvers/batch_lanes.h"

#include <algorithm>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kinematics/solvers/batch_lanes.cc"
#include "hwy/foreach_target.h"  // before highway.h

// In this order: per target.
#include "engine/kinematics/solvers/lanes-inl.h"
#include "engine/kinematics/solvers/sweep_kernel-inl.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

template <class T>
class Batch {
 public:
  Batch(const SweepTree& tree, int dof_count, const LaneRules& rules, LaneQueue& queue)
      : tree_(tree),
        rules_(rules),
        queue_(queue),
        lanes_(hn::Lanes(hn::ScalableTag<T>())),
        state_(tree, dof_count),
        cosines_(dof_count),
        sines_(dof_count) {}

  void Run() {
    const Lanes<T> squared_goal(rules_.position_goal * rules_.position_goal);
    const Lanes<T> squared_axis_goal(rules_.axis_goal * rules_.axis_goal);
    const Lanes<T> squared_stall(rules_.stall_change * rules_.stall_change);
    while (FillLanes()) {
      const Lanes<T> chord = SweepHinges(tree_, rules_.formula, state_);
      PlaceLimbs(tree_, state_);
      ++sweeps_;
      const LaneMask<T> moves = AtLeast(chord, squared_stall);
      const LaneMask<T> may_have_met = !MissesGoals(squared_goal, squared_axis_goal, state_);
      if (!rules_.reports_every_sweep && sweeps_ < next_last_sweep_ && !Any(may_have_met || !moves)) continue;
      for (std::size_t n = 0; n < lanes_.size(); ++n) {
        const int lane = static_cast<int>(n);
        const bool is_last = sweeps_ == lanes_[n].last_sweep;
        if (rules_.reports_every_sweep || is_last || GetLane(may_have_met || !moves, lane)) {
          Report(lane, !GetLane(moves, lane));
        }
      }
    }
  }

 private:
  struct Lane {
    int problem = -1;
    std::int64_t last_report = 0;
    std::int64_t last_sweep = 0;
  };

  /// Puts problems into lanes that have none. Whether any lane has one now; an idle lane goes on with its last one,
  /// unused.
  bool FillLanes() {
    if (!has_idle_lanes_) return true;
    has_idle_lanes_ = false;
    bool has_problems = false, has_new = false;
    next_last_sweep_ = INT64_MAX;
    for (std::size_t n = 0; n < lanes_.size(); ++n) {
      Lane& lane = lanes_[n];
      if (lane.problem < 0) {
        lane.problem = queue_.Next();
        if (lane.problem < 0) continue;
        LoadProblem(queue_.Numbers(lane.problem), static_cast<int>(n), state_);
        lane.last_report = sweeps_;
        lane.last_sweep = sweeps_ + rules_.max_sweeps;
        has_new = true;
      }
      next_last_sweep_ = std::min(next_last_sweep_, lane.last_sweep);
      has_problems = true;
    }
    if (has_new) PlaceLimbs(tree_, state_);
    return has_problems;
  }

  void Report(int n, bool has_stalled) {
    Lane& lane = lanes_[n];
    if (lane.problem < 0) return;
    for (std::size_t d = 0; d < cosines_.size(); ++d) {
      cosines_[d] = GetLane(state_.hinges[d].c, n);
      sines_[d] = GetLane(state_.hinges[d].s, n);
    }
    const int sweeps = static_cast<int>(sweeps_ - lane.last_report);
    lane.last_report = sweeps_;
    if (queue_.Report(lane.problem, sweeps, has_stalled, cosines_, sines_)) return;
    lane.problem = -1;
    has_idle_lanes_ = true;
  }

  const SweepTree& tree_;
  const LaneRules& rules_;
  LaneQueue& queue_;
  std::vector<Lane> lanes_;
  SweepState<Lanes<T>> state_;
  std::vector<double> cosines_, sines_;
  bool has_idle_lanes_ = true;
  std::int64_t sweeps_ = 0;  // of all problems so far
  std::int64_t next_last_sweep_ = 0;
};

void SweepFloats(const SweepTree& tree, int dof_count, const LaneRules& rules, LaneQueue& queue) {
  Batch<float>(tree, dof_count, rules, queue).Run();
}
void SweepDoubles(const SweepTree& tree, int dof_count, const LaneRules& rules, LaneQueue& queue) {
  Batch<double>(tree, dof_count, rules, queue).Run();
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(SweepFloats);
HWY_EXPORT(SweepDoubles);

void SweepLanes(const SweepTree& tree, int dof_count, const LaneRules& rules, Precision precision, LaneQueue& queue) {
  const auto sweep =
      precision == Precision::kFloat ? HWY_DYNAMIC_DISPATCH(SweepFloats) : HWY_DYNAMIC_DISPATCH(SweepDoubles);
  sweep(tree, dof_count, rules, queue);
}

std::vector<std::string> BatchTargets() {
  hwy::SetSupportedTargetsForTest(0);
  std::vector<std::string> names;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.push_back(hwy::TargetName(target));
  return names;
}

void SetBatchTarget(std::string_view name) {
  hwy::SetSupportedTargetsForTest(0);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    if (name == hwy::TargetName(target)) hwy::SetSupportedTargetsForTest(target);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace etude
#endif  // HWY_ONCE
