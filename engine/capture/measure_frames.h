#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/limb_direction.h"
#include "engine/cameras/triangulation.h"
#include "engine/motion/body.h"
#include "engine/vision/strokes.h"

namespace etude {

/// Removes the marks that disagree with the other cameras' *(ours)*: of every disc and stroke that three or more
/// pictures of a frame show, the views lose it that `AgreeingViews` leaves out. Helps where a camera is knocked, or its
/// marks are of another limb; costs a little where all err alike.
/// @param marks `marks[camera][frame]`
/// @param tolerance_px how far from the others' point a picture may be and agree with them. Marks that err by 2 pixels,
///     and by more at joints that clothes hide, agree within 12.
std::vector<std::vector<Marks>> AgreeingMarks(std::span<const ProjectionMatrix> cameras,
                                              std::span<const std::vector<Marks>> marks, double tolerance_px = 12);

/// Vectors of those of the twenty roles that have one.
using RoleVectors = std::array<std::optional<glm::dvec3>, kRoleCount>;

/// The measurements in space from one frame's marks.
struct FrameMeasurement {
  RoleVectors ends;        ///< p_WE, metres: each end effector's place in the world, at its role
  RoleVectors directions;  ///< unit, in the world: each limb's direction, at the role of its lower joint
  /// The planes that limbs without a direction lie in, one for each picture that shows the limb.
  std::array<std::vector<StrokePlane>, kRoleCount> planes = {};
  /// The lines that ends lie on which only one picture shows.
  std::array<std::optional<SightLine>, kRoleCount> sight_lines = {};
};

/// Measurements of one frame that the caller knows without marks: from another sensor, or true values, to see what a
/// stage costs. Each member that is present replaces all measurements of its kind in that frame.
struct KnownMeasurement {
  std::optional<RoleVectors> ends;
  std::optional<RoleVectors> directions;
};

struct MeasureInputs {
  /// H of each camera: world (metres) to pixels. At least two.
  std::span<const ProjectionMatrix> cameras;
  /// `marks[camera][frame]`, pixels. All cameras have the same number of frames, taken at the same moments; a picture
  /// that nobody has marked has an empty `Marks{}`.
  std::span<const std::vector<Marks>> marks;
  /// Empty, or one per frame.
  std::span<const KnownMeasurement> known = {};
};

struct MeasureOptions {
  /// The direction of a limb is that of its strokes alone if two of its viewing planes are at least this far from
  /// parallel (radians). An error of the strokes is magnified by 1/sin of that angle: about seven times at 8°. Below,
  /// the planes are handed on, and the frames before and after help (`BridgeGaps`). Raise it when marks are inexact;
  /// lower it when marks are exact, or cameras stand close together.
  double smallest_plane_angle = Radians(8);
  /// Strokes shorter than this (pixels) give no direction: when a limb is seen almost end on, the error of the marks
  /// hides its direction. 6 is three times the usual error of marks in pictures of 640 × 480, 2 pixels; scale it with
  /// that error.
  double shortest_stroke_px = 6;
};

/// Triangulates the end effectors and computes the limb directions of every frame (paper B, sections 2.3 and 2.4).
/// Each mark is measured from all pictures that show it, if these are two or more; of others, what they tell is kept
/// (`planes`, `sight_lines`). With two cameras these are the paper's formulas; with more, both are least squares in
/// which views weigh as exactly as they show (`TriangulateByPixels`, `ComputeLimbDirection`). No view is rejected for
/// disagreeing with the others: `AgreeingMarks` does that beforehand.
std::vector<FrameMeasurement> MeasureFrames(const MeasureInputs& inputs, const MeasureOptions& options = {});

}  // namespace etude
