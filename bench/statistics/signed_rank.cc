#include <algorithm>
#include <cmath>
#include <vector>

#include "bench/statistics/distributions.h"
#include "bench/statistics/paired_tests.h"

namespace etude {
namespace {

constexpr std::size_t kMostExact = 50;

/// Twice the rank of |difference| for each difference other than zero, so that tied ranks are whole too.
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
    const int doubled = static_cast<int>(first + 1 + end);  // mean of the ranks first + 1 … end, twice
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

/// P(W ≤ w) or P(W ≥ w), whichever is smaller, over all signs of these ranks.
double ExactTail(const std::vector<int>& ranks, double w) {
  const auto total = static_cast<std::size_t>(SumOf(ranks));
  std::vector<double> ways(total + 1);  // counts up to 2⁵⁰: whole numbers all
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
  // Each rank is in or out with probability ½: mean Σr / 2, variance Σr² / 4, whatever is tied. Half a rank towards
  // the mean for continuity; ranks are doubled.
  const double distance = std::max(std::abs(w - SumOf(ranks) / 2) - 1, 0.0);
  return KeepThirtyBits(NormalCdf(-distance / std::sqrt(squares / 4)));
}

}  // namespace

PairedTest SignedRankTest(std::span<const double> differences) {
  if (differences.empty()) return {};
  const SignedRanks ranks = Rank(differences);
  std::vector<int> all = ranks.positive;
  all.insert(all.end(), ranks.negative.begin(), ranks.negative.end());
  if (all.empty()) return {1.0, "exact"};
  const bool exact = all.size() <= kMostExact;
  const double w = SumOf(ranks.positive);
  const double tail = exact ? ExactTail(all, w) : NormalTail(all, w);
  return {std::min(2 * tail, 1.0), exact ? "exact" : "normal approximation"};
}

double RankBiserial(std::span<const double> differences) {
  const SignedRanks ranks = Rank(differences);
  const double positive = SumOf(ranks.positive), negative = SumOf(ranks.negative);
  return positive + negative == 0 ? 0 : (positive - negative) / (positive + negative);
}

}  // namespace etude
