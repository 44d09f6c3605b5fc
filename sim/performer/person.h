#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "sim/random/stream.h"

namespace etude {

/// Who dances.
enum class People {
  kMixed,        ///< toddlers, school children, adults and experts, thrown
  kToddler,      ///< about 1 m tall, follows late and loosely, tires soon
  kSchoolChild,  ///< 1.1–1.6 m
  kAdult,
  kExpert,  ///< an adult who dances as taught
  kAbsent,  ///< stands there and does not take part
};

/// "mixed", "toddler", "school-child", "adult", "expert", "absent": in the order of the enum.
const std::vector<std::string>& PeopleNames();
std::string_view PeopleName(People people);
/// `name` must be one of PeopleNames().
People FindPeople(std::string_view name);

/// One person: what stays the same from move to move and from session to session.
struct Person {
  People kind = People::kExpert;  ///< never kMixed
  double stature_m = 1.7;
};

/// Throws a person. The dice do not depend on `people`: a preset changes sizes, not luck.
Person DrawPerson(const WorldKey& key, People people);

}  // namespace etude
