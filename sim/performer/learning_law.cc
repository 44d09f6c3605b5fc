#include "sim/performer/learning_law.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/named.h"

namespace etude {
namespace {

constexpr std::array<Named<LearningLaw>, 3> kLaws = {
    {{"exponential", LearningLaw::kExponential}, {"power", LearningLaw::kPower}, {"two-rate", LearningLaw::kTwoRate}}};

}  // namespace

const std::vector<std::string>& LearningLawNames() {
  static const std::vector<std::string> names = NamesOf(kLaws);
  return names;
}

LearningLaw FindLearningLaw(std::string_view name) { return ValueNamed(kLaws, name); }

Skill::Skill(LearningLaw law, double error, double floor, const LearningRates& rates)
    : law_(law), rates_(rates), start_(error), floor_(floor) {
  assert(0 <= floor && floor <= error && error <= 1);
}

double Skill::Error() const {
  const auto left = [&](double share) { return floor_ + (start_ - floor_) * share; };
  switch (law_) {
    case LearningLaw::kExponential:
      return left(std::exp(-rates_.rate * units_));
    case LearningLaw::kPower:
      return left(std::pow(1 + units_ * rates_.rate / rates_.exponent, -rates_.exponent));
    case LearningLaw::kTwoRate:
      return left(1 - fast_ - slow_);
  }
  return start_;
}

void Skill::Practise(double units) {
  units_ += units;
  const double error = 1 - fast_ - slow_;
  fast_ = rates_.fast_kept * fast_ + units * rates_.fast_learnt * error;
  slow_ = rates_.slow_kept * slow_ + units * rates_.slow_learnt * error;
}

void Skill::Learn(double units) {
  units_ += units;
  // Apply the units one at a time, each to the error that remains: otherwise learning could remove more error than is
  // left.
  for (double rest = units; rest > 0; rest -= 1) {
    const double share = std::min(rest, 1.0), error = 1 - fast_ - slow_;
    fast_ += share * rates_.fast_learnt * error;
    slow_ += share * rates_.slow_learnt * error;
  }
}

void Skill::Unlearn(double units) {
  units_ = std::max(0.0, units_ - units);
  const double kept = std::exp(-rates_.rate * units);
  fast_ *= kept;
  slow_ *= kept;
}

void Skill::Rest(int performances) {
  fast_ *= std::pow(rates_.fast_kept, performances);
  slow_ *= std::pow(rates_.slow_kept, performances);
}

}  // namespace etude
