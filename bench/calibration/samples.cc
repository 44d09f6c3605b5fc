#include "bench/calibration/samples.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "bench/statistics/distributions.h"

namespace etude {
namespace {

constexpr double kUntied = 0.4;
/// Of the logarithm of a cost: seven of ten lie below.
double LogLimit() {
  static const double limit = NormalQuantile(0.7);
  return limit;
}

/// Of t₃, scaled to a standard deviation of one.
double HeavyTailed(RandomStream& dice) {
  double squares = 0;
  for (int i = 0; i < 3; ++i) {
    const double normal = dice.Normal();
    squares += normal * normal;
  }
  return dice.Normal() / std::sqrt(squares);
}

double Draw(SampleLaw law, RandomStream& dice) {
  return law == SampleLaw::kHeavyTailed ? HeavyTailed(dice) : dice.Normal();
}

/// −1, 0 or 1 by a quarter, a half and a quarter, as two fair coins differ; shifted by `effect` in the mean.
double CoinsDiffer(double effect, RandomStream& dice) {
  const double throw_of_dice = dice.Uniform();
  return throw_of_dice < 0.25 - effect / 2 ? -1 : throw_of_dice >= 0.75 - effect / 2 ? 1 : 0;
}

double PenalisedCost(double log_cost) { return log_cost > LogLimit() ? 2 * std::exp(LogLimit()) : std::exp(log_cost); }

/// Expectations of a penalised cost whose logarithm is normal around `shift`, and of its square.
double MeanCost(double shift) {
  const double below = LogLimit() - shift;
  return std::exp(shift + 0.5) * NormalCdf(below - 1) + 2 * std::exp(LogLimit()) * NormalCdf(-below);
}
double MeanSquaredCost() { return std::exp(2.0) * NormalCdf(LogLimit() - 2) + 4 * std::exp(2 * LogLimit()) * 0.3; }

/// The shift of the logarithm that changes the mean cost by `effect`, by bisection.
double ShiftFor(double effect) {
  double low = -20, high = 20;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (MeanCost(middle) - MeanCost(0) < effect ? low : high) = middle;
  }
  return low;
}

/// The worlds of a design, told apart by what a unit brings to each of its worlds.
class Sampler {
 public:
  Sampler(const SampleDesign& design, double effect, RandomStream& dice)
      : design_(design),
        effect_(effect * JustMatters(design.law)),
        shift_(design.law == SampleLaw::kCensored ? ShiftFor(effect_) : 0),
        dice_(dice) {
    for (int unit = 0; unit < design.units; ++unit) {
      sample_.names.push_back(fmt::format("{:03}", unit));
      Brings& brings = brings_.emplace_back();
      for (double& value : brings.own) value = Draw(design.law, dice);
      for (std::size_t i = 0; i < 2; ++i) {
        const double fresh = Draw(design.law, dice), r = design.part_alike;
        brings.other[i] = r * brings.own[i] + std::sqrt(1 - r * r) * fresh;
      }
      brings.coins = CoinsDiffer(effect_, dice);
    }
  }

  UnitSample Draws() {
    if (!design_.in_pairs) {
      for (int unit = 0; unit < design_.units; ++unit) {
        for (int trial = 0; trial < design_.trials; ++trial) AddWorld({unit});
      }
    } else {
      for (int trial = 0; trial < design_.trials; ++trial) {
        const int left = trial % design_.units;
        const int step = 1 + static_cast<int>(dice_.IndexBelow(static_cast<std::uint64_t>(design_.units - 1)));
        AddWorld({left, (left + step) % design_.units});
      }
    }
    return std::move(sample_);
  }

 private:
  struct Brings {
    std::array<double, 2> own{}, other{};  ///< of the method and of the baseline
    double coins = 0;
  };

  /// A standardised value that worlds of one unit share in part.
  double Latent(const std::vector<int>& units, std::size_t of) {
    const Brings& first = brings_[static_cast<std::size_t>(units.front())];
    double shared = first.own[of];
    if (units.size() > 1) shared = (shared + brings_[static_cast<std::size_t>(units[1])].other[of]) / std::sqrt(2.0);
    return std::sqrt(design_.alike) * shared + std::sqrt(1 - design_.alike) * Draw(design_.law, dice_);
  }

  double Difference(const std::vector<int>& units) {
    switch (design_.law) {
      case SampleLaw::kNormal:
      case SampleLaw::kHeavyTailed:
        return effect_ + Latent(units, 0);
      case SampleLaw::kTies: {
        const double untied = effect_ / kUntied + Latent(units, 0);
        return dice_.Chance(kUntied) ? untied : 0;
      }
      case SampleLaw::kShares:
        // Worlds that both took their unit's throw are equal: they correlate by the square of that chance.
        return dice_.Chance(std::sqrt(design_.alike)) ? brings_[static_cast<std::size_t>(units.front())].coins
                                                      : CoinsDiffer(effect_, dice_);
      case SampleLaw::kCensored:
        break;
    }
    const double method = PenalisedCost(Latent(units, 0) + shift_);
    return method - PenalisedCost(Latent(units, 1));
  }

  void AddWorld(std::vector<int> units) {
    sample_.differences.push_back(KeepThirtyBits(Difference(units)));
    sample_.units.push_back(std::move(units));
  }

  const SampleDesign& design_;
  const double effect_, shift_;
  RandomStream& dice_;
  std::vector<Brings> brings_;
  UnitSample sample_;
};

}  // namespace

std::string_view SampleLawName(SampleLaw law) {
  switch (law) {
    case SampleLaw::kNormal:
      return "normal";
    case SampleLaw::kHeavyTailed:
      return "t₃";
    case SampleLaw::kTies:
      return "ties";
    case SampleLaw::kShares:
      return "shares";
    case SampleLaw::kCensored:
      break;
  }
  return "censored";
}

double JustMatters(SampleLaw law) {
  switch (law) {
    case SampleLaw::kNormal:
    case SampleLaw::kHeavyTailed:
      return 1.0 / 3;
    case SampleLaw::kTies:
      return std::sqrt(kUntied) / 3;
    case SampleLaw::kShares:
      return std::sqrt(0.5) / 6;
    case SampleLaw::kCensored:
      break;
  }
  return std::sqrt(2 * (MeanSquaredCost() - MeanCost(0) * MeanCost(0))) / 6;
}

UnitSample DrawSample(const SampleDesign& design, double effect, RandomStream& dice) {
  return Sampler(design, effect, dice).Draws();
}

}  // namespace etude
