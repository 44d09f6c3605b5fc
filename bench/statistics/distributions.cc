#include "bench/statistics/distributions.h"

#include <boost/math/distributions/students_t.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <numbers>

#include "bench/statistics/interval.h"

namespace etude {

double NormalCdf(double x) { return 0.5 * boost::math::erfc(-x / std::numbers::sqrt2); }

double NormalQuantile(double p) { return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p); }

double StudentQuantile(double p, int freedom) {
  return boost::math::quantile(boost::math::students_t_distribution<double>(freedom), p);
}

double StudentTwoSided(double t, int freedom) {
  const boost::math::students_t_distribution<double> distribution(freedom);
  return 2 * boost::math::cdf(boost::math::complement(distribution, std::abs(t)));
}

double FairCoinUpperTail(int successes, int trials) {
  if (successes == 0) return 1;
  // The regularised incomplete beta function equals the tail of the binomial distribution (Abramowitz & Stegun
  // 26.5.24).
  return boost::math::ibeta(successes, trials - successes + 1, 0.5);
}

double KeepThirtyBits(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, 30)), exponent - 30);
}

double MinDetectableDifference(int count, int comparisons) {
  constexpr double kPower = 0.8;
  const double tail = kAlpha / (2 * comparisons);
  return (StudentQuantile(1 - tail, count - 1) + StudentQuantile(kPower, count - 1)) / std::sqrt(count);
}

}  // namespace etude
