#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// The body of a person: every bone between two joints as long as it is in the median of the frames that show both,
/// left and right by themselves; the spine at `kSpineShare` of the trunk (`FittedBody`). The head is a joint of its
/// clip. Fails, naming the joint, when no frame shows some bone.
Result<CaptureBody> MedianBody(std::span<const LandmarkPlaces> frames);

/// The angles and the root's place in every frame that bring all joints of the body as near as they can be to where
/// landmarks say they are (`JointsOf`): Σ weight · |place − joint|² is least, at least locally. Joints that a frame
/// lacks hang as they did in the frame before, and weigh a hundredth; the spine, which no landmark shows, lies on the
/// line from hips to shoulders and weighs one, since else the trunk would bend any way where it is seen shorter.
/// Nothing for frames that tell of fewer than eight joints. *(Ours.)*
std::vector<std::optional<TreeState>> FitPerson(const CaptureBody& body, std::span<const LandmarkPlaces> frames);

}  // namespace etude
