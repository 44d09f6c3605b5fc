#include "bench/tasks/registry.h"

#include "bench/tasks/capture/capture_task.h"
#include "bench/tasks/coach/coach_task.h"
#include "bench/tasks/detection/detection_task.h"
#include "bench/tasks/ik/ik_task.h"
#include "bench/tasks/pose_distance/pose_distance_task.h"
#include "bench/tasks/search/search_task.h"
#include "bench/tasks/tracking/tracking_task.h"
#include "bench/tasks/transition/transition_task.h"
#include "engine/base/named.h"

namespace etude {

std::span<const TaskKind> AllTaskKinds() {
  static const std::vector<TaskKind> kinds = {MakeTransitionTaskKind(),   MakeDetectionTaskKind(), MakeIkTaskKind(),
                                              MakeTrackingTaskKind(),     MakeCaptureTaskKind(),   MakeSearchTaskKind(),
                                              MakePoseDistanceTaskKind(), MakeCoachTaskKind()};
  return kinds;
}

const TaskKind* FindTaskKind(std::string_view name) { return FindByName(AllTaskKinds(), name); }

}  // namespace etude
