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
  kMixed,        ///< a person drawn from toddlers, school children, adults and experts
  kToddler,      ///< a child, 1.0–1.1 m tall, who follows late and loosely and tires soon
  kSchoolChild,  ///< a child, 1.1–1.6 m tall
  kAdult,        ///< an adult, 1.5–1.9 m tall
  kExpert,       ///< an adult who dances nearly as taught
  kAbsent,       ///< an adult who stands still and does not take part
};

/// Returns the names "mixed", "toddler", "school-child", "adult", "expert", "absent", in the order of the enum.
const std::vector<std::string>& PeopleNames();
/// Returns the kind with this name, which must be one of PeopleNames().
People FindPeople(std::string_view name);

/// Returns an array with the same gain for every control.
constexpr std::array<double, kControlCount> AllGains(double gain) {
  std::array<double, kControlCount> gains{};
  for (double& each : gains) each = gain;
  return gains;
}

/// The traits of a person that stay the same from move to move. By default, a person has the canonical body and dances
/// exactly as taught.
struct Person {
  People kind = People::kExpert;  ///< the kind of person, never kMixed
  double stature_m = 1.7;
  BodyDimensions body = {};
  FloorMove place = {};  ///< position and heading on the floor; the coach is at the origin and faces +Z

  double lag_s = 0;         ///< mean delay behind the coach
  double lag_spread_s = 0;  ///< standard deviation of the delay, over the person's performances
  double tempo = 1;         ///< factor on the move's tempo if no music sets the tempo
  double tempo_spread = 0;  ///< standard deviation of the tempo's logarithm, over the person's performances
  double drift = 0;         ///< unevenness of the timing within a performance, as a share of the performance's length
  double amplitude = 1;     ///< factor on every angle's distance from the ready stance
  double tiring = 0;        ///< share of the amplitude that is lost after a minute of dancing

  /// The gain of each control: the factor on the control's distance from the ready stance. Gains determine which
  /// movements the person exaggerates or reduces, and which side is stronger.
  std::array<double, kControlCount> gains = AllGains(1);
  /// The person's posture: offsets that are added to the controls, in every move and at rest.
  Controls posture = {};
  /// The size of the random offsets in the person's Style: about 1 for an adult, 0 for a person who dances exactly as
  /// taught.
  double looseness = 0;
  std::uint64_t style = 0;  ///< key of the random numbers of the person's Style, for all moves
};

/// Returns the kind of person for a number `share` in [0, 1). The mixture divides [0, 1) among toddlers, school
/// children, adults and experts, in this order.
People KindInMixture(double share);

/// Draws a person, a new one for every world. A preset changes only the means and the spreads of traits: with equal
/// random numbers, a toddler and an adult deviate in the same way from the means of their kinds.
Person DrawPerson(const WorldKey& key, People people);

/// Returns the share of the amplitude that is left after `danced_s` seconds of dancing. This share never falls below
/// 0.6.
double VigourAfter(const Person& person, double danced_s);

/// Returns the sizes of a body with this stature, metres. `childhood` is 0 for an adult's proportions and 1 for the
/// proportions of a four-year-old child: shorter legs, a longer trunk, a larger head. The shares of stature come from
/// Drillis and Contini (1966) for adults, as for the canonical body, and, rounded, from Snyder et al., "Anthropometry
/// of infants, children and youths to age 18" (1977) for children.
BodyDimensions DimensionsOf(double stature_m, double childhood);

}  // namespace etude
