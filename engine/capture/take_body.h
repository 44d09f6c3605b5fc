#pragma once

#include <array>
#include <span>

#include "engine/bundle_adjustment/measurable_body.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/capture_body.h"
#include "engine/motion/body.h"

namespace etude {

/// Paper B's body, whose joints' marks can be compared with pictures.
struct TakeBody {
  CaptureBody body;  ///< `PaperBody`
  /// Every role that a mark shows is a point; its lengths are those of LimbLengths, in that order, both sides alike.
  MeasurableBody measurable;
  std::array<int, kRoleCount> points{};  ///< of each role its index among `measurable.points`; −1: no mark shows it
};

TakeBody MakeTakeBody(const LimbLengths& lengths);

/// The lengths of such a body as a struct, and the other way round.
LimbLengths LimbLengthsOf(std::span<const double> lengths);
std::array<double, 10> ListOf(const LimbLengths& lengths);

}  // namespace etude
