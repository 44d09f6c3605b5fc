#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "reports/viewer/recorded_worlds.h"

namespace etude {

/// A motion in 16-bit steps: coordinate `axis` of point i is low + step · steps[3 i + axis], metres. The points of all
/// joints in the first frame come first, then the points in the next frame. The steps of a missing point are kNoStep;
/// no other point has this value.
struct QuantisedMotion {
  static constexpr std::uint16_t kNoStep = 65535;

  glm::dvec3 low{0};
  /// The size of a step, the same for all axes, metres. The quantisation error of a coordinate is at most half a step,
  /// plus the rounding of doubles.
  double step = 0;
  std::vector<std::uint16_t> steps;

  glm::dvec3 At(std::size_t point) const;
};
/// Quantises points. The step is the range of the widest axis divided by 65,534, the smallest step that 16 bits allow.
/// If all points are equal, the step is 0.
QuantisedMotion Quantise(std::span<const glm::dvec3> points);

/// Writes the motions of one world as a script in the page's folder, which the viewer loads: `etudeMotion({…});`,
/// ASCII.
///
///     {"file": …, "title": …, "rate_hz": 30, "floor_m": 0, "error": what errors are, "unit": "mm" or "cm",
///      "notes": [what could not be read],
///      "cells": [{"id", "method", "colour": as the page's, "status", "reason"}],
///      "bodies": [{"label", "cell": index into cells or -1 (all of them), "kind": "shown", "ghost" or "partner",
///                  "begin": frame of the world, "frames": number (the last one is held), "against": [indices of the
///                  reference bodies; the last visible one is used], "low_m": [x, y, z], "step_m", "data": Base64 of
///                  the steps, little-endian,
///                  "contacts": [[side, begin, end]], "joints": [names], "parents": [indices, −1: none] (both
///                  absent for a body of the twenty joints)}],
///      "targets_m": [[x, y, z]], "steps": [{"cell", "iterations", "off_cm", "off_deg"}],
///      "marks": [{"lane", "frame", "end", "kind", "text"}]}
std::string WorldScript(const RunData& run, const RecordedWorld& world);

}  // namespace etude
