#include "engine/smoothing/track_smoother.h"

#include <Eigen/Dense>
#include <cmath>

namespace etude {
namespace {

using State = Eigen::Matrix<double, 6, 1>;  // position, velocity
using StateMatrix = Eigen::Matrix<double, 6, 6>;

struct Estimate {
  State mean;
  StateMatrix covariance;
};

/// The transition from one frame to the next: x ↦ F x + noise with covariance Q.
struct Transition {
  StateMatrix F = StateMatrix::Identity();
  StateMatrix Q = StateMatrix::Zero();

  explicit Transition(const PointMotion& motion) {
    const double t = motion.frame_s, q = motion.acceleration_density, tau = motion.velocity_memory_s;
    // The integrals of e^(−s/τ) and of e^(−2s/τ) over one frame.
    const double once = -tau * std::expm1(-t / tau), twice = -tau / 2 * std::expm1(-2 * t / tau);
    // The variance that one frame adds to the position for q = 1: τ² (t − 2·once + twice). For large τ the terms
    // cancel, so use the Taylor series of this expression.
    const double x = t / tau;
    constexpr double kCancels = 1e-3;
    const double drift =
        x < kCancels ? t * t * t * (1.0 / 3 - x / 4 + 7 * x * x / 60) : tau * tau * (t - 2 * once + twice);
    const auto I = Eigen::Matrix3d::Identity();
    F.topRightCorner<3, 3>() = once * I;
    F.bottomRightCorner<3, 3>() = std::exp(-t / tau) * I;
    Q.topLeftCorner<3, 3>() = q * drift * I;
    Q.topRightCorner<3, 3>() = Q.bottomLeftCorner<3, 3>() = q * once * once / 2 * I;
    Q.bottomRightCorner<3, 3>() = q * twice * I;
  }

  Estimate Predict(const Estimate& from) const { return {F * from.mean, F * from.covariance * F.transpose() + Q}; }
};

Estimate FirstEstimate(const PointMotion& motion) {
  Estimate first{State::Zero(), StateMatrix::Zero()};
  first.covariance.diagonal().head<3>().setConstant(motion.first_position_m * motion.first_position_m);
  first.covariance.diagonal().tail<3>().setConstant(motion.first_velocity_mps * motion.first_velocity_mps);
  return first;
}

constexpr double kMinInformationShare = 1e-12;  // a smaller share of the largest eigenvalue means "not measured"

/// A measurement in the form y = A p with errors of unit variance, one row for each measured direction.
struct WhiteMeasurement {
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> A;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> y;

  explicit WhiteMeasurement(const PointMeasurement& measurement) {
    Eigen::Matrix3d information;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) information(i, k) = measurement.information[k][i];
    }
    // The measured directions are the eigenvectors of the information matrix whose eigenvalues are positive.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(information);
    const double min_information = kMinInformationShare * eigen.eigenvalues()[2];
    int rows = 0;
    for (int i = 0; i < 3; ++i) rows += eigen.eigenvalues()[i] > min_information && eigen.eigenvalues()[2] > 0;
    A.resize(rows, 3);
    for (int i = 0; i < rows; ++i) {  // Eigen sorts eigenvalues in ascending order
      const int column = 3 - rows + i;
      A.row(i) = std::sqrt(eigen.eigenvalues()[column]) * eigen.eigenvectors().col(column).transpose();
    }
    y = A * Eigen::Vector3d(measurement.position.x, measurement.position.y, measurement.position.z);
  }
};

