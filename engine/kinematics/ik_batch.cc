#include "engine/kinematics/ik_batch.h"

#include <cmath>
#include <cstdint>

namespace etude {
namespace {

constexpr std::size_t kLine = 8;  // number of doubles in a cache line

// Returns the distance between successive rows, in doubles: an odd number of cache lines, so that the numbers of one
// problem do not fall into one cache set.
std::size_t StrideFor(int count) { return (((static_cast<std::size_t>(count) + kLine - 1) / kLine) | 1) * kLine; }

}  // namespace

IkBatch::IkBatch(const KinematicTree& tree, int count)
    : dofs_(tree.dof_count()),
      effectors_(static_cast<int>(tree.effectors.size())),
      count_(count),
      stride_(StrideFor(count)),
      numbers_((3 * dofs_ + kRootNumbers + effectors_ * kTargetNumbers) * stride_) {}

IkBatch::IkBatch(const KinematicTree& tree, std::span<const IkProblem> problems)
    : IkBatch(tree, static_cast<int>(problems.size())) {
  for (int n = 0; n < count_; ++n) {
    const IkProblem& problem = problems[n];
    const std::size_t dofs = tree.limits.size();
    if (problem.start.angles.size() == dofs && problem.limits.size() == dofs &&
        problem.targets.size() == tree.effectors.size()) {
      Set(n, problem);
    }
  }
}

void IkBatch::Set(int problem_index, const IkProblem& problem) {
  double* to = numbers_.data() + problem_index;
  const auto put = [&](double number) {
    *to = number;
    to += stride_;
  };
  const auto put_all = [&](const double* numbers, int count) {
    for (int n = 0; n < count; ++n) put(numbers[n]);
  };
  for (const double angle : problem.start.angles) put(angle);
  for (const AngleRange& range : problem.limits) put(range.lower);
  for (const AngleRange& range : problem.limits) put(range.upper);
  put_all(&problem.start.root_position.x, 3);
  put_all(&problem.start.root_frame[0].x, 9);
  for (const EffectorTarget& target : problem.targets) {
    put_all(&target.position.x, 3);
    put_all(&target.axes[0].x, 9);
    put(target.position_weight);
    put_all(&target.axis_weights.x, 3);
  }
}

IkProblem IkBatch::Get(int problem_index) const {
  // Read the numbers of this problem's column in the order that `Column` declares.
  const double* from = numbers_.data() + problem_index;
  const auto take = [&] {
    const double number = *from;
    from += stride_;
    return number;
  };
  const auto take_all = [&](double* numbers, int count) {
    for (int n = 0; n < count; ++n) numbers[n] = take();
  };
  // Fill the problem from these numbers.
  IkProblem problem;
  problem.start.angles.resize(dofs_);
  problem.limits.resize(dofs_);
  problem.targets.resize(effectors_);
  for (double& angle : problem.start.angles) angle = take();
  for (AngleRange& range : problem.limits) range.lower = take();
  for (AngleRange& range : problem.limits) range.upper = take();
  take_all(&problem.start.root_position.x, 3);
  take_all(&problem.start.root_frame[0].x, 9);
  for (EffectorTarget& target : problem.targets) {
    take_all(&target.position.x, 3);
    take_all(&target.axes[0].x, 9);
    target.position_weight = take();
    take_all(&target.axis_weights.x, 3);
  }
  return problem;
}

// The loops go row by row without branches, so that compilers vectorise them. Every check is a comparison that fails
// for NaN.
std::vector<int> IkBatch::FindSound() const {
  // Each check sets faults[n] for every problem n that fails it.
  const std::size_t count = count_;
  std::vector<std::int64_t> faults(count);  // as wide as a double, for vectorisation
  const auto demand = [&](const auto& holds) {
    for (std::size_t n = 0; n < count; ++n) faults[n] |= holds(n) ? 0 : 1;
  };
  const auto demand_sane = [&](std::span<const double> numbers) {
    demand([=](std::size_t n) { return std::abs(numbers[n]) <= kMaxIkValue; });
  };
  const auto demand_frame = [&](const auto& axis) {
    for (int k = 0; k < 9; ++k) demand_sane(axis(k));
    for (int k = 0; k < 9; k += 3) {
      demand([x = axis(k), y = axis(k + 1), z = axis(k + 2)](std::size_t n) {
        return std::abs((x[n] * x[n] + y[n] * y[n] + z[n] * z[n]) - 1) <= kUnitTolerance;
      });
    }
    demand([a = axis(0), b = axis(1), c = axis(2), d = axis(3), e = axis(4), f = axis(5), g = axis(6), h = axis(7),
            i = axis(8)](std::size_t n) {
      const double determinant =
          a[n] * (e[n] * i[n] - h[n] * f[n]) - d[n] * (b[n] * i[n] - h[n] * c[n]) + g[n] * (b[n] * f[n] - e[n] * c[n]);
      return std::abs(determinant - 1) < kFrameTolerance;
    });
  };
  // Check that angles and limits are finite and that lower ≤ upper.
  for (int dof = 0; dof < dofs_; ++dof) {
    demand_sane(start_angles(dof));
    demand_sane(lower_limits(dof));
    demand_sane(upper_limits(dof));
    demand([lower = lower_limits(dof), upper = upper_limits(dof)](std::size_t n) { return lower[n] <= upper[n]; });
  }
  // Check that the root and every target are orthonormal frames at a sane position, with non-negative weights.
  for (int k = 0; k < 3; ++k) demand_sane(root(k));
  demand_frame([this](int k) { return root(3 + k); });
  for (int e = 0; e < effectors_; ++e) {
    for (int k = 0; k < 3; ++k) demand_sane(target(e, k));
    demand_frame([this, e](int k) { return target(e, 3 + k); });
    for (int k = 12; k < kTargetNumbers; ++k) {
      demand([weight = target(e, k)](std::size_t n) { return weight[n] >= 0 && weight[n] <= kMaxIkValue; });
    }
  }
  std::vector<int> sound;
  sound.reserve(count);
  for (int n = 0; n < count_; ++n) {
    if (faults[n] == 0) sound.push_back(n);
  }
  return sound;
}

}  // namespace etude
