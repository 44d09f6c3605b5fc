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
/// mark, and the category `person` with the names of its keypoints. They are those of layout "halpe_26_hands", whose
/// first seventeen are COCO's own, at the positions that the marks give (`PersonOf`); the annotator marks no face. A
/// keypoint is x, y, v: v = 2 is marked, 0 (with zeros) is not. Pixels follow COCO: the centre of the first pixel is
/// (0, 0). `bbox` is the box around the keypoints, `area` its area. Fails if a mark is not finite.
/// @param pictures the file name of each frame
/// @param marks the marks of each frame
Result<std::string> WriteCocoKeypoints(const Intrinsics& camera, std::span<const std::string> pictures,
                                       std::span<const Marks> marks);

/// Reads a mask in COCO's uncompressed run lengths, {"size": [height, width], "counts": [...]}: column by column, the
/// number of background pixels, then of person pixels, and so on. `path` is its position in the answer. Another size,
/// counts that are not integers, and counts that do not add up to the size are errors.
Result<Mask> ReadCocoMask(const Json& json, const std::string& path, int width, int height);

}  // namespace etude
