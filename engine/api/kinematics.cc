#include <etude/kinematics.h>
#include <fmt/core.h>

#include <algorithm>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/ik_batch.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/tree.h"

namespace etude::engine {
namespace {

constexpr int kMatrixNumbers = 9;

/// Returns the engine's view of a tree; the view refers to the tree's names.
KinematicTree ViewOf(const Tree& tree) {
  KinematicTree view;
  int dofs = 0;
  for (const Limb& limb : tree.limbs) {
    view.joints.push_back({limb.name, limb.parent, limb.p_PJ, limb.R_PJ, dofs, limb.dofs});
    dofs += limb.dofs;
  }
  for (const Effector& end : tree.effectors) view.effectors.push_back({end.name, end.limb, end.p_LE});
  for (const AngleRange& range : tree.limits) view.limits.push_back({range.lower, range.upper});
  return view;
}

std::vector<Frame> FromFrames(std::span<const LimbFrame> frames) {
  std::vector<Frame> made;
  made.reserve(frames.size());
  for (const LimbFrame& frame : frames) made.push_back({frame.position, frame.axes});
  return made;
}

EffectorTarget ToEngineTarget(const Target& target) {
  return {target.frame.position, target.frame.axes, target.position_weight, target.axis_weights};
}

etude::IkOptions ToEngineOptions(const IkOptions& options) {
  etude::IkOptions made;
  made.max_iterations = options.max_iterations;
  made.position_goal = options.position_goal;
  made.axis_goal = options.axis_goal;
  made.angle_change_tolerance = options.most_change;
  return made;
}

IkStatus FromStatus(etude::IkStatus status) {
  switch (status) {
    case etude::IkStatus::kConverged:
      return IkStatus::kConverged;
    case etude::IkStatus::kStalled:
      return IkStatus::kStalled;
    case etude::IkStatus::kUnreachable:
      return IkStatus::kUnreachable;
    case etude::IkStatus::kIterationLimit:
      return IkStatus::kIterationLimit;
    case etude::IkStatus::kBadInput:
      break;
  }
  return IkStatus::kBadInput;
}

/// Throws BadInput if a count is not as required.
void CheckCount(std::string_view what, std::size_t found, std::size_t wanted) {
  if (found != wanted) throw BadInput(fmt::format("{} {}; allowed: {}", found, what, wanted));
}

void FillFrame(const Frame& frame, int place, const auto& row_of) {
  for (int axis = 0; axis < 3; ++axis) row_of(axis)[place] = frame.position[axis];
  for (int n = 0; n < kMatrixNumbers; ++n) row_of(3 + n)[place] = frame.axes[n / 3][n % 3];
}

}  // namespace

Tree AdultBody() {
  const KinematicTree body = MakeBodyTree(LimbLengths{});
  Tree tree;
  for (const TreeJoint& joint : body.joints) {
    tree.limbs.push_back({std::string(joint.name), joint.parent, joint.p_PJ, joint.R_PJ, joint.dof_count});
  }
  for (const etude::Effector& end : body.effectors) {
    tree.effectors.push_back({std::string(end.name), end.joint, end.p_LE});
  }
  for (const etude::AngleRange& range : body.limits) tree.limits.push_back({range.lower, range.upper});
  return tree;
}

struct Kinematics::Solver {
  Tree tree;
  KinematicTree view;
  etude::IkOptions options;
  GaussNewtonSolver solver;

  Solver(Tree told, const IkOptions& asked)
      : tree(std::move(told)), view(ViewOf(tree)), options(ToEngineOptions(asked)), solver(view) {}

  TreeFrames Frames(const TreePose& pose) const {
    CheckCount("angles", pose.angles.size(), view.limits.size());
    return ComputeFrames(view, {pose.root.position, pose.root.axes, pose.angles});
  }

