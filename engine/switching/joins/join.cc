#include "engine/switching/joins/join.h"

#include <array>

#include "engine/switching/joins/crossfade.h"
#include "engine/switching/joins/inertialise.h"

namespace etude {
namespace {

Blend CutOver(const SeamMotions& /*motions*/, const JoinSettings& /*settings*/) {
  return [](const BodyPose& target, int /*frames*/) { return target; };
}

// A function, so that the table is made after every string it is made of.
std::span<const Join> Table() {
  static const JoinSetting kBlend{"blend_s", &JoinSettings::blend_s, 0, 5,
                                  "Seconds after the seam until the new motion is shown alone."};
  static const JoinSetting kHalfLife{"half_life_s", &JoinSettings::half_life_s, 0.001, 5,
                                     "Seconds until about half of what was off at the seam is gone."};
  static const std::array kJoins = {
      Join{.name = "cut", .description = "paper A's: the next frame shown is the new clip's", .begin = CutOver},
      Join{.name = "crossfade",
           .description = "the old motion fades into the new one (Kovar 2002)",
           .settings = {kBlend},
           .begin = Crossfade},
      Join{.name = "inertialised-quintic",
           .description = "what was off dies away along a quintic that does not overshoot (Bollo 2018)",
           .settings = {kBlend},
           .begin = InertialiseQuintic},
      Join{.name = "inertialised-spring",
           .description = "what was off dies away like a critically damped spring (Holden 2020)",
           .settings = {kHalfLife},
           .begin = InertialiseSpring},
  };
  return kJoins;
}

}  // namespace

std::span<const Join> AllJoins() { return Table(); }

std::vector<std::string> JoinNames() {
  std::vector<std::string> names;
  for (const Join& join : AllJoins()) names.push_back(join.name);
  return names;
}

const Join* FindJoin(std::string_view name) {
  for (const Join& join : AllJoins()) {
    if (join.name == name) return &join;
  }
  return nullptr;
}

}  // namespace etude