// Updates the estimate with a measurement, and returns the measurement's log-likelihood. Joseph's form keeps the
// covariance positive definite when a wide prior meets an accurate measurement.
double Update(const WhiteMeasurement& measurement, Estimate& estimate) {
  const auto rows = measurement.A.rows();
  if (rows == 0) return 0;
  Eigen::Matrix<double, Eigen::Dynamic, 6, 0, 3, 6> H(rows, 6);
  H << measurement.A, Eigen::MatrixXd::Zero(rows, 3);
  const Eigen::MatrixXd S = H * estimate.covariance * H.transpose() + Eigen::MatrixXd::Identity(rows, rows);
  const Eigen::LLT<Eigen::MatrixXd> root(S);
  const Eigen::MatrixXd K = root.solve(H * estimate.covariance).transpose();
  const Eigen::VectorXd innovation = measurement.y - H * estimate.mean;
  estimate.mean += K * innovation;
  const StateMatrix kept = StateMatrix::Identity() - K * H;
  estimate.covariance = kept * estimate.covariance * kept.transpose() + K * K.transpose();
  double log_determinant = 0;
  for (Eigen::Index i = 0; i < rows; ++i) log_determinant += 2 * std::log(root.matrixLLT()(i, i));
  constexpr double kLogTwoPi = 1.8378770664093454836;
  return -0.5 * (innovation.dot(root.solve(innovation)) + log_determinant + static_cast<double>(rows) * kLogTwoPi);
}

struct Filtered {
  std::vector<Estimate> predicted, updated;
  double log_likelihood = 0;
};

Filtered Filter(std::span<const WhiteMeasurement> measurements, const PointMotion& motion,
                const Transition& transition) {
  Filtered filtered;
  Estimate estimate = FirstEstimate(motion);
  for (std::size_t k = 0; k < measurements.size(); ++k) {
    if (k > 0) estimate = transition.Predict(estimate);
    filtered.predicted.push_back(estimate);
    filtered.log_likelihood += Update(measurements[k], estimate);
    filtered.updated.push_back(estimate);
  }
  return filtered;
}

std::vector<WhiteMeasurement> Whiten(std::span<const PointMeasurement> measurements) {
  return {measurements.begin(), measurements.end()};
}

glm::dvec3 ToGlm(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

glm::dmat3 ToGlm(const Eigen::Matrix3d& m) {
  return {ToGlm(Eigen::Vector3d(m.col(0))), ToGlm(Eigen::Vector3d(m.col(1))), ToGlm(Eigen::Vector3d(m.col(2)))};
}

}  // namespace

SmoothedTrack SmoothTrack(std::span<const PointMeasurement> measurements, const PointMotion& motion) {
  const Transition transition(motion);
  // Forward pass.
  Filtered filtered = Filter(Whiten(measurements), motion, transition);
  // Backward pass: correct each frame by the difference between the smoothed and the predicted next frame.
  std::vector<Estimate>& smoothed = filtered.updated;
  for (std::size_t k = measurements.size(); k-- > 1;) {
    const Estimate &before = smoothed[k - 1], &ahead = filtered.predicted[k];
    const StateMatrix gain = ahead.covariance.ldlt().solve(transition.F * before.covariance).transpose();
    smoothed[k - 1] = {before.mean + gain * (smoothed[k].mean - ahead.mean),
                       before.covariance + gain * (smoothed[k].covariance - ahead.covariance) * gain.transpose()};
  }
  SmoothedTrack track;
  track.log_likelihood = filtered.log_likelihood;
  for (const Estimate& estimate : smoothed) {
    track.positions.push_back(ToGlm(Eigen::Vector3d(estimate.mean.head<3>())));
    track.velocities.push_back(ToGlm(Eigen::Vector3d(estimate.mean.tail<3>())));
    track.covariances.push_back(ToGlm(Eigen::Matrix3d(estimate.covariance.topLeftCorner<3, 3>())));
  }
  return track;
}

double LikeliestAccelerationDensity(std::span<const PointMeasurement> measurements, const PointMotion& motion) {
  constexpr double kMinDensity = 0.01, kFactor = 4;
  constexpr int kCount = 10;
  // Try every density of the grid.
  const std::vector<WhiteMeasurement> white = Whiten(measurements);
  double best = kMinDensity, best_likelihood = 0;
  PointMotion tried = motion;
  tried.acceleration_density = kMinDensity;
  for (int k = 0; k < kCount; ++k, tried.acceleration_density *= kFactor) {
    const double likelihood = Filter(white, tried, Transition(tried)).log_likelihood;
    if (k > 0 && !(likelihood > best_likelihood)) continue;
    best = tried.acceleration_density;
    best_likelihood = likelihood;
  }
  return best;
}

}  // namespace etude
