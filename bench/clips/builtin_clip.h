#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "sim/choreography/move.h"

namespace etude {

/// What stands in front of the name of a move, an act or a song.
constexpr std::string_view kBuiltinPrefix = "builtin:";

/// A move, an act of the coach or a song.
struct BuiltinClip {
  BodyMotion motion;
  std::optional<Move> move;  ///< when it was authored as one with key poses; songs and acts have none
};

/// `name` without the prefix. The error says which there are.
Result<BuiltinClip> LoadBuiltinClip(const std::string& name, const Place& place);

}  // namespace etude
