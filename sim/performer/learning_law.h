#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// How errors shrink with learning. Since the learner is an invention, a verdict about coaches counts only if it holds
/// under all of them.
enum class LearningLaw {
  kExponential,  ///< Heathcote, Brown and Mewhort (2000): of one person's practice
  kPower,        ///< Newell and Rosenbloom (1981): quick at first, never quite done
  kTwoRate,      ///< Smith, Ghazizadeh and Shadmehr (2006): what is learnt fast is forgotten fast
};
/// "exponential", "power", "two-rate": in the order of the enum.
const std::vector<std::string>& LearningLawNames();
/// `name` must be one of LearningLawNames().
LearningLaw FindLearningLaw(std::string_view name);

/// The constants of the laws.
struct LearningRates {
  /// Of the exponential law: the share of the error that is lost per unit of learning, at first. The power law starts
  /// as steeply (ours).
  double rate = 0.15;
  /// The power law's exponent: (1 + n·rate/exponent)^−exponent after n units (Newell and Rosenbloom report 0.2–0.6).
  double exponent = 0.5;
  // The two states: what is kept from one performance to the next, and what an error teaches (Smith et al., table 1).
  double fast_kept = 0.59, fast_learnt = 0.21;
  double slow_kept = 0.992, slow_learnt = 0.02;
};

/// One skill: how likely one fault of one move still is, and how it got there.
class Skill {
 public:
  /// `error` in [0, 1] is where it starts, `floor` in [0, error] what never goes away.
  Skill(LearningLaw law, double error, double floor = 0, const LearningRates& rates = {});

  double Error() const;
  /// So many units of learning, > 0; a unit is what one trial with knowledge of its result teaches.
  void Learn(double units);
  /// What was learnt is unlearnt: as much as so many units had taught at first.
  void Unlearn(double units);
  /// One performance goes by: the two-rate law forgets.
  void Forget(int performances = 1);

 private:
  LearningLaw law_;
  LearningRates rates_;
  double start_, floor_;
  double units_ = 0;           // exponential, power
  double fast_ = 0, slow_ = 0;  // two-rate
};

}  // namespace etude
