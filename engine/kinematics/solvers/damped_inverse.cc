#include "engine/kinematics/solvers/damped_inverse.h"

#include <Eigen/Dense>
#include <algorithm>

namespace etude {
namespace {

constexpr double kSingular = 1e-12;
constexpr int kMostPasses = 4;  // of an active set

}  // namespace

void DampedInverse::Build(const LinearTargets& linear) {
  rows_ = linear.rows();
  columns_ = linear.columns();
  jacobian_.assign(linear.jacobian().begin(), linear.jacobian().end());
  residuals_.assign(linear.residuals().begin(), linear.residuals().end());
  gram_.assign(static_cast<std::size_t>(rows_) * rows_, 0.0);
  if (rows_ == 0) return;  // Eigen would look at what is not there
  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  Eigen::Map<Eigen::MatrixXd>(gram_.data(), rows_, rows_).selfadjointView<Eigen::Lower>().rankUpdate(jacobian);
}

bool DampedInverse::Step(double damping, std::span<const double> preferred, std::vector<double>& step) {
  step.assign(preferred.begin(), preferred.end());
  if (rows_ == 0) return true;  // no target: only the preferred posture counts
  damped_ = gram_;
  Eigen::Map<Eigen::MatrixXd> damped(damped_.data(), rows_, rows_);
  damped.diagonal().array() += damping;
  const Eigen::LDLT<Eigen::Ref<Eigen::MatrixXd>> factor(damped);
  const auto pivots = factor.vectorD();
  if (!(pivots.minCoeff() > kSingular * pivots.maxCoeff())) return false;

  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  const Eigen::Map<const Eigen::VectorXd> residuals(residuals_.data(), rows_);
  Eigen::Map<Eigen::VectorXd> out(step.data(), columns_);
  // J⁺e + (I − J⁺J) z = z + J⁺ (e − J z)
  const Eigen::VectorXd multipliers = factor.solve(residuals - jacobian * out);
  out.noalias() += jacobian.transpose() * multipliers;
  return true;
}

// Solves (J_F J_Fᵀ + μI) y = e − J step for y, in place of e − J step in `duals_`, F the angles that are free.
bool DampedInverse::SolveDuals(double damping) {
  if (rows_ == 0) return true;  // no target: only the preferred posture counts
  damped_ = gram_;
  Eigen::Map<Eigen::MatrixXd> damped(damped_.data(), rows_, rows_);
  damped.diagonal().array() += damping;
  for (int i = 0; i < columns_; ++i) {
    if (sides_[i] == 0) continue;
    const Eigen::Map<const Eigen::VectorXd> column(&jacobian_[static_cast<std::size_t>(i) * rows_], rows_);
    damped.selfadjointView<Eigen::Lower>().rankUpdate(column, -1);
  }
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(damped);
  if (factor.info() != Eigen::Success) return false;
  const auto pivots = factor.matrixLLT().diagonal();
  const double least = pivots.minCoeff(), most = pivots.maxCoeff();
  if (!(least * least > kSingular * most * most)) return false;
  Eigen::Map<Eigen::VectorXd> duals(duals_.data(), rows_);
  factor.solveInPlace(duals);
  return true;
}

bool DampedInverse::StepWithin(double damping, std::span<const double> preferred, std::span<const double> angles,
                               std::span<const AngleRange> ranges, std::vector<double>& step) {
  step.resize(columns_);
  sides_.assign(columns_, 0);
  duals_.resize(rows_);
  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  const Eigen::Map<const Eigen::VectorXd> residuals(residuals_.data(), rows_);
  Eigen::Map<Eigen::VectorXd> out(step.data(), columns_), duals(duals_.data(), rows_);
  is_exact_ = false;
  for (int pass = 0; pass < kMostPasses && !is_exact_; ++pass) {
    for (int i = 0; i < columns_; ++i) {
      step[i] = sides_[i] < 0   ? ranges[i].lower - angles[i]
                : sides_[i] > 0 ? ranges[i].upper - angles[i]
                                : preferred[i];
    }
    duals = residuals;
    duals.noalias() -= jacobian * out;
    if (!SolveDuals(damping)) return false;
    is_exact_ = true;
    for (int i = 0; i < columns_; ++i) {
      const Eigen::Map<const Eigen::VectorXd> column(&jacobian_[static_cast<std::size_t>(i) * rows_], rows_);
      const double best = preferred[i] + column.dot(duals);
      const double lower = ranges[i].lower - angles[i], upper = ranges[i].upper - angles[i];
      const signed char side = best < lower ? -1 : best > upper ? 1 : 0;
      is_exact_ = is_exact_ && side == sides_[i];
      sides_[i] = side;
      step[i] = std::clamp(best, lower, upper);
    }
  }
  return true;
}

double DampedInverse::Gain(std::span<const double> step) const {
  const Eigen::Map<const Eigen::MatrixXd> jacobian(jacobian_.data(), rows_, columns_);
  const Eigen::Map<const Eigen::VectorXd> residuals(residuals_.data(), rows_);
  const Eigen::Map<const Eigen::VectorXd> taken(step.data(), columns_);
  const Eigen::VectorXd moved = jacobian * taken;
  return moved.dot(2 * residuals - moved);
}

}  // namespace etude
