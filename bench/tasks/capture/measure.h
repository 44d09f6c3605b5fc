#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/motion/body.h"
#include "engine/vision/strokes.h"

namespace etude {

/// What the marks of one frame say about space; nothing where a mark is missing in a picture, or where
/// the geometry is ill-conditioned.
struct FrameMeasurement {
  std::array<std::optional<glm::dvec3>, kRoleCount> ends;        ///< at the five end effectors' roles
  std::array<std::optional<glm::dvec3>, kRoleCount> directions;  ///< unit, at the lower joint of a stroke's limb
};

/// Triangulates the end effectors and computes the limb directions of one frame from the marks in two
/// pictures (paper B, sections 2.3 and 2.4).
FrameMeasurement MeasureFrame(const Marks& marks1, const ProjectionMatrix& matrix1, const Marks& marks2,
                              const ProjectionMatrix& matrix2);

/// The true values of what `MeasureFrame` measures.
FrameMeasurement TrueMeasurement(const BodyPose& truth);

/// Completes every frame from its neighbours (ours): directions on the sphere (slerp), points
/// straight, the nearest one held before the first and after the last. A frame stays empty when something
/// in it was not measured within `longest_gap` frames before or after it.
std::vector<std::optional<LimbObservation>> BridgeGaps(std::span<const FrameMeasurement> frames, int longest_gap);

}  // namespace etude
