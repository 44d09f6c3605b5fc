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

/// The kinds of people who dance.
enum class People {
  kMixed,        ///< toddlers, school children, adults and experts, thrown
  kToddler,      ///< 1.0–1.1 m tall; follows late and loosely, tires soon
  kSchoolChild,  ///< 1.1–1.6 m
  kAdult,        ///< 1.5–1.9 m
  kExpert,       ///< an adult who dances nearly as taught
  kAbsent,       ///< an adult who stands there and does not take part
};

/// Returns the names "mixed", "toddler", "school-child", "adult", "expert", "absent", in the order of the enum.
const std::vector<std::string>& PeopleNames();
/// Returns the kind of a name, which must be one of PeopleNames().
People FindPeople(std::string_view name);

/// Returns the same gain for every control.
constexpr std::array<double, kControlCount> AllGains(double gain) {
  std::array<double, kControlCount> gains{};
  for (double& each : gains) each = gain;
  return gains;
}

/// A person, as far as they stay the same from move to move. By default the body that the moves were made for, which
/// dances them exactly as taught.
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

  /// The gain of each control, a factor on its distance from the ready stance: what this person makes much or little
  /// of, and which side is the stronger.
  std::array<double, kControlCount> gains = AllGains(1);
  /// Their posture, in every move and at rest: what they add to every control.
  Controls posture = {};
  /// The size of what Style adds; 1 is an adult's.
  double looseness = 0;
  std::uint64_t style = 0;  ///< the key of their ways with every move (Style)
};

/// Returns who stands at this share, in [0, 1), of a mixture in which toddlers come first, then school children, adults
/// and experts.
People KindInMixture(double share);

/// Draws a person with dice of their own in each world. A preset changes sizes alone: the same dice make the same kind
/// of toddler as of adult.
Person DrawPerson(const WorldKey& key, People people);

/// Returns the share of the amplitude that is left after so many seconds of dancing; it falls, but never below 0.6.
double VigourAfter(const Person& person, double danced_s);

/// Returns the sizes of a body of this stature, metres. `childhood` is 0 for an adult's proportions, 1 for those of a
/// child of four: shorter legs, a longer trunk, a larger head. Shares of stature: an adult's after Drillis and Contini
/// (1966), as the canonical body's; a child's after Snyder et al., "Anthropometry of infants, children and youths to
/// age 18" (1977), rounded.
BodyDimensions DimensionsOf(double stature_m, double childhood);

}  // namespace etude
