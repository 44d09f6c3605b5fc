#include "tests/support/fingerprint.h"

#include <limits>
#include <vector>

namespace etude::testing {
namespace {

TEST(Fingerprint, ChangesWithAnyNumberTheirOrderAndTheirCount) {
  const std::vector<double> numbers = {3, 0, 2, 1e-6};
  const auto of = [](const std::vector<double>& values) { return Fingerprint().Add(values); };
  const double sum = -1.02642782641;
  EXPECT_TRUE(of(numbers).Is(5, sum));
  for (const std::vector<double>& other :
       {std::vector<double>{3, 0, 2, 2e-6}, {3, 2, 0, 1e-6}, {3, 0, 2}, {3, 0, 2, 1e-6, 0}}) {
    EXPECT_FALSE(of(other).Is(5, sum));
  }
}

TEST(Fingerprint, OfWhatIsNoNumberIsNeverAsItWas) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(Fingerprint().Add(bad).Is(1, bad));
  }
}

TEST(Fingerprint, OfARotationIsThatOfItsNegative) {
  const glm::dquat q(0.5, 0.5, -0.5, 0.5);
  Fingerprint print;
  print.Add(q);
  EXPECT_TRUE(Fingerprint().Add(-q).Is(9, print.sum()));
}

TEST(Fingerprint, OfAMissingValueIsNotThatOfZero) { EXPECT_FALSE(Fingerprint().Add(std::optional<double>()).Is(2, 0)); }

}  // namespace
}  // namespace etude::testing
