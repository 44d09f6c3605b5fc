#pragma once

#include "engine/motion/body.h"
#include "sim/render/scene.h"

namespace etude {

/// Paper A's scene, generated: a meadow before a forest's edge and the sky. Stands behind z = −1, and hides the room's
/// wall and floor from a camera that looks at the origin from +Z.
Figure ForestFigure();

/// A soft dark spot on the meadow below a body: the forest is drawn without shadows.
Surface SpotBelow(const BodyPose& pose);

}  // namespace etude
