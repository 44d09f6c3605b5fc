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

/// How many numbers a computation gave, and their sum under fixed weights in [−1, 1): golden values of a whole result
/// in two numbers. It changes when any of the numbers does, or when one is added, left out, or stands elsewhere. It
/// says that something changed, not what: it stands beside tests that say what is right. A failure prints the numbers
/// to keep; who keeps others says in the commit which results changed and why. Counts and errors have a print apart
/// from that of many or large numbers, a billionth of which would hide them. Input is drawn one number an expression:
/// compilers differ in the order of arguments.
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
  /// Of a rotation: q and −q are the same.
  Fingerprint& Add(const glm::dquat& q) {
    const glm::dmat3 m = glm::mat3_cast(q);
    return Add(m[0]).Add(m[1]).Add(m[2]);
  }
  template <typename T>
  Fingerprint& Add(const std::optional<T>& value) {
    Add(value.has_value());
    return value ? Add(*value) : *this;
  }
  /// All elements of vectors, arrays, spans, texts and Eigen's vectors, after their number.
  template <std::ranges::range Range>
  Fingerprint& Add(const Range& values) {
    Add(static_cast<std::size_t>(std::ranges::distance(values)));
    for (const auto& value : values) Add(value);
    return *this;
  }

  double sum() const { return sum_; }

  /// Whether it is as it was kept: as many numbers, and their sum to 10⁻⁹ of what they amount to.
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
