#pragma once

#include <string>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// Draws as an SVG picture when the feet of a clip stand: for each foot the height of its toe tip above the body's
/// lowest joint and its speed over time, with kFootRules' limits as dashed lines, and bars where FindFootContacts lets
/// it stand. The title is `name` with the share of time. Needs a frame.
std::string ContactIndexSvg(const std::string& name, const BodyMotion& motion);

}  // namespace etude
