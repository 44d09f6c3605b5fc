#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/capture/film.h"
#include "bench/tasks/capture/world.h"
#include "engine/capture/recover_frames.h"

namespace etude {

/// The recording of a built-in method's motion, with its masks (bench/recordings/capture_extras.h). `name`: its BVH
/// clip's; `moments`: those of the frames that there are, counted from 1, keep their marks and the skeleton before
/// inverse kinematics, too.
Recording MakeRecording(const CaptureWorld& world, const Take& take, const Observation& observation,
                        const CaptureBody& body, const std::vector<RecoveredFrame>& frames, const std::string& name,
                        std::span<const double> moments);

/// What an answer alone can show: nothing was cut out, and no joint of its BVH clip turns.
Recording MakeRecording(const CaptureWorld& world, const std::vector<BodyPose>& poses);

}  // namespace etude
