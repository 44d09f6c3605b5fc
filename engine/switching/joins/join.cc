#include "engine/switching/joins/join.h"

#include <array>

#include "engine/switching/joins/inertialise.h"

namespace etude {
namespace {

Blend Cut(const Meeting& /*meeting*/, const JoinSettings& /*settings*/) {
  return [](const BodyPose& target, int /*frames*/) { return target; };
}

const std::array kJoins = {
    Join{.name = "cut", .description = "paper A's: the next frame shown is the new clip's", .begin = Cut},
    Join{.name = "inertialised-spring",
         .description = "what was off dies away like a critically damped spring (Holden)",
         .begin = InertialiseSpring},
};

}  // namespace

std::span<const Join> AllJoins() { return kJoins; }

std::vector<std::string> JoinNames() {
  std::vector<std::string> names;
  for (const Join& join : kJoins) names.push_back(join.name);
  return names;
}

const Join* FindJoin(std::string_view name) {
  for (const Join& join : kJoins) {
    if (join.name == name) return &join;
  }
  return nullptr;
}

}  // namespace etude
