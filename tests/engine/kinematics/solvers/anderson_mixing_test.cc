#include "engine/kinematics/solvers/anderson_mixing.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "sim/random/stream.h"

namespace etude {
namespace {

using Vectors = std::vector<Eigen::VectorXd>;

Eigen::VectorXd RandomVector(RandomStream& random, int size) {
  Eigen::VectorXd v(size);
  for (double& entry : v) entry = random.Normal();
  return v;
}

Eigen::VectorXd Extrapolate(AndersonMixing& mixing, const Eigen::VectorXd& x, const Eigen::VectorXd& g) {
  Eigen::VectorXd out(x.size());
  mixing.Extrapolate({x.data(), x.data() + x.size()}, {g.data(), g.data() + g.size()},
                     {out.data(), out.data() + out.size()});
  return out;
}

// The same by Eigen, from all pairs up to now.
Eigen::VectorXd ByQr(const Vectors& xs, const Vectors& gs, int memory) {
  const int last = static_cast<int>(xs.size()) - 1, count = std::min(memory, last);
  if (count == 0) return gs[last];
  Eigen::MatrixXd df(xs[0].size(), count), dg(xs[0].size(), count);
  for (int i = 0; i < count; ++i) {
    dg.col(i) = gs[last - i] - gs[last - i - 1];
    df.col(i) = dg.col(i) - (xs[last - i] - xs[last - i - 1]);
  }
  return gs[last] - dg * df.colPivHouseholderQr().solve(gs[last] - xs[last]);
}

TEST(AndersonMixing, SolvesItsLeastSquaresAsEigenDoes) {
  constexpr int kSize = 12;
  for (const int memory : {1, 2, 5}) {
    RandomStream random({.suite_seed = 3, .scenario = "anderson-test", .trial = memory}, "pairs");
    AndersonMixing mixing(kSize, memory);
    Vectors xs, gs;
    for (int pair = 0; pair < 12; ++pair) {
      xs.push_back(RandomVector(random, kSize));
      gs.push_back(RandomVector(random, kSize));
      const Eigen::VectorXd out = Extrapolate(mixing, xs.back(), gs.back());
      EXPECT_LT((out - ByQr(xs, gs, memory)).norm(), 1e-9 * (1 + out.norm())) << memory << ", pair " << pair;
    }
  }
}

// Where g is linear, n + 1 pairs of n numbers know the fixed point (Walker and Ni 2011, theorem 2.2).
TEST(AndersonMixing, FindsTheFixedPointOfALinearMapInAsManyStepsAsItHasDimensions) {
  constexpr int kSize = 4;
  RandomStream random({.suite_seed = 3, .scenario = "anderson-test", .trial = 0}, "map");
  const Eigen::MatrixXd map = 0.5 * Eigen::MatrixXd::NullaryExpr(kSize, kSize, [&] { return random.Normal(); });
  const Eigen::VectorXd shift = RandomVector(random, kSize);
  const Eigen::VectorXd fixed = (Eigen::MatrixXd::Identity(kSize, kSize) - map).partialPivLu().solve(shift);
  const auto distance_after = [&](int memory) {
    AndersonMixing mixing(kSize, memory);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(kSize);
    for (int step = 0; step <= kSize; ++step) x = Extrapolate(mixing, x, map * x + shift);
    return (x - fixed).norm();
  };
  EXPECT_LT(distance_after(kSize), 1e-9);
  EXPECT_GT(distance_after(1), 1e-3) << "so little memory cannot know it";
}

TEST(AndersonMixing, TakesNothingFromPairsThatSayTheSameTwice) {
  AndersonMixing mixing(2, 3);
  const Eigen::Vector2d x(1, 2), g(1.5, 2), x2(1.5, 2), g2(1.75, 2);
  Extrapolate(mixing, x, g);
  const Eigen::VectorXd once = Extrapolate(mixing, x2, g2);
  EXPECT_NEAR(once[0], 2, 1e-12) << "steps that halve: 1, 1.5, 1.75, … 2";
  EXPECT_EQ(Extrapolate(mixing, x2, g2), once) << "a difference of zero changes nothing";
}

TEST(AndersonMixing, BeginsAnewAfterDiscarding) {
  AndersonMixing mixing(2, 3);
  const Eigen::Vector2d x(1, 2), g(1.5, 2), x2(1.5, 2), g2(1.75, 2);
  EXPECT_EQ(Extrapolate(mixing, x, g), g);
  mixing.Discard();
  EXPECT_EQ(Extrapolate(mixing, x2, g2), g2);
}

}  // namespace
}  // namespace etude
