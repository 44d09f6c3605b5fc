#include "engine/unmarked/join_outlines.h"

namespace etude {

std::optional<std::size_t> IndexOfPerson(const RecoveredPerson& person, std::size_t number) {
  for (std::size_t i = 0; i < person.people.size(); ++i) {
    if (person.people[i].cameras >= 2 && number-- == 0) return i;
  }
  return std::nullopt;
}

bool JoinOutlines(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen, const BodyMotion& outlines,
                  AdjustPersonOptions options, RecoveredPerson& person) {
  options.outlines = &outlines;
  return AdjustPerson(cameras, seen, options, person);
}

}  // namespace etude
