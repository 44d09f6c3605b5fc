#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// A batch of problems of one tree as a structure of arrays: a row for each number of an `IkProblem`, the problems side
/// by side in it.
class IkBatch {
 public:
  /// Makes `count` problems, all zeros.
  IkBatch(const KinematicTree& tree, int count);
  /// Takes the problems of a list. One whose lists do not fit the tree stays all zeros, which no problem may be (its
  /// axes are none).
  IkBatch(const KinematicTree& tree, std::span<const IkProblem> problems);

  int count() const { return count_; }

  std::span<double> start_angles(int dof) { return row(dof); }
  std::span<double> lower_limits(int dof) { return row(dofs_ + dof); }
  std::span<double> upper_limits(int dof) { return row(2 * dofs_ + dof); }
  /// Returns a number of the root. 0…2 are p_WL; 3…11 are R_WL, column by column.
  std::span<double> root(int number) { return row(3 * dofs_ + number); }
  /// Returns a number of a target. 0…2 are p_WD; 3…11 are R_WD, column by column; 12 is the position's weight; 13…15
  /// are the axes' weights.
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

  /// The numbers of one problem, `stride` after `stride`: start angles, lower and upper limits, root, targets.
  struct Column {
    const double* numbers = nullptr;
    std::size_t stride = 1;
  };
  Column column(int place) const { return {numbers_.data() + place, stride_}; }
  static constexpr int kRootNumbers = 12, kTargetNumbers = 16;

  /// Puts `problem`, which must fit the tree, to its place.
  void Set(int place, const IkProblem& problem);
  IkProblem Get(int place) const;

  /// Returns the places of the problems in which `FindFault` finds no fault.
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
  std::vector<double> angles;  ///< of the first degree of freedom for all problems, then of the second and so on
  std::vector<IkStatus> statuses;
  std::vector<int> iterations, fk_evaluations;

  std::span<const double> angles_of(int dof) const {
    return {angles.data() + static_cast<std::size_t>(dof) * count, static_cast<std::size_t>(count)};
  }
};

}  // namespace etude
