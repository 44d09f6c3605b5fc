#pragma once

#include <span>
#include <string>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/vision/strokes.h"
#include "io/files/json.h"

namespace etude {

/// One camera's take as a COCO keypoint file (JSON): `images`, one `annotations` entry for every picture with a mark,
/// and the category `person` with the names of its keypoints: those of layout "halpe_26_hands", whose first seventeen
/// are COCO's own. They lie where the marks put them (`PersonOf`); the annotator marks no face. A keypoint is x, y, v:
/// v = 2 is marked, 0 (with zeros) not. Pixels as COCO's: the centre of the first pixel is (0, 0). `bbox` is the box
/// around the keypoints, `area` its area.
/// Fails when a mark is not finite.
/// @param pictures the file name of each frame
/// @param marks of each frame
Result<std::string> WriteCocoKeypoints(const Intrinsics& camera, std::span<const std::string> pictures,
                                       std::span<const Marks> marks);

/// A mask as COCO's uncompressed run lengths, {"size": [height, width], "counts": [...]}: column by column, how many
/// pixels are background, then person, and so on. `path` is where it stands in the answer. Refused: another size than
/// this, counts that are no whole numbers or do not add up to it.
Result<Mask> ReadCocoMask(const Json& json, const std::string& path, int width, int height);

}  // namespace etude
