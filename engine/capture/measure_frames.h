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

/// Removes marks that disagree with the marks of other cameras *(ours)*. If three or more pictures of a frame show a
/// disc or stroke, the disc or stroke is removed from the views that `AgreeingViews` rejects. Use this function if a
/// camera may have moved or marks may be on the wrong limb; if all marks are equally accurate, the function costs a
/// little accuracy.
/// @param marks `marks[camera][frame]`
/// @param tolerance_px maximum distance, in pixels, of a mark from the point that the other pictures determine. Marks
/// with errors of 2 pixels (more at joints under clothes) agree within 12 pixels.
std::vector<std::vector<Marks>> AgreeingMarks(std::span<const ProjectionMatrix> cameras,
                                              std::span<const std::vector<Marks>> marks, double tolerance_px = 12);

/// One vector per role; nullopt if the role has none.
using RoleVectors = std::array<std::optional<glm::dvec3>, kRoleCount>;

/// The spatial measurements from the marks of one frame.
struct FrameMeasurement {
  RoleVectors ends;  ///< p_WE, metres: position of each end effector in the world, by its role
  /// Unit vectors in the world: the direction of each limb, by the role at which its stroke ends (`StrokeMark::to`).
  RoleVectors directions;
  /// For each limb without a direction: the planes through the limb, one per picture that shows it.
  std::array<std::vector<StrokePlane>, kRoleCount> planes = {};
  /// The sight line of each end effector that only one picture shows.
  std::array<std::optional<SightLine>, kRoleCount> sight_lines = {};
};

/// Measurements of one frame that do not come from marks but from another sensor, or true values. With true values, the
/// errors of later computations can be measured without the errors of marks. Each member that is present replaces all
/// measurements of its kind.
struct KnownMeasurement {
  std::optional<RoleVectors> ends;
  std::optional<RoleVectors> directions;
};

struct MeasureInputs {
  /// The matrix H of each camera, from the world (metres) to pixels. There must be at least two cameras.
  std::span<const ProjectionMatrix> cameras;
  /// `marks[camera][frame]`, pixels. All cameras have the same number of frames, taken at the same times; an unmarked
  /// picture has an empty `Marks{}`.
  std::span<const std::vector<Marks>> marks;
  /// One known measurement per frame; empty if there are none.
  std::span<const KnownMeasurement> known = {};
};

struct MeasureOptions {
  /// Minimum angle between two viewing planes of a limb, radians, at which the limb's strokes alone give its direction.
  /// The error of the direction is the error of the strokes times 1/sin(angle), about seven times at 8°. Below this
  /// minimum, the planes are kept and combined with neighbouring frames (`InterpolateGaps`). Raise the minimum if marks
  /// are inaccurate; lower it if marks are accurate or the cameras are close together.
  double min_plane_angle = Radians(8);
  /// Strokes shorter than this, in pixels, give no direction: for a limb that lies nearly along the line of sight, the
  /// errors of the marks hide the direction. The default is three times the usual error of a mark, which is 2 pixels in
  /// pictures of 640 × 480; scale the default with that error.
  double min_stroke_px = 6;
};

/// Triangulates the end effectors and computes the limb directions of every frame (paper B, sections 2.3 and 2.4). A
/// position or direction needs two or more pictures; partial information from a single picture is kept in `planes` and
/// `sight_lines`. With two cameras the formulas are the paper's. With more cameras, positions and directions are
/// least-squares solutions in which views are weighted by their accuracy (`TriangulateByPixels`,
/// `ComputeLimbDirection`). No view is rejected here; call `AgreeingMarks` first for that.
std::vector<FrameMeasurement> MeasureFrames(const MeasureInputs& inputs, const MeasureOptions& options = {});

}  // namespace etude
