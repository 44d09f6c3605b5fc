#include "bench/tasks/capture/own_cameras.h"

#include "engine/cameras/rig_file.h"

namespace etude {

Result<void> OpenOwnCameras(const TaskInput& input, StudioOptions& options) {
  if (options.rig.shape != RigShape::kFile) return {};
  const Node& condition = input.condition.node();
  const Node* named = condition.Find(kRigFileKey);
  const auto text = input.texts.find(kRigFileKey);
  if (named == nullptr || text == input.texts.end()) {
    return Fail((named != nullptr ? *named : condition).place, "'rig: file' needs '{}', a calibration file",
                kRigFileKey);
  }
  ASSIGN_OR_RETURN(const auto cameras, ReadRig(text->second, named->scalar));
  if (cameras.size() < 2 || cameras.size() > kMostCameras) {
    return Fail(named->place, "'{}' has {} cameras; allowed: 2 to {}", named->scalar, cameras.size(), kMostCameras);
  }
  std::vector<Camera>& own = options.rig.own;
  for (const NamedCamera& camera : cameras) {
    const Intrinsics& in = camera.camera.intrinsics;
    if (in.width < 1 || in.height < 1 || in.width > kLargestPicture || in.height > kLargestPicture) {
      return Fail(named->place, "camera '{}' of '{}' takes pictures of {} × {} pixels; allowed: 1 to {} a side",
                  camera.name, named->scalar, in.width, in.height, kLargestPicture);
    }
    own.push_back(camera.camera);
  }
  return {};
}

}  // namespace etude
