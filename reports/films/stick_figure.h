#pragma once

#include "engine/motion/body.h"
#include "reports/films/canvas.h"

namespace etude {

/// The body from the front, as lines, feet near the lower edge of a box that is `tall` metres high.
void DrawStickFigure(Canvas& canvas, const BodyPose& pose, const Box& box, double tall, const Paint& paint);

/// Where in that box a joint is drawn.
glm::dvec2 StickJoint(const BodyPose& pose, Role role, const Box& box, double tall);

}  // namespace etude
