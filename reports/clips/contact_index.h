#pragma once

#include <string>

#include "engine/motion/body.h"
#include "engine/motion/support.h"

namespace etude {

/// Draws as an SVG picture when the feet of a clip stand: for each foot the height of its toe tip above the floor and
/// its speed over time, the thresholds of `rules` as dashed lines (lower: it stands from there on; upper: until there),
/// and bars where FindFootContacts lets it stand. The title is `name` with the share of time. Needs a frame.
std::string ContactIndexSvg(const std::string& name, const BodyMotion& motion, const ContactRules& rules = {});

}  // namespace etude
