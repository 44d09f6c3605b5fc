#pragma once

#include <bit>
#include <cstdint>

namespace etude {

struct SineCosine {
  double sine = 0, cosine = 1;
};

/// Returns sine and cosine of an angle in radians, for |angle| ≤ 10⁶. The error is at most 1.5 units in the last place
/// for angles up to 100 rad, and 2.5 units for larger angles. The code has no branches, so compilers can compute
/// several angles at once. The result has the same bits with every C library.
///
/// The angle is reduced to r in [−π/4, π/4] by subtracting the nearest multiple of π/2, with π/2 split into three parts
/// (Cody and Waite); the first part is short enough for its multiple to be exact. For r in this interval, the Taylor
/// series up to r¹⁷ (sine) and r¹⁶ (cosine) are accurate to 10⁻¹⁷.
inline SineCosine ComputeSineCosine(double angle) {
  constexpr double kTwoOverPi = 0.6366197723675814;
  constexpr double kFirst = 0x1.921fb544p+0, kSecond = 0x1.0b4611a6p-34, kThird = 0x1.3198a2e037073p-69;
  constexpr double kRounder = 0x1.8p52;  // adding and subtracting it rounds to the nearest integer
  const double shifted = angle * kTwoOverPi + kRounder, quarters = shifted - kRounder;
  const double r = ((angle - quarters * kFirst) - quarters * kSecond) - quarters * kThird;
  const double z = r * r, z2 = z * z, z4 = z2 * z2;
  const double sine_tail =
      (-1.0 / 6 + z * (1.0 / 120)) + z2 * (-1.0 / 5040 + z * (1.0 / 362880)) +
      z4 * ((-1.0 / 39916800 + z * (1.0 / 6227020800)) + z2 * (-1.0 / 1307674368000 + z * (1.0 / 355687428096000)));
  const double cosine_tail = (1.0 / 24 - z * (1.0 / 720)) + z2 * (1.0 / 40320 - z * (1.0 / 3628800)) +
                             z4 * ((1.0 / 479001600 - z * (1.0 / 87178291200)) + z2 * (1.0 / 20922789888000));
  const double sine = r + r * z * sine_tail;
  const double half = 0.5 * z, rounded = 1 - half;
  const double cosine = rounded + (((1 - rounded) - half) + z2 * cosine_tail);
  // The last bits of `shifted` count quarter turns: an odd count swaps sine and cosine, and the second bit decides the
  // signs.
  const auto quarter = std::bit_cast<std::uint64_t>(shifted);
  const auto s = std::bit_cast<std::uint64_t>(sine), c = std::bit_cast<std::uint64_t>(cosine);
  const std::uint64_t swap = (s ^ c) & (0 - (quarter & 1));
  return {std::bit_cast<double>(s ^ swap ^ ((quarter & 2) << 62)),
          std::bit_cast<double>(c ^ swap ^ (((quarter + 1) & 2) << 62))};
}

}  // namespace etude
