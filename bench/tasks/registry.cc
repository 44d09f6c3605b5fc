#include "bench/tasks/registry.h"

#include "bench/tasks/base/task_kinds.h"
#include "engine/base/named.h"

namespace etude {

std::span<const TaskKind> AllTaskKinds() {
  static const std::vector<TaskKind> kinds = {
      MakeTransitionTaskKind(),   MakeDetectionTaskKind(),    MakeIkTaskKind(),    MakeTrackingTaskKind(),
      MakeCaptureTaskKind(),      MakePoseDistanceTaskKind(), MakeCoachTaskKind(), MakeEvaluationTaskKind(),
      MakePlausibilityTaskKind(), MakeInbetweenTaskKind()};
  return kinds;
}

const TaskKind* FindTaskKind(std::string_view name) { return FindByName(AllTaskKinds(), name); }

}  // namespace etude
