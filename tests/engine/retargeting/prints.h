#pragma once

#include <ranges>
#include <span>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "tests/support/fingerprint.h"

namespace etude {

inline auto JointsOfAll(std::span<const BodyPose> poses) { return poses | std::views::transform(&BodyPose::joints); }

/// Adds what is complained of, if there is something; says whether there is.
template <typename T>
bool AddedError(testing::Fingerprint& print, const Result<T>& result) {
  print.Add(result.has_value());
  if (!result) print.Add(ToString(result.error()));
  return !result;
}

}  // namespace etude
