#pragma once

#include <vector>

#include "engine/transitions/fillers/filler.h"

namespace etude {

/// Changes the legs of a filled gap so that feet which bear the body stay where they are, and others make steps.
/// *(Ours.)*
///
/// A foot stands at an end of the gap if it is among the lowest joints there and rests. If no foot stands at either
/// end, nothing is changed. Otherwise, each foot gets the sequence of stances and steps that follows its path in
/// `filled` at the least cost; a foot that stands at an end begins or ends with that stance. Of all pairs of a left and
/// a right sequence, the cheapest is taken; each frame in which no foot stands adds to its cost. In a stance within the
/// gap, the foot stands at the mean of its path over the stance. Steps are movements of minimum jerk, lifted by at most
/// 5 cm. The pelvis is lowered by at most 10 cm where a leg is too short, then the heel is raised; hips, knees and
/// ankles follow by two-bone inverse kinematics. Nothing is changed without the roles of hips, knees and ankles, and in
/// gaps of more than 254 frames.
void PlantGap(const Gap& gap, std::vector<TreePose>& filled);

}  // namespace etude
