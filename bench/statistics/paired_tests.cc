#include "bench/statistics/paired_tests.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/distributions.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

/// The largest number of non-zero differences for which the p-value of the ranks is exact; for more, a normal
/// approximation is used. Counts of sign vectors up to 2⁵⁰ are exact in a double.
constexpr std::size_t kMaxExactRanks = 50;

/// Twice the rank of |difference| for each non-zero difference. Doubling makes the mean ranks of ties integers.
struct SignedRanks {
  std::vector<int> positive, negative;
};

SignedRanks Rank(std::span<const double> differences) {
  std::vector<double> ordered(differences.begin(), differences.end());
  std::sort(ordered.begin(), ordered.end(),
            [](double a, double b) { return std::abs(a) != std::abs(b) ? std::abs(a) < std::abs(b) : a < b; });
  SignedRanks ranks;
  for (std::size_t first = 0; first < ordered.size();) {
    std::size_t end = first;
    while (end < ordered.size() && std::abs(ordered[end]) == std::abs(ordered[first])) ++end;
    const int doubled = static_cast<int>(first + 1 + end);  // twice the mean of the ranks first + 1 … end
    for (; first < end; ++first) {
      if (ordered[first] != 0) (ordered[first] > 0 ? ranks.positive : ranks.negative).push_back(doubled);
    }
  }
  return ranks;
}

double SumOf(const std::vector<int>& ranks) {
  double sum = 0;
  for (int rank : ranks) sum += rank;
  return sum;
}

/// Returns the smaller of P(W ≤ w) and P(W ≥ w) over all signs of these ranks (shift algorithm).
double ExactTail(const std::vector<int>& ranks, double w) {
  const auto total = static_cast<std::size_t>(SumOf(ranks));
  std::vector<double> ways(total + 1);  // for each sum of positive ranks, the number of sign vectors; at most 2⁵⁰
  ways[0] = 1;
  std::size_t reached = 0;
  for (int rank : ranks) {
    reached += rank;
    for (std::size_t sum = reached; sum >= static_cast<std::size_t>(rank); --sum) ways[sum] += ways[sum - rank];
  }
  const auto end = static_cast<std::size_t>(std::min(w, static_cast<double>(total) - w));
  double tail = 0;
  for (std::size_t sum = 0; sum <= end; ++sum) tail += ways[sum];
  return std::ldexp(tail, -static_cast<int>(ranks.size()));
}

double NormalTail(const std::vector<int>& ranks, double w) {
  double squares = 0;
  for (int rank : ranks) squares += static_cast<double>(rank) * rank;
  // Each rank is positive with probability ½, so the mean is Σr / 2 and the variance Σr² / 4, with or without ties. The
  // continuity correction moves w by half a rank towards the mean; with doubled ranks, it is 1.
  const double distance = std::max(std::abs(w - SumOf(ranks) / 2) - 1, 0.0);
  return KeepThirtyBits(NormalCdf(-distance / std::sqrt(squares / 4)));
}

/// The largest number of non-zero differences for which all 2ⁿ⁻¹ sign vectors are enumerated. For more differences,
/// kDraws sign vectors are drawn.
constexpr std::size_t kMaxEnumerated = 16;
constexpr int kDraws = 9999;

/// Differences up to this share of the largest difference count as rounding errors.
constexpr double kRounding = 1e-12;

/// The signs of the differences, one bit each: 1 = negative.
using Signs = std::vector<std::uint64_t>;

/// Returns the index of the n-th bit that is 1 in `signs`. If all bits of `flip` are 1, returns the index of the n-th
/// bit that is 0.
std::size_t IndexOfNth(const Signs& signs, std::size_t n, std::uint64_t flip) {
  for (std::size_t word = 0;; ++word) {
    std::uint64_t bits = signs[word] ^ flip;
    const auto count = static_cast<std::size_t>(std::popcount(bits));
    if (n >= count) {
      n -= count;
      continue;
    }
    for (; n > 0; --n) bits &= bits - 1;
    return 64 * word + static_cast<std::size_t>(std::countr_zero(bits));
  }
}

