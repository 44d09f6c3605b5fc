#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/vision/strokes.h"

namespace etude {

/// COCO's seventeen keypoints of a person, in its order: nose, eyes, ears, shoulders, elbows, wrists, hips, knees,
/// ankles, the left one first.
constexpr std::size_t kCocoKeypoints = 17;

/// Where the marks of a picture put them: the ends of strokes, the mean where strokes meet. The annotator marks no
/// face: nose, eyes and ears are never there.
std::array<std::optional<glm::dvec2>, kCocoKeypoints> CocoKeypointsOf(const Marks& marks);

/// One camera's take as a COCO keypoint file (JSON): `images`, one `annotations` entry for every picture with a mark,
/// and the category `person` with the names of its keypoints. A keypoint is x, y, v: v = 2 is marked, 0 (with zeros)
/// not. Pixels as COCO's: the centre of the first pixel is (0, 0). `bbox` is the box around the keypoints, `area` its
/// area.
/// Fails when a mark is not finite.
/// @param pictures the file name of each frame
/// @param marks of each frame
Result<std::string> WriteCocoKeypoints(const Intrinsics& camera, std::span<const std::string> pictures,
                                       std::span<const Marks> marks);

}  // namespace etude
