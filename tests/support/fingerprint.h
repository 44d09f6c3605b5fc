#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <ranges>
#include <type_traits>

#include "tests/support/random_clip.h"

namespace etude::testing {

/// The number of results of a computation, and their sum with fixed weights in [−1, 1): a golden value in two numbers.
/// The fingerprint changes if a number changes, is added, removed or moved. It does not show what changed, so other
/// tests must check that results are right. A failure prints the new numbers; whoever stores them states in the commit
/// which results changed and why. Use one fingerprint for counts and errors and another for many or large numbers: `Is`
/// tolerates 10⁻⁹ of the sum of all magnitudes, which would hide a small change of an error. Draw inputs one number per
/// expression, because compilers evaluate arguments in different orders.
class Fingerprint {
 public:
  template <typename T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T> Fingerprint& Add(T number) {
    const double value = static_cast<double>(number);
    ++count_;
    sum_ += weights_.Signed() * value;
    size_ += std::abs(value);
    return *this;
  }
  Fingerprint& Add(const glm::dvec2& v) { return Add(v.x).Add(v.y); }
  Fingerprint& Add(const glm::dvec3& v) { return Add(v.x).Add(v.y).Add(v.z); }
  /// Adds a rotation: q and −q give the same fingerprint.
  Fingerprint& Add(const glm::dquat& q) {
    const glm::dmat3 m = glm::mat3_cast(q);
    return Add(m[0]).Add(m[1]).Add(m[2]);
  }
  template <typename T>
  Fingerprint& Add(const std::optional<T>& value) {
    Add(value.has_value());
    return value ? Add(*value) : *this;
  }
  /// Adds the number of elements, then all elements, of vectors, arrays, spans, texts and Eigen's vectors.
  template <std::ranges::range Range>
  Fingerprint& Add(const Range& values) {
    Add(static_cast<std::size_t>(std::ranges::distance(values)));
    for (const auto& value : values) Add(value);
    return *this;
  }

  double sum() const { return sum_; }

  /// Compares the fingerprint with stored values. The counts must be equal; the sums may differ by 10⁻⁹ of the sum of
  /// the magnitudes of all added numbers.
  ::testing::AssertionResult Is(std::size_t count, double sum) const {
    if (count_ == count && std::isfinite(size_) && std::abs(sum_ - sum) <= 1e-9 * size_)
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << fmt::format("{}, {:.12g} instead of {}, {:.12g}", count_, sum_, count, sum);
  }

 private:
  Dice weights_{1};
  std::size_t count_ = 0;
  double sum_ = 0, size_ = 0;
};

}  // namespace etude::testing
