#include "bench/tasks/capture/run.h"

#include <algorithm>

#include "bench/tasks/capture/recovery.h"

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
  CaptureRun run{.method = method,
                 .cameras = *cameras,
                 .take = *take,
                 .observation = observation,
                 .measured = measured,
                 .body = {},
                 .frames = {}};
  ASSIGN_OR_RETURN(run.body, BodyFor(stages, run));
  RETURN_IF_ERROR(Recover(stages, run));
  return run;
}

}  // namespace etude