/// The absolute differences |d| in ascending order, zeros first. The class computes the aggregate of the differences
/// under any signs.
class FlippedSample {
 public:
  FlippedSample(std::vector<double> sizes, Aggregate aggregate) : sizes_(std::move(sizes)), aggregate_(aggregate) {
    if (aggregate == Aggregate::kMean) SumBytes();
  }

  std::size_t words() const { return (sizes_.size() + 63) / 64; }

  double AggregateUnder(const Signs& signs) const {
    return aggregate_ == Aggregate::kMedian ? MedianUnder(signs) : MeanUnder(signs);
  }

 private:
  /// Precomputes the sum of each group of eight differences |d| under all 256 signs. The mean of a draw then needs an
  /// eighth of the additions.
  void SumBytes() {
    byte_sums_.resize((sizes_.size() + 7) / 8);
    for (std::size_t byte = 0; byte < byte_sums_.size(); ++byte) {
      for (std::size_t signs = 0; signs < 256; ++signs) {
        double sum = 0;
        for (std::size_t bit = 0; bit < 8 && 8 * byte + bit < sizes_.size(); ++bit) {
          sum += (signs >> bit) & 1 ? -sizes_[8 * byte + bit] : sizes_[8 * byte + bit];
        }
        byte_sums_[byte][signs] = sum;
      }
    }
  }

  double MeanUnder(const Signs& signs) const {
    double sum = 0;
    for (std::size_t byte = 0; byte < byte_sums_.size(); ++byte) {
      sum += byte_sums_[byte][(signs[byte / 8] >> (8 * (byte % 8))) & 0xff];
    }
    return sum / static_cast<double>(sizes_.size());
  }

  /// Returns the median under the given signs. In sorted order the negative values come first, from the largest |d| to
  /// the smallest, then the positive values from the smallest |d| to the largest. The middle value has a small |d|, so
  /// a short walk over the bits finds it.
  double MedianUnder(const Signs& signs) const {
    std::size_t negatives = 0;
    for (std::uint64_t bits : signs) negatives += static_cast<std::size_t>(std::popcount(bits));
    const auto at = [&](std::size_t i) {
      return i < negatives ? -sizes_[IndexOfNth(signs, negatives - 1 - i, 0)]
                           : sizes_[IndexOfNth(signs, i - negatives, ~std::uint64_t{0})];
    };
    return 0.5 * (at((sizes_.size() - 1) / 2) + at(sizes_.size() / 2));
  }

  std::vector<double> sizes_;
  Aggregate aggregate_;
  std::vector<std::array<double, 256>> byte_sums_;
};

/// Tests a large number of differences by a normal approximation of the sign-flip test. A mean has variance Σd² / n².
/// For a median, the numbers of differences above and below zero are compared (sign test).
PairedTest ManyFlips(std::span<const double> sizes, const Signs& signs, Aggregate aggregate) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] == 0) continue;
    const double size = aggregate == Aggregate::kMean ? sizes[i] : 1;
    sum += (signs[i / 64] >> (i % 64)) & 1 ? -size : size;
    squares += size * size;
  }
  return {KeepThirtyBits(2 * NormalCdf(-std::abs(sum) / std::sqrt(squares))), "normal approximation"};
}

}  // namespace

PairedTest SignedRankTest(std::span<const double> differences) {
  if (differences.empty()) return {};
  const SignedRanks ranks = Rank(differences);
  std::vector<int> all = ranks.positive;
  all.insert(all.end(), ranks.negative.begin(), ranks.negative.end());
  if (all.empty()) return {1.0, "exact"};
  const bool exact = all.size() <= kMaxExactRanks;
  const double w = SumOf(ranks.positive);
  const double tail = exact ? ExactTail(all, w) : NormalTail(all, w);
  return {std::min(2 * tail, 1.0), exact ? "exact" : "normal approximation"};
}

double RankBiserial(std::span<const double> differences) {
  const SignedRanks ranks = Rank(differences);
  const double positive = SumOf(ranks.positive), negative = SumOf(ranks.negative);
  return positive + negative == 0 ? 0 : (positive - negative) / (positive + negative);
}

