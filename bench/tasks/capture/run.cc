#include "bench/tasks/capture/run.h"

#include <algorithm>

namespace etude {
namespace {

const Observation& ObservationBy(const Take& take, const PersonSource& source) {
  return *std::find_if(take.observations.begin(), take.observations.end(),
                       [&](const Observation& observation) { return observation.source == source; });
}

}  // namespace

Result<CaptureRun> RunCapture(CaptureStages& stages, const CaptureMethod& method) {
  ASSIGN_OR_RETURN(const CalibratedCameras* cameras, stages.GetCameras(method));
  ASSIGN_OR_RETURN(const Take* take, stages.GetTake());
  const Observation& observation = ObservationBy(*take, PersonSourceOf(method));
  const MeasuredTake& measured = stages.GetMeasured(method, *cameras, observation);
  ASSIGN_OR_RETURN(const CaptureBody* body, stages.GetBody(method));
  RecoverInputs inputs{.body = *body, .seen = measured.seen, .marked = stages.marked()};
  if (method.oracle.start || method.oracle.ik) {
    ASSIGN_OR_RETURN(const NearestPoses* nearest, stages.GetNearestPoses(method));
    if (method.oracle.start) inputs.known_starts = *nearest;
    if (method.oracle.ik) inputs.known_poses = *nearest;
  }
  return CaptureRun{.method = method,
                    .cameras = *cameras,
                    .take = *take,
                    .observation = observation,
                    .measured = measured,
                    .body = *body,
                    .frames = RecoverFrames(inputs, {.solver = method.solver, .ik = method.ik})};
}

}  // namespace etude
