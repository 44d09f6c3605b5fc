#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/base/named.h"

namespace etude {

/// The sampling unit: the kind of thing from which the worlds of a scenario were drawn. Worlds that share a unit
/// resemble each other, so a claim that goes beyond these worlds must count units, not worlds.
enum class SamplingUnit {
  kWorld,           ///< each world is its own unit
  kPerson,          ///< the person in a world; each world has a person of its own
  kClip,            ///< the first clip that a world shows
  kClipPair,        ///< both clips of a world: the clip that a transition leaves and the clip that it enters
  kLibrary,         ///< the folder from which a world's clips come
  kRecordedPerson,  ///< the person whose files the worlds show (key `people`); worlds may show the same person
};
inline constexpr std::array<Named<SamplingUnit>, 6> kSamplingUnits = {
    {{"world", SamplingUnit::kWorld},
     {"person", SamplingUnit::kPerson},
     {"clip", SamplingUnit::kClip},
     {"clip-pair", SamplingUnit::kClipPair},
     {"library", SamplingUnit::kLibrary},
     {"recorded-person", SamplingUnit::kRecordedPerson}}};
std::string_view SamplingUnitName(SamplingUnit unit);

/// Returns a number of units as text, e.g. "6 clips" or "1 person". For kClipPair the noun is "clip".
std::string CountUnits(int count, SamplingUnit unit);

/// Returns true if every world is its own sampling unit, that is, no two worlds share a unit.
constexpr bool WorldsAreUnits(SamplingUnit unit) {
  return unit == SamplingUnit::kWorld || unit == SamplingUnit::kPerson;
}

}  // namespace etude
