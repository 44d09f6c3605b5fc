#pragma once

#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/vision/strokes.h"

namespace etude {

/// Marks without those that disagree with the other cameras': of every disc and every stroke that three or more
/// pictures of a frame show, the views that `AgreeingViews` leaves out lose it. Helps where a camera is knocked, or its
/// marks are of another limb; costs a little where all err alike.
/// @param marks `marks[camera][frame]`
/// @param tolerance_px how far from the others' point a picture may be and agree with them. Marks that err by 2 pixels,
///     and by more at joints that clothes hide, agree within 12.
std::vector<std::vector<Marks>> AgreeingMarks(std::span<const ProjectionMatrix> cameras,
                                              std::span<const std::vector<Marks>> marks, double tolerance_px = 12);

}  // namespace etude
