#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace [[gnu::visibility("default")]] etude {

/// Many problems of one tree as one matrix: a row for each number of an `IkProblem`, a column for each problem.
class IkBatch {
 public:
  /// Makes `count` problems, all zeros.
  IkBatch(const KinematicTree& tree, int count);
  /// Copies a list of problems. If a problem's lists do not fit the tree, its column stays zero; `FindSound` never
  /// accepts this column, because zero axes are not unit vectors.
  IkBatch(const KinematicTree& tree, std::span<const IkProblem> problems);

  int count() const { return count_; }

  std::span<double> start_angles(int dof) { return row(dof); }
  std::span<double> lower_limits(int dof) { return row(dofs_ + dof); }
  std::span<double> upper_limits(int dof) { return row(2 * dofs_ + dof); }
  /// Returns the row of one number of the root, over all problems: numbers 0…2 are p_WL, 3…11 are R_WL, column by
  /// column.
  std::span<double> root(int number) { return row(3 * dofs_ + number); }
  /// Returns the row of one number of a target, over all problems: numbers 0…2 are p_WD, 3…11 are R_WD, column by
  /// column, 12 is the position weight, 13…15 are the axis weights.
  std::span<double> target(int effector, int number) {
    return row(3 * dofs_ + kRootNumbers + effector * kTargetNumbers + number);
  }
  std::span<const double> start_angles(int dof) const { return row(dof); }
  std::span<const double> lower_limits(int dof) const { return row(dofs_ + dof); }
  std::span<const double> upper_limits(int dof) const { return row(2 * dofs_ + dof); }
  std::span<const double> root(int number) const { return row(3 * dofs_ + number); }
  std::span<const double> target(int effector, int number) const {
    return row(3 * dofs_ + kRootNumbers + effector * kTargetNumbers + number);
  }

  /// The numbers of one problem; number k is `numbers[k * stride]`. The order is start angles, lower limits, upper
  /// limits, root, targets.
  struct Column {
    const double* numbers = nullptr;
    std::size_t stride = 1;
  };
  Column column(int problem_index) const { return {numbers_.data() + problem_index, stride_}; }
  static constexpr int kRootNumbers = 12, kTargetNumbers = 16;

  /// Stores `problem`, whose lists must fit the tree, as column `problem_index`.
  void Set(int problem_index, const IkProblem& problem);
  /// Returns the problem in column `problem_index`.
  IkProblem Get(int problem_index) const;

  /// Returns the indices of the problems in which `FindFault` finds no fault.
  std::vector<int> FindSound() const;

 private:
  std::span<double> row(int n) { return {numbers_.data() + n * stride_, static_cast<std::size_t>(count_)}; }
  std::span<const double> row(int n) const { return {numbers_.data() + n * stride_, static_cast<std::size_t>(count_)}; }

  int dofs_, effectors_, count_;
  std::size_t stride_;
  std::vector<double> numbers_;
};

/// The solutions of a batch.
struct IkBatchSolution {
  int count = 0;
  std::vector<double> angles;  ///< angle of degree of freedom d of problem n at [d · count + n], radians
  std::vector<IkStatus> statuses;
  std::vector<int> iterations, fk_evaluations;

  std::span<const double> angles_of(int dof) const {
    return {angles.data() + static_cast<std::size_t>(dof) * count, static_cast<std::size_t>(count)};
  }
};

}  // namespace etude
