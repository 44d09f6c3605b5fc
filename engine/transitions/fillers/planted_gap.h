#pragma once

#include <vector>

#include "engine/transitions/fillers/filler.h"

namespace etude {

/// Changes the legs of a filled gap: feet that support the body stay in place, and other feet make steps. *(Ours.)*
///
/// A foot stands at an end of the gap if it is among the lowest joints there and at rest. If no foot stands at either
/// end, nothing is changed. Otherwise each foot gets a sequence of stances and steps; its cost measures the deviation
/// from the foot's path in `filled`. A foot that stands at an end of the gap begins or ends with a stance there. Of all
/// pairs of a left and a right sequence, the cheapest is taken; each frame in which no foot stands adds to the pair's
/// cost. In a stance within the gap, the foot stands at the mean of its path over the stance. Steps are movements of
/// minimum jerk, lifted by at most 5 cm. Where a leg is too short for its foot, the heel is raised; where it is too
/// short even with a raised heel, the pelvis is lowered by at most 10 cm. Hips, knees and ankles follow by two-bone
/// inverse kinematics. Nothing is changed if the roles of hips, knees or ankles are missing, or if the gap has more
/// than 254 frames.
void PlantGap(const Gap& gap, std::vector<TreePose>& filled);

}  // namespace etude
