#include "sim/performer/person.h"

#include <algorithm>
#include <cassert>

namespace etude {

const std::vector<std::string>& PeopleNames() {
  static const std::vector<std::string> names = {"mixed", "toddler", "school-child", "adult", "expert", "absent"};
  return names;
}

std::string_view PeopleName(People people) { return PeopleNames()[static_cast<std::size_t>(people)]; }

People FindPeople(std::string_view name) {
  const auto found = std::ranges::find(PeopleNames(), name);
  assert(found != PeopleNames().end());
  return static_cast<People>(found - PeopleNames().begin());
}

Person DrawPerson(const WorldKey&, People people) {
  return {.kind = people == People::kMixed ? People::kAdult : people};
}

}  // namespace etude
