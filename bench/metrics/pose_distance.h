#pragma once

#include "engine/motion/body.h"

namespace etude {

/// Two poses whose worst joint is less than this apart, metres, are close: hard to tell apart.
constexpr double kCloseGap = 0.15;

/// Mean distance of the twenty joints, centimetres; both poses stand where they are.
double MeanJointDistanceCm(const BodyPose& a, const BodyPose& b);
/// Root mean square of the same distances.
double RootMeanSquareJointDistanceCm(const BodyPose& a, const BodyPose& b);

}  // namespace etude
