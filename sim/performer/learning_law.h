#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// The law by which errors shrink with learning. Since the learner is an invention, a verdict about coaches counts only
/// if it holds under all of them.
enum class LearningLaw {
  kExponential,  ///< Heathcote, Brown and Mewhort (2000): of one person's practice
  kPower,        ///< Newell and Rosenbloom (1981): quick at first, never quite done
  kTwoRate,      ///< Smith, Ghazizadeh and Shadmehr (2006): what is learnt fast is forgotten fast
};
/// Returns the names "exponential", "power", "two-rate", in the order of the enum.
const std::vector<std::string>& LearningLawNames();
/// Returns the law of a name, which must be one of LearningLawNames().
LearningLaw FindLearningLaw(std::string_view name);

/// The constants of the laws.
struct LearningRates {
  /// The share of the error that is lost per unit of learning at first, under the exponential law. The power law starts
  /// as steeply (ours).
  double rate = 0.15;
  /// The power law's exponent: (1 + n·rate/exponent)^−exponent after n units (Newell and Rosenbloom report 0.2–0.6).
  double exponent = 0.5;
  // The two states: what is kept from one performance to the next, and what an error teaches (Smith et al., table 1).
  double fast_kept = 0.59, fast_learnt = 0.21;
  double slow_kept = 0.992, slow_learnt = 0.02;
};

/// A skill: the likelihood of one fault of one move, and the learning that led to it.
class Skill {
 public:
  /// The skill starts at `error` in [0, 1]; `floor` in [0, error] never goes away.
  Skill(LearningLaw law, double error, double floor = 0, const LearningRates& rates = {});

  double Error() const;
  /// Lets one performance go by, which teaches `units` (in [0, 1]; a unit is what a trial with knowledge of its result
  /// does). Under the two-rate law it makes forget, too.
  void Practise(double units);
  /// Adds what somebody else teaches between performances, ≥ 0 units.
  void Learn(double units);
  /// Loses what so many units had taught at first.
  void Unlearn(double units);
  /// Lets the time of this many performances pass.
  void Rest(int performances);

 private:
  LearningLaw law_;
  LearningRates rates_;
  double start_, floor_;
  double units_ = 0;            // exponential, power
  double fast_ = 0, slow_ = 0;  // two-rate
};

}  // namespace etude
