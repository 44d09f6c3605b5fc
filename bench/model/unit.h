#pragma once

#include <array>
#include <string>
#include <string_view>

#include "engine/base/named.h"

namespace etude {

/// The unit that the worlds of a scenario were drawn from: worlds that share such a unit resemble each other, so a
/// claim beyond them counts units, not worlds.
enum class SamplingUnit {
  kWorld,     ///< every world is drawn for itself
  kPerson,    ///< every world has a person of its own
  kClip,      ///< the clip that a world shows first
  kClipPair,  ///< each clip of a world, in whatever part: clip left × clip entered
  kLibrary,   ///< the folder that a world's clips come from
};
inline constexpr std::array<Named<SamplingUnit>, 5> kSamplingUnits = {{{"world", SamplingUnit::kWorld},
                                                                       {"person", SamplingUnit::kPerson},
                                                                       {"clip", SamplingUnit::kClip},
                                                                       {"clip-pair", SamplingUnit::kClipPair},
                                                                       {"library", SamplingUnit::kLibrary}}};
std::string_view SamplingUnitName(SamplingUnit unit);

/// "6 clips", "1 person"; a clip-pair counts its clips.
std::string CountUnits(int count, SamplingUnit unit);

/// True if no two worlds share a unit, so that worlds are units.
constexpr bool IsEveryWorldItsOwn(SamplingUnit unit) {
  return unit == SamplingUnit::kWorld || unit == SamplingUnit::kPerson;
}

}  // namespace etude
