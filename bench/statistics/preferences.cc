#include "bench/statistics/preferences.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <span>

#include "bench/statistics/bootstrap_units.h"
#include "bench/statistics/distributions.h"

namespace etude {
namespace {

constexpr int kMaxPasses = 10'000;
constexpr double kSettled = 1e-12;
constexpr double kOneSided = 0.01;

/// The answers of one rater, counted as wins of methods and as choices of the left and the right side.
struct Rater {
  WinTable wins;
  int left = 0, decided = 0;
};

/// For each pair of films on a page, the raters' votes: left minus right.
using Votes = std::vector<int>;

WinTable EmptyTable(std::size_t items) { return {items, std::vector<double>(items)}; }

void AddTo(WinTable& sum, const WinTable& wins) {
  for (std::size_t i = 0; i < wins.size(); ++i) {
    for (std::size_t j = 0; j < wins.size(); ++j) sum[i][j] += wins[i][j];
  }
}

/// Returns, for each item, the probability that the item is preferred, averaged over the items with which it was
/// compared.
std::vector<std::optional<double>> SharesOf(const WinTable& wins) {
  const std::vector<double> strengths = FitBradleyTerry(wins);
  std::vector<std::optional<double>> shares(wins.size());
  for (std::size_t i = 0; i < wins.size(); ++i) {
    double sum = 0;
    int rivals = 0;
    for (std::size_t j = 0; j < wins.size(); ++j) {
      if (i == j || wins[i][j] + wins[j][i] == 0) continue;
      sum += strengths[i] / (strengths[i] + strengths[j]);
      ++rivals;
    }
    if (rivals > 0) shares[i] = KeepThirtyBits(sum / rivals);
  }
  return shares;
}

std::vector<std::optional<double>> SharesOf(std::span<const Rater* const> raters) {
  WinTable wins = EmptyTable(raters.front()->wins.size());
  for (const Rater* rater : raters) AddTo(wins, rater->wins);
  return SharesOf(wins);
}

/// Returns 1 if the metric is better for the left film, −1 for the right one, and 0 for values that differ by rounding
/// at most.
int BetterSide(const BlindKey::Metric& metric, double left, double right) {
  constexpr double kRounding = 1e-9;
  if (std::abs(left - right) <= kRounding * std::max(std::abs(left), std::abs(right))) return 0;
  return (left > right) == metric.higher_is_better ? 1 : -1;
}

void AddPair(const BlindKey::Pair& pair, int votes, std::vector<MetricAgreement>& metrics) {
  for (const BlindKey::Metric& metric : pair.metrics) {
    auto found = std::ranges::find(metrics, metric.id, &MetricAgreement::metric);
    if (found == metrics.end()) found = metrics.insert(metrics.end(), {.metric = metric.id});
    if (votes == 0) continue;
    const bool has_both = metric.left && metric.right;
    const int better = has_both ? BetterSide(metric, *metric.left, *metric.right) : 0;
    found->missing += !has_both;
    found->equal += has_both && better == 0;
    found->decided += better != 0;
    found->agreed += better * votes > 0;
  }
}

}  // namespace

std::vector<double> FitBradleyTerry(const WinTable& wins) {
  const std::size_t items = wins.size();
  std::vector<double> strengths(items, 1.0 / static_cast<double>(items)), next(items);
  for (int pass = 0; pass < kMaxPasses; ++pass) {
    for (std::size_t i = 0; i < items; ++i) {
      double won = 0, expected = 0;
      for (std::size_t j = 0; j < items; ++j) {
        const double sum = strengths[i] + strengths[j];
        if (i == j || sum == 0) continue;
        won += wins[i][j];
        expected += (wins[i][j] + wins[j][i]) / sum;
      }
      next[i] = expected > 0 ? won / expected : strengths[i];
    }
    const double total = std::accumulate(next.begin(), next.end(), 0.0);
    double change = 0;
    for (std::size_t i = 0; i < items; ++i) {
      next[i] /= total > 0 ? total : 1;
      change = std::max(change, std::abs(next[i] - strengths[i]));
    }
    strengths.swap(next);
    if (change < kSettled) break;
  }
  return strengths;
}

Preferences MeasurePreferences(const BlindFiles& files, std::uint64_t seed) {
  Preferences found;
  // Give every method an index.
  std::vector<std::string> names;
  for (const BlindKey& key : files.keys) {
    found.pairs += static_cast<int>(key.pairs.size());
    for (const BlindKey::Pair& pair : key.pairs) names.insert(names.end(), {pair.left, pair.right});
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const auto index_of = [&](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::lower_bound(names, name) - names.begin());
  };
  // Count the answers, by rater and by pair.
  std::map<std::string, Rater> raters;
  std::map<std::string, Votes> votes;
  for (const BlindKey& key : files.keys) votes[key.page].resize(key.pairs.size());
  for (const BlindAnswers& answers : files.answers) {
    const BlindKey& key = *std::ranges::find(files.keys, answers.page, &BlindKey::page);
    Rater& rater = raters.try_emplace(answers.rater, Rater{EmptyTable(names.size())}).first->second;
    for (std::size_t i = 0; i < key.pairs.size(); ++i) {
      const std::string& preferred = answers.preferred[i];
      const std::size_t left = index_of(key.pairs[i].left), right = index_of(key.pairs[i].right);
      const bool is_left = preferred == "left", is_right = preferred == "right";
      found.same += preferred == "same";
      (preferred.empty() ? found.without : found.answers) += 1;
      if (preferred.empty()) continue;
      rater.wins[left][right] += is_left ? 1 : is_right ? 0 : 0.5;
      rater.wins[right][left] += is_right ? 1 : is_left ? 0 : 0.5;
      rater.left += is_left;
      rater.decided += is_left || is_right;
      votes[key.page][i] += is_left - is_right;
    }
  }
  found.raters = static_cast<int>(raters.size());
  // Summarise the methods, and find raters who mostly chose one side.
  std::vector<const Rater*> all;
  WinTable wins = EmptyTable(names.size());
  for (const auto& [name, rater] : raters) {
    all.push_back(&rater);
    AddTo(wins, rater.wins);
    const int most = std::max(rater.left, rater.decided - rater.left);
    if (2 * FairCoinUpperTail(most, rater.decided) < kOneSided) {
      found.one_sided.push_back({name, rater.left, rater.decided});
    }
  }
  const auto shares = SharesOf(wins);
  const auto of_raters = [](std::span<const Rater* const> some) { return SharesOf(some); };
  const auto intervals = BootstrapUnits<const Rater*>(all, shares, {{seed, "bootstrap", 0}, "raters"}, of_raters);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double won = std::accumulate(wins[i].begin(), wins[i].end(), 0.0);
    double lost = 0;
    for (const std::vector<double>& row : wins) lost += row[i];
    found.methods.push_back({names[i], won, won + lost, shares[i], intervals[i]});
  }
  std::ranges::stable_sort(found.methods, std::greater(), &PreferredMethod::share);
  // Count how often each metric agrees with the raters.
  for (const BlindKey& key : files.keys) {
    for (std::size_t i = 0; i < key.pairs.size(); ++i) AddPair(key.pairs[i], votes[key.page][i], found.metrics);
  }
  for (MetricAgreement& metric : found.metrics) {
    if (metric.decided > 0) metric.interval = WilsonInterval(metric.agreed, metric.decided);
  }
  std::ranges::stable_sort(found.metrics, [](const MetricAgreement& a, const MetricAgreement& b) {
    return std::int64_t{a.agreed} * std::max(b.decided, 1) > std::int64_t{b.agreed} * std::max(a.decided, 1);
  });
  return found;
}

}  // namespace etude
