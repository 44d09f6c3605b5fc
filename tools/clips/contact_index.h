#pragma once

#include <string>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// Draws an SVG picture of the ground contacts of a clip's feet: for each foot, over time, the height of the toe tip
/// above the body's lowest joint and the toe tip's speed, with the limits of kFootRules as dashed lines, and bars where
/// FindFootContacts finds contact. The title is `name`, followed by the share of time in contact. Needs at least one
/// frame.
std::string ContactIndexSvg(const std::string& name, const BodyMotion& motion);

}  // namespace etude
