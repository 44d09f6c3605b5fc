#include "engine/fuzzy/weights.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace etude {
namespace {

constexpr int kUnknowns = static_cast<int>(kFeatureCount) + 1;  // the last one is the bias
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;
/// A pair as a row of the regression. It is a plain array, so that the innermost loop is fast even in debug builds.
using Row = std::array<double, kUnknowns>;

Row ToRow(const LabelledPair& pair) {
  Row row;
  for (std::size_t k = 0; k < kFeatureCount; ++k) row[k] = -pair.squared_gaps[k];
  row.back() = 1;
  return row;
}

double Dot(const Row& row, const Row& beta) {
  double sum = 0;
  for (int i = 0; i < kUnknowns; ++i) sum += row[i] * beta[i];
  return sum;
}

/// Computes the logistic function without overflow for any finite input.
double Sigmoid(double x) { return x >= 0 ? 1.0 / (1.0 + std::exp(-x)) : std::exp(x) / (1.0 + std::exp(x)); }

/// Returns the negative log likelihood plus the ridge penalty.
double Loss(std::span<const LabelledPair> pairs, const Row& beta, double ridge) {
  double loss = 0;
  for (std::size_t k = 0; k < kFeatureCount; ++k) loss += 0.5 * ridge * beta[k] * beta[k];
  for (const LabelledPair& pair : pairs) {
    const double score = Dot(ToRow(pair), beta) * (pair.close ? 1 : -1);
    // This is log(1 + e^−score) in a form that does not overflow.
    loss += std::log1p(std::exp(-std::abs(score))) + std::max(-score, 0.0);
  }
  return loss;
}

Vector NewtonStep(std::span<const LabelledPair> pairs, const Row& beta, double ridge) {
  // Sum up the gradient and the Hessian of the log likelihood.
  Row gradient{};
  std::array<Row, kUnknowns> lower{};  // lower triangle of the Hessian
  for (const LabelledPair& pair : pairs) {
    const Row row = ToRow(pair);
    const double probability = Sigmoid(Dot(row, beta));
    const double residual = (pair.close ? 1.0 : 0.0) - probability;
    const double weight = probability * (1.0 - probability);
    for (int i = 0; i < kUnknowns; ++i) {
      gradient[i] += residual * row[i];
      const double weighted = weight * row[i];
      for (int j = 0; j <= i; ++j) lower[i][j] += weighted * row[j];
    }
  }
  // Add the penalty.
  for (int k = 0; k + 1 < kUnknowns; ++k) {
    lower[k][k] += ridge;
    gradient[k] -= ridge * beta[k];
  }
  // The bias needs no penalty, but a tiny penalty keeps the matrix positive definite if all probabilities are 0 or 1.
  lower.back().back() += 1e-9;

  // Solve for the Newton step.
  Matrix hessian;
  for (int i = 0; i < kUnknowns; ++i) {
    for (int j = 0; j <= i; ++j) hessian(i, j) = hessian(j, i) = lower[i][j];
  }
  return hessian.ldlt().solve(Eigen::Map<const Vector>(gradient.data()));
}

Row Plus(const Row& beta, const Vector& step) {
  Row sum = beta;
  for (int i = 0; i < kUnknowns; ++i) sum[i] += step[i];
  return sum;
}

double Largest(const Row& beta) {
  double largest = 0;
  for (double value : beta) largest = std::max(largest, std::abs(value));
  return largest;
}

}  // namespace

WeightFit FitWeights(std::span<const LabelledPair> pairs, const WeightFitOptions& options) {
  WeightFit fit;
  // Count the pairs of each class. Logistic regression needs pairs of each class.
  fit.pairs = static_cast<int>(pairs.size());
  fit.close_pairs = static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [](auto& pair) { return pair.close; }));
  if (fit.close_pairs == 0 || fit.close_pairs == fit.pairs) return fit;

  // Minimise the loss by Newton's method.
  Row beta{};
  double loss = Loss(pairs, beta, options.ridge);
  fit.status = WeightFitStatus::kNotConverged;
  while (fit.iterations < options.max_iterations) {
    ++fit.iterations;
    Vector step = NewtonStep(pairs, beta, options.ridge);
    // A full Newton step may overshoot, so halve it until the loss decreases.
    double next = Loss(pairs, Plus(beta, step), options.ridge);
    for (int halvings = 0; next > loss && halvings < 30; ++halvings) {
      step *= 0.5;
      next = Loss(pairs, Plus(beta, step), options.ridge);
    }
    beta = Plus(beta, step);
    loss = next;
    if (step.cwiseAbs().maxCoeff() < options.tolerance * (1.0 + Largest(beta))) {
      fit.status = WeightFitStatus::kFitted;
      break;
    }
  }
  if (fit.status != WeightFitStatus::kFitted) return fit;

  // Clip negative coefficients and rescale the rest.
  FeatureWeights weights;
  double sum = 0;
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    weights[k] = std::max(beta[k], 0.0);
    sum += weights[k];
  }
  if (sum <= 0) {
    fit.status = WeightFitStatus::kNothingCounts;
    return fit;
  }
  for (double& weight : weights) weight *= kWeightSum / sum;
  fit.weights = weights;
  return fit;
}

}  // namespace etude
