#include "engine/smoothing/track_smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

namespace etude {
namespace {

/// Results of an independent smoother in numpy for eight frames. It filters in information form and computes the
/// process noise by Van Loan's matrix exponential; SmoothTrack uses Joseph's form and closed formulas of the integrals.
struct VectorFrame {
  std::array<double, 3> measured;
  std::array<double, 9> information;
  std::array<double, 3> position, velocity;
  double variance_x;
};
constexpr std::array<VectorFrame, 8> kVectors = {{
    {{0.0000, 1.0030, -0.1027},
     {2225, -164, -27, -164, 2729, 397, -27, 397, 3207},
     {0.001166036, 0.996146245, -0.105726509},
     {1.596282012, 0.153376271, -0.061297156},
     3.158716569e-04},
    {{0.0607, 0.9987, -0.0996},
     {2637, 1133, 1261, 1133, 8695, 1441, 1261, 1441, 4057},
     {0.062446719, 1.002689288, -0.107685558},
     {1.466346349, 0.190025842, -0.026741813},
     1.845387279e-04},
    {{0.1184, 1.0141, -0.1223},
     {666, 663, 280, 663, 4053, 1352, 280, 1352, 4676},
     {0.118389872, 1.011850401, -0.106275025},
     {1.330118999, 0.264340063, 0.127151202},
     2.374710746e-04},
    {{0.1691, 1.0328, -0.0994},  // nothing is seen
     {0, 0, 0, 0, 0, 0, 0, 0, 0},
     {0.168699317, 1.023142747, -0.097415147},
     {1.182119974, 0.286612249, 0.288419368},
     2.473516096e-04},
    {{0.2088, 1.0520, -0.0811},
     {1989, 222, -974, 222, 1340, 780, -974, 780, 5149},
     {0.212694244, 1.033686082, -0.085390563},
     {1.014224716, 0.226869537, 0.285470937},
     1.816573187e-04},
    {{0.2544, 1.0354, -0.0812},  // on a line along (1, 2, 2)
     {40000. / 9, -10000. / 9, -10000. / 9, -10000. / 9, 25000. / 9, -20000. / 9, -10000. / 9, -20000. / 9, 25000. / 9},
     {0.249306169, 1.041058917, -0.075480962},
     {0.806486533, 0.149618608, 0.214746356},
     1.331513796e-04},
    {{0.2750, 1.0470, -0.0626},
     {1062, -485, -255, -485, 3249, 630, -255, 630, 2718},
     {0.277542107, 1.046003058, -0.068121684},
     {0.623424190, 0.098434805, 0.150711006},
     1.620551174e-04},
    {{0.2936, 1.0449, -0.0668},
     {2194, 513, -56, 513, 1401, -212, -56, -212, 3848},
     {0.300475818, 1.049253791, -0.063106267},
     {0.537561134, 0.071262882, 0.110516816},
     3.332828390e-04},
}};
constexpr double kVectorsLogLikelihood = -66.009593507;

glm::dvec3 ToGlm(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

std::vector<PointMeasurement> VectorMeasurements() {
  std::vector<PointMeasurement> measurements;
  for (const VectorFrame& frame : kVectors) {
    PointMeasurement& m = measurements.emplace_back();
    m.position = ToGlm(frame.measured);
    for (int i = 0; i < 9; ++i) m.information[i % 3][i / 3] = frame.information[i];
  }
  return measurements;
}

const PointMotion kMotion{.frame_s = 0.04, .acceleration_density = 3, .velocity_memory_s = 0.5};

TEST(SmoothTrack, AgreesWithAnIndependentSmoother) {
  const SmoothedTrack track = SmoothTrack(VectorMeasurements(), kMotion);
  ASSERT_EQ(track.positions.size(), kVectors.size());
  for (std::size_t k = 0; k < kVectors.size(); ++k) {
    EXPECT_LT(glm::distance(track.positions[k], ToGlm(kVectors[k].position)), 1e-8) << k;
    EXPECT_LT(glm::distance(track.velocities[k], ToGlm(kVectors[k].velocity)), 1e-7) << k;
    EXPECT_NEAR(track.covariances[k][0][0], kVectors[k].variance_x, 1e-11) << k;
  }
  EXPECT_NEAR(track.log_likelihood, kVectorsLogLikelihood, 1e-6);
}

// Solves all frames' states at once: the minimum of |x₀|² / P₀ + Σ |x_k − F x_{k−1}|² / Q + Σ |y_k − x_k|² Λ along x.
std::vector<double> SolveBatch(const std::vector<double>& y, const std::vector<double>& information,
                               const PointMotion& motion) {
  const auto n = static_cast<Eigen::Index>(y.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * n);
  normal(0, 0) = 1 / (motion.first_position_m * motion.first_position_m);
  normal(1, 1) = 1 / (motion.first_velocity_mps * motion.first_velocity_mps);
  // Integrate the process in ten thousand small steps.
  constexpr int kSteps = 10'000;
  const double step = motion.frame_s / kSteps;
  Eigen::Matrix2d one, F = Eigen::Matrix2d::Identity(), Q = Eigen::Matrix2d::Zero();
  one << 1, step, 0, 1 - step / motion.velocity_memory_s;
  for (int i = 0; i < kSteps; ++i) {
    F = one * F;
    Q = one * Q * one.transpose();
    Q(1, 1) += motion.acceleration_density * step;
  }
  Eigen::Matrix<double, 2, 4> difference;
  difference << -F, Eigen::Matrix2d::Identity();
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k > 0) normal.block<4, 4>(2 * k - 2, 2 * k - 2) += difference.transpose() * Q.inverse() * difference;
    normal(2 * k, 2 * k) += information[static_cast<std::size_t>(k)];
    right[2 * k] += information[static_cast<std::size_t>(k)] * y[static_cast<std::size_t>(k)];
  }
  const Eigen::VectorXd x = normal.ldlt().solve(right);
  std::vector<double> positions;
  for (Eigen::Index k = 0; k < n; ++k) positions.push_back(x[2 * k]);
  return positions;
}

TEST(SmoothTrack, IsTheLeastSquaresSolutionOverAllFrames) {
  std::vector<double> y, information;
  std::vector<PointMeasurement> measurements;
  for (int k = 0; k < 30; ++k) {
    y.push_back(std::sin(0.3 * k) + 0.05 * std::cos(17.0 * k));
    information.push_back(k % 7 == 3 ? 0 : 400 + 100 * (k % 3));
    measurements.push_back({{y.back(), 0, 0}, glm::dmat3(information.back())});
  }
  for (const double memory_s : {0.1, 1e6}) {
    PointMotion motion = kMotion;
    motion.velocity_memory_s = memory_s;
    const SmoothedTrack track = SmoothTrack(measurements, motion);
    const std::vector<double> batch = SolveBatch(y, information, motion);
    for (std::size_t k = 0; k < y.size(); ++k) EXPECT_NEAR(track.positions[k].x, batch[k], 2e-5) << k;
  }
}

TEST(SmoothTrack, FollowsExactMeasurementsAndComesToRestWhereThereAreNone) {
  std::vector<PointMeasurement> measurements(40);
  for (int k = 0; k < 10; ++k) measurements[k] = {{0.1 * k, 1, 2}, glm::dmat3(1e12)};
  const SmoothedTrack track = SmoothTrack(measurements, {});
  for (int k = 0; k < 10; ++k) EXPECT_LT(glm::distance(track.positions[k], measurements[k].position), 1e-5) << k;
  EXPECT_GT(track.positions[12].x, 1) << "it swings on";
  EXPECT_LT(glm::length(track.velocities[39]), 0.5) << "from 3 m/s, in a second";
  EXPECT_GT(track.covariances[39][0][0], track.covariances[12][0][0]);
}

TEST(LikeliestAccelerationDensity, IsLargeForAPointThatTurnsAndSmallForOneThatTrembles) {
  std::vector<PointMeasurement> still, swinging;
  for (int k = 0; k < 60; ++k) {
    const double error = 0.01 * std::sin(97.0 * k * k);
    still.push_back({{error, 0, 0}, glm::dmat3(1e4)});
    swinging.push_back({{0.5 * std::sin(0.4 * k) + error, 0, 0}, glm::dmat3(1e4)});
  }
  const double of_still = LikeliestAccelerationDensity(still, {}),
               of_swinging = LikeliestAccelerationDensity(swinging, {});
  EXPECT_LT(of_still, 0.1);
  EXPECT_GT(of_swinging, 5);
  // No other density tried is likelier.
  const auto likelihood = [&](double density) {
    return SmoothTrack(swinging, {.acceleration_density = density}).log_likelihood;
  };
  EXPECT_GE(likelihood(of_swinging), likelihood(4 * of_swinging));
  EXPECT_GE(likelihood(of_swinging), likelihood(of_swinging / 4));
}

}  // namespace
}  // namespace etude
