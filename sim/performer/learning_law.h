#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// The law by which errors decrease with learning. The learner is a model of ours, so a verdict about coaches counts
/// only if it holds under all three laws.
enum class LearningLaw {
  kExponential,  ///< Heathcote, Brown and Mewhort (2000): practice of one person
  kPower,        ///< Newell and Rosenbloom (1981): fast at first, with a long tail
  kTwoRate,      ///< Smith, Ghazizadeh and Shadmehr (2006): a fast and a slow process, which both learn and forget
};
/// Returns the names "exponential", "power", "two-rate", in the order of the enum.
const std::vector<std::string>& LearningLawNames();
/// Returns the law with this name, which must be one of LearningLawNames().
LearningLaw FindLearningLaw(std::string_view name);

/// The constants of the laws.
struct LearningRates {
  /// The relative decrease of the error per unit of learning under the exponential law. The power law begins with the
  /// same decrease (ours).
  double rate = 0.15;
  /// The exponent of the power law: after n units, the error is multiplied by (1 + n·rate/exponent)^−exponent (Newell
  /// and Rosenbloom report exponents of 0.2–0.6).
  double exponent = 0.5;
  // For each of the two states: the share of the state that is kept from one performance to the next, and the share of
  // an error that is learnt (Smith et al., table 1).
  double fast_kept = 0.59, fast_learnt = 0.21;
  double slow_kept = 0.992, slow_learnt = 0.02;
};

/// A skill: the probability of one fault of one move, which decreases with the learning so far.
class Skill {
 public:
  /// The error starts at `error`, in [0, 1], and never falls below `floor`, in [0, error].
  Skill(LearningLaw law, double error, double floor = 0, const LearningRates& rates = {});

  /// Returns the present probability of the fault, in [floor, error].
  double Error() const;
  /// Records one performance, from which the person learns `units`, in [0, 1]. One unit is the learning from one trial
  /// with knowledge of results. Under the two-rate law, a performance also causes forgetting.
  void Practise(double units);
  /// Adds `units` ≥ 0 of learning between performances: the coach's corrections and demonstrations.
  void Learn(double units);
  /// Removes `units` of learning. Under the two-rate law both states are multiplied by exp(−rate · units).
  void Unlearn(double units);
  /// Lets the time of `performances` performances pass without practice.
  void Rest(int performances);

 private:
  LearningLaw law_;
  LearningRates rates_;
  double start_, floor_;
  double units_ = 0;            // learning so far under the exponential law or the power law
  double fast_ = 0, slow_ = 0;  // states of the two-rate law
};

}  // namespace etude
