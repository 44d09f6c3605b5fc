#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/motion/body.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/controls.h"
#include "sim/random/stream.h"

namespace etude {

/// Who dances.
enum class People {
  kMixed,        ///< toddlers, school children, adults and experts, thrown
  kToddler,      ///< 1.0–1.1 m tall; follows late and loosely, tires soon
  kSchoolChild,  ///< 1.1–1.6 m
  kAdult,        ///< 1.5–1.9 m
  kExpert,       ///< an adult who dances nearly as taught
  kAbsent,       ///< an adult who stands there and does not take part
};

/// "mixed", "toddler", "school-child", "adult", "expert", "absent": in the order of the enum.
const std::vector<std::string>& PeopleNames();
/// `name` must be one of PeopleNames().
People FindPeople(std::string_view name);

/// Every control's own gain where nothing is made more or less of.
constexpr std::array<double, kControlCount> AllGains(double gain) {
  std::array<double, kControlCount> gains{};
  for (double& each : gains) each = gain;
  return gains;
}

/// One person: what stays the same from move to move. By default the body that the moves were made for, which dances
/// them exactly as taught.
struct Person {
  People kind = People::kExpert;  ///< never kMixed
  double stature_m = 1.7;
  BodyDimensions body = {};
  FloorMove place = {};  ///< where they stand, and which way they face, when the coach is at the origin facing +Z

  double lag_s = 0;         ///< behind what they see, on average
  double lag_spread_s = 0;  ///< from one performance to the next (standard deviation)
  double tempo = 1;         ///< times the move's, where no music keeps the time
  double tempo_spread = 0;  ///< from one performance to the next (of its logarithm)
  double drift = 0;         ///< how far the clock runs uneven within a performance: share of a performance
  double amplitude = 1;     ///< times every angle's distance from the ready stance
  double tiring = 0;        ///< the share of the amplitude that is gone after a minute of dancing

  /// Of each control, times its distance from the ready stance: what this person makes much of, and what little, and
  /// which side is the stronger.
  std::array<double, kControlCount> gains = AllGains(1);
  /// How they hold themselves, in every move and at rest.
  Controls posture = {};
  /// How freely they take a move, 1 = as an adult: the size of what Style adds.
  double looseness = 0;
  std::uint64_t style = 0;  ///< the key of their ways with every move (Style)
};

/// Who stands at this share, in [0, 1), of a mixture in which toddlers come first, then school children, adults and
/// experts.
People KindInMixture(double share);

/// Throws a person, their own dice in each world. What a preset changes is sizes: one throw of the dice makes the same
/// kind of toddler as of adult.
Person DrawPerson(const WorldKey& key, People people);

/// What is left of the amplitude after so many seconds of dancing: falls, but never below a half.
double VigourAfter(const Person& person, double danced_s);

/// The sizes of a body of this stature, metres. `childhood` is 0 for an adult's proportions, 1 for those of a child of
/// four: shorter legs, a longer trunk, a larger head. Shares of stature: an adult's after Drillis and Contini (1966),
/// as the canonical body's; a child's after Snyder et al., "Anthropometry of infants, children and youths to age 18"
/// (1977), rounded.
BodyDimensions DimensionsOf(double stature_m, double childhood);

}  // namespace etude
