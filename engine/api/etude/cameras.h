#pragma once

#include <etude/base.h>

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/cameras/triangulation.h"

namespace etude::engine {

/// Reads the cameras of a rig from a file of Etude, OpenCV, Pose2Sim, Anipose, FreeMoCap, Caliscope or Qualisys; the
/// format is recognised by the content. Throws BadInput for any other file.
ETUDE_API std::vector<NamedCamera> ReadRig(std::string_view text, const std::string& file);

struct CalibratedCamera {
  Camera camera;
  double rms_px = 0;  ///< root mean square distance between the pairs' pixels and the projections of their points
};

/// Finds the camera with the smallest squared reprojection error. Throws BadInput, with the reason, for pairs that do
/// not determine a camera: fewer than six, points in one plane, or no picture size.
ETUDE_API CalibratedCamera Calibrate(std::span<const PointPair> pairs, int width, int height);

/// Triangulates a point from its pixels in the pictures of several cameras: removes the lens distortion, then calls
/// TriangulateByPixels. `pixels` has one entry per camera, nullopt where a camera does not show the point. Throws
/// BadInput if the numbers of pixels and cameras differ.
ETUDE_API TriangulatedPoint Triangulate(std::span<const NamedCamera> cameras,
                                        std::span<const std::optional<glm::dvec2>> pixels);

}  // namespace etude::engine
