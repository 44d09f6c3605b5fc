#pragma once

#include <string>

#include "engine/keypoints/people.h"

namespace etude {

/// Returns true if the mid-hip lies midway between the hips in nearly all people who show these.
bool HasMidHips(const SeenPeople& frames);

/// Returns true if the landmarks are in the places that a body gives them, in nearly all people: the mid-hip midway
/// between the hips or the neck midway between the shoulders, and the face (nose, eyes, ears) compact.
bool FitsClearly(const SeenPeople& frames);

/// Returns the reason why the people's keypoints seem to be in another order than `layout`; "" if they do not. `layout`
/// is a name of KeypointLayouts(), or "" if the layout was chosen by the number of keypoints. The order is doubted if,
/// in nearly all people,
/// - the mid-hip is not between the hips (body_25, h36m), a leg is as small as a face (h36m), or joints of body_25b are
///   where body_25 has the mid-hip; or
/// - nose, eyes and ears are farther apart than 0.35 times the farthest landmarks. In COCO's pictures, people who sit,
///   lie, stand on their hands or turn away have faces of 0.05 to 0.3 times that distance.
std::string DoubtOf(const std::string& layout, const SeenPeople& frames);

}  // namespace etude
