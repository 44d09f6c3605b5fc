#pragma once

#include <span>
#include <string>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/vision/strokes.h"
#include "io/files/json.h"

namespace etude {

/// Writes one camera's take as a COCO keypoint file (JSON): `images`, one `annotations` entry for every picture with a
/// mark, and the category `person` with the names of its keypoints. The keypoints are those of layout "halpe_26_hands",
/// of which the first seventeen are COCO's own. Their positions come from the marks (`PersonOf`); the annotator does
/// not mark the face. A keypoint is written as x, y, v. A marked keypoint has v = 2; for any other, all three are 0.
/// Pixels follow COCO: the centre of the first pixel is (0, 0). `bbox` is the box around the keypoints, `area` the area
/// of the box. Fails if a mark is not finite.
/// @param pictures the file name of each frame
/// @param marks the marks of each frame
Result<std::string> WriteCocoKeypoints(const Intrinsics& camera, std::span<const std::string> pictures,
                                       std::span<const Marks> marks);

/// Reads a mask in COCO's uncompressed run lengths, {"size": [height, width], "counts": [...]}. The counts go column by
/// column: the number of background pixels, then of person pixels, and so on. `path` is the position of the mask in the
/// answer. Fails if the size differs, or if the counts are not integers or do not add up to the size.
Result<Mask> ReadCocoMask(const Json& json, const std::string& path, int width, int height);

}  // namespace etude
