#include "bench/tasks/capture/run.h"

#include <algorithm>
#include <utility>

#include "bench/tasks/capture/silhouettes.h"

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
  if (method.limbs == LimbSource::kSilhouettes) {
    ASSIGN_OR_RETURN(auto frames, FollowSilhouettes({.world = stages.world(),
                                                     .key = stages.key(),
                                                     .cameras = cameras->matrices,
                                                     .masks = observation.masks,
                                                     .start = method.start}));
    return CaptureRun{.method = method,
                      .cameras = *cameras,
                      .take = *take,
                      .observation = observation,
                      .measured = measured,
                      .frames = std::move(frames)};
  }
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
