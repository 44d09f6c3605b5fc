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
  return CaptureRun{
      .method = method,
      .cameras = *cameras,
      .take = *take,
      .observation = observation,
      .measured = measured,
      .frames = RecoverFrames({.lengths = stages.world().lengths, .seen = measured.seen, .marked = stages.marked()},
                              {.solver = method.solver, .ik = method.ik})};
}

}  // namespace etude
