#pragma once

#include <string>

#include "engine/motion/body.h"
#include "engine/transitions/joins/planted_feet.h"

namespace etude {

/// When the feet of a clip stand, as an SVG picture: for each foot the height of its toe tip above the floor and its
/// speed over time, the thresholds of `rules` as dashed lines (lower: from there on it stands; upper: until there), and
/// bars where FindFootContacts lets it stand. The share of time is told beside. `name` becomes the title. Needs a
/// frame.
std::string ContactIndexSvg(const std::string& name, const BodyMotion& motion, const ContactRules& rules = {});

}  // namespace etude
