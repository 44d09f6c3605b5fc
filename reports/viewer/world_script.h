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

/// Returns a script with the motions of one world, for the viewer. The script is ASCII text: the call
/// `etudeMotion({…});` with this object.
///
///     {"file": …, "title": …, "rate_hz": 30, "floor_m": 0, "error": …, "unit": "mm" or "cm", "notes": […],
///      "cells": [{"id", "method", "colour", "status", "reason"}],
///      "bodies": [{"label", "cell", "kind": "shown", "ghost" or "partner", "begin", "frames", "against": [indices],
///                  "low_m": [x, y, z], "step_m", "data", "contacts": [[side, begin, end]], "joints": [names],
///                  "parents": [indices]}],
///      "targets_m": [[x, y, z]], "steps": [{"cell", "iterations", "off_cm", "off_deg"}],
///      "marks": [{"lane", "frame", "end", "kind", "text"}]}
///
/// - `error` describes the errors of the joints. `notes` lists the data that could not be read.
/// - `colour` is the number of the method's colour on the page.
/// - `cell` of a body is an index of `cells`; −1: the body belongs to all cells.
/// - `begin` is the frame of the world in which the body appears. `frames` is the body's number of frames. The viewer
///   keeps the last frame.
/// - `against` lists the reference bodies, as indices of `bodies`. The viewer uses the last visible reference.
/// - `data` is the Base64 text of QuantisedMotion::steps, little-endian.
/// - `parents` contains −1 for a joint without a parent. A body with the twenty standard joints has no `joints` and no
///   `parents`.
std::string WorldScript(const RunData& run, const RecordedWorld& world);

}  // namespace etude
