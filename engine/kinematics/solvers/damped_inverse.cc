#include "engine/kinematics/solvers/damped_inverse.h"

#include <Eigen/Dense>

namespace etude {
namespace {

constexpr double kSingular = 1e-12;

}  // namespace

void DampedInverse::Build(const LinearTargets& linear) {
  rows_ = linear.rows();
  columns_ = linear.columns();
  jacobian_.assign(linear.jacobian().begin(), linear.jacobian().end());
  residuals_.assign(linear.residuals().begin(), linear.residuals().end());
  gram_.assign(static_cast<std::size_t>(rows_) * rows_, 0.0);
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

}  // namespace etude