PairedTest SignFlipTest(std::span<const double> differences, Aggregate aggregate, std::uint64_t seed,
                        const std::string& purpose) {
  if (differences.empty()) return {};
  std::vector<double> ordered(differences.begin(), differences.end());
  // Sort the differences by |d|, and separate |d| from the signs.
  std::sort(ordered.begin(), ordered.end(),
            [](double a, double b) { return std::abs(a) != std::abs(b) ? std::abs(a) < std::abs(b) : a < b; });
  std::vector<double> sizes;
  Signs observed((ordered.size() + 63) / 64);
  std::size_t zeros = 0, negatives = 0;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    sizes.push_back(std::abs(ordered[i]));
    zeros += ordered[i] == 0;
    negatives += ordered[i] < 0;
    if (ordered[i] < 0) observed[i / 64] |= std::uint64_t{1} << (i % 64);
  }
  const std::size_t differing = sizes.size() - zeros;
  if (differing == 0) return {1.0, "exact"};
  const double largest = sizes.back();
  // If all differences have the same sign, only two sign vectors (all plus, all minus) give a mean as far from zero as
  // the observed one. Drawn sign vectors could not show how small this p is, so it would not pass Holm's correction
  // among many comparisons. Differences within rounding do not move the mean, so their signs do not count.
  const double rounding = kRounding * largest;
  const auto real = std::ranges::find_if(ordered, [&](double d) { return std::abs(d) > rounding; });
  const auto below = std::count_if(real, ordered.end(), [](double d) { return d < 0; }), count = ordered.end() - real;
  constexpr std::ptrdiff_t kMaxExponent = 1000;  // 2 / 2ⁿ must not underflow; for more differences, p is even smaller
  if (aggregate == Aggregate::kMean && (below == 0 || below == count)) {
    return {SmallestP(static_cast<int>(std::min(count, kMaxExponent))), "exact"};
  }
  // If all differences have the same size, the binomial distribution gives the exact p of the mean.
  if (aggregate == Aggregate::kMean && sizes[zeros] == largest) {
    const auto more = static_cast<int>(std::max(negatives, differing - negatives));
    return {std::min(1.0, KeepThirtyBits(2 * FairCoinUpperTail(more, static_cast<int>(differing)))), "exact"};
  }

  if (static_cast<int>(differing) > kMaxResampled) return ManyFlips(sizes, observed, aggregate);
  const FlippedSample sample(std::move(sizes), aggregate);
  // Allow a small tolerance, because sums that are equal in exact arithmetic may differ by rounding.
  const double reached = std::abs(sample.AggregateUnder(observed)) - rounding;
  Signs signs(sample.words());
  if (differing <= kMaxEnumerated) {
    // If few differences are non-zero, enumerate all sign vectors. A vector and its negative give aggregates equally
    // far from zero, so half of the vectors are enough.
    const std::uint32_t all = std::uint32_t{1} << (differing - 1);
    int extreme = 0;
    for (std::uint32_t bits = 0; bits < all; ++bits) {
      for (std::size_t i = 0; i < differing; ++i) {
        const std::size_t at = zeros + i;
        const std::uint64_t mask = std::uint64_t{1} << (at % 64);
        signs[at / 64] = (bits >> i) & 1 ? signs[at / 64] | mask : signs[at / 64] & ~mask;
      }
      extreme += std::abs(sample.AggregateUnder(signs)) >= reached;
    }
    return {static_cast<double>(extreme) / all, "exact"};
  }
  // Otherwise draw sign vectors.
  RandomStream dice({.suite_seed = seed, .scenario = "sign-flip", .trial = 0}, purpose);
  // Set the bits behind the last difference to 0; otherwise they would count as negative differences.
  const std::uint64_t last =
      ordered.size() % 64 == 0 ? ~std::uint64_t{0} : (std::uint64_t{1} << (ordered.size() % 64)) - 1;
  int extreme = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    dice.FillBits(signs);
    signs.back() &= last;
    extreme += std::abs(sample.AggregateUnder(signs)) >= reached;
  }
  return {(extreme + 1.0) / (kDraws + 1.0), "9,999 draws"};
}

double SmallestP(int differing) { return std::ldexp(1.0, std::min(1 - differing, 0)); }

int PairsNeeded(int comparisons, double alpha) {
  int pairs = 1;
  while (SmallestP(pairs) * comparisons > alpha) ++pairs;
  return pairs;
}

}  // namespace etude
