#pragma once

#include <vector>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/vision/strokes.h"
#include "sim/body/shape.h"
#include "sim/random/stream.h"

namespace etude {

/// The human who marks limbs and end effectors in the pictures (paper B, section 4.2).
struct AnnotatorOptions {
  /// Standard deviation of every marked point in u and in v, pixels. Two pixels are what a careful hand
  /// leaves at 640×480: about 13 mm on a person 4 m away.
  double error_px = 2;
  /// How much larger the error is at a joint that the camera cannot see.
  double hidden_factor = 3;
  /// A limb is marked only when at least this share of it lies on the extracted person.
  double visible_share = 0.5;
  /// A point this close to the extracted person still counts as on it, pixels.
  int margin_px = 4;
};

/// The annotation picture of one frame: on black, a stroke along every limb and a disc on every end
/// effector (engine/vision/strokes.h) that lies on `person`, the extracted person the annotator is shown.
/// Draws the same dice whatever is marked, so a better mask never changes the errors of other marks.
/// @param body the performer's shape, which decides what is hidden from the camera
ColourImage Annotate(const BodyPose& truth, const std::vector<Capsule>& body, const Camera& camera, const Mask& person,
                     const AnnotatorOptions& options, RandomStream& random);

/// Draws one stroke from a to b, the second half in the second shade. Parts outside are cut off.
void DrawStroke(const PixelSegment& segment, const StrokeMark& mark, ColourImage& picture);
/// Draws one disc. Parts outside are cut off.
void DrawDisc(const glm::dvec2& centre, const EffectorMark& mark, ColourImage& picture);

}  // namespace etude