  /// Copies the problems into the engine's batch, side by side.
  etude::IkBatch Columns(const IkBatch& batch, int count) const {
    etude::IkBatch columns(view, count);
    const int dofs = view.dof_count(), effectors = static_cast<int>(view.effectors.size());
    for (int dof = 0; dof < dofs; ++dof) {
      std::ranges::fill(columns.lower_limits(dof), view.limits[dof].lower);
      std::ranges::fill(columns.upper_limits(dof), view.limits[dof].upper);
    }
    for (int i = 0; i < count; ++i) {
      for (int dof = 0; dof < dofs; ++dof) columns.start_angles(dof)[i] = batch.starts[std::size_t(i) * dofs + dof];
      FillFrame(batch.roots[batch.roots.size() == 1 ? 0 : i], i, [&](int n) { return columns.root(n); });
      for (int e = 0; e < effectors; ++e) {
        const Target& target = batch.targets[std::size_t(i) * effectors + e];
        FillFrame(target.frame, i, [&](int n) { return columns.target(e, n); });
        columns.target(e, 3 + kMatrixNumbers)[i] = target.position_weight;
        for (int axis = 0; axis < 3; ++axis)
          columns.target(e, 4 + kMatrixNumbers + axis)[i] = target.axis_weights[axis];
      }
    }
    return columns;
  }
};

Kinematics::Kinematics(Tree tree, const IkOptions& options) {
  solver_ = std::make_unique<Solver>(std::move(tree), options);
  if (const auto fault = FindFault(solver_->view, solver_->options); !fault.empty()) throw BadInput(std::string(fault));
}

Kinematics::Kinematics(Kinematics&&) noexcept = default;
Kinematics& Kinematics::operator=(Kinematics&&) noexcept = default;
Kinematics::~Kinematics() = default;

const Tree& Kinematics::tree() const { return solver_->tree; }
int Kinematics::dofs() const { return solver_->view.dof_count(); }

std::vector<Frame> Kinematics::Limbs(const TreePose& pose) const { return FromFrames(solver_->Frames(pose).joints); }

std::vector<Frame> Kinematics::Effectors(const TreePose& pose) const {
  return FromFrames(solver_->Frames(pose).effectors);
}

IkAnswer Kinematics::Solve(const TreePose& start, std::span<const Target> targets) const {
  IkProblem problem{{start.root.position, start.root.axes, start.angles}, {}, solver_->view.limits};
  std::ranges::transform(targets, std::back_inserter(problem.targets), ToEngineTarget);
  if (const auto fault = FindProblemFault(solver_->view, problem); !fault.empty()) throw BadInput(std::string(fault));
  IkSolution solution = solver_->solver.Solve(problem, solver_->options);
  return {FromStatus(solution.status), std::move(solution.angles), solution.iterations};
}

IkBatchAnswer Kinematics::Solve(const IkBatch& batch, Precision precision) const {
  const std::size_t dofs = solver_->view.limits.size(), effectors = solver_->view.effectors.size();
  if (effectors == 0) throw BadInput("a tree without effectors, for which there are no targets");
  const std::size_t count = batch.targets.size() / effectors;
  CheckCount("targets", batch.targets.size(), count * effectors);
  CheckCount("start angles", batch.starts.size(), count * dofs);
  if (batch.roots.size() != 1) CheckCount("roots", batch.roots.size(), count);
  constexpr std::size_t kMost = 10'000'000;
  if (count > kMost) throw BadInput(fmt::format("{} problems; allowed: {}", count, kMost));

  IkBatchSolution solution =
      SolveGaussNewtonBatch(solver_->view, solver_->Columns(batch, static_cast<int>(count)), solver_->options,
                            precision == Precision::kFloat ? etude::Precision::kFloat : etude::Precision::kDouble);
  IkBatchAnswer answer;
  answer.iterations = std::move(solution.iterations);
  std::ranges::transform(solution.statuses, std::back_inserter(answer.statuses), FromStatus);
  answer.angles.resize(count * dofs);
  for (std::size_t dof = 0; dof < dofs; ++dof) {
    const auto row = solution.angles_of(static_cast<int>(dof));
    for (std::size_t i = 0; i < count; ++i) answer.angles[i * dofs + dof] = row[i];
  }
  return answer;
}

}  // namespace etude::engine
