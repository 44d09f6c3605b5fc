#include "bench/tasks/detection/session_world.h"

#include <algorithm>

#include "bench/tasks/detection/exchange.h"
#include "bench/tasks/detection/run.h"
#include "bench/tasks/sensing/camera_stream.h"

namespace etude {

SessionWorld::SessionWorld(const std::vector<ReadyMethod>& methods, Decide decide, const Repertoire& repertoire,
                           DetectionWorld world, bool keeps_motion, Set set)
    : methods_(methods),
      decide_(std::move(decide)),
      repertoire_(repertoire),
      world_(std::move(world)),
      keeps_motion_(keeps_motion),
      set_(std::move(set)) {}

void SessionWorld::PrepareShared() {
  decide_();
  if (world_.cameras != nullptr) world_.cameras->Film();
}

CellResult SessionWorld::Run(std::size_t index) {
  const auto& [method, recogniser] = methods_[index];
  if (world_.cameras != nullptr && !method.sees_truth) {
    const auto& captured = world_.cameras->See(method.Capture());
    if (!captured) return CellResult::Ended(Status::kFailed, captured.error().message);
  }
  return Score(JudgeSession(world_, SeenBy(method), repertoire_, *recogniser, decide_()[index]));
}

Result<Payload> SessionWorld::MakeSetting() { return set_ ? set_() : TaskWorld::MakeSetting(); }

Result<Payload> SessionWorld::MakeProblem() {
  if (world_.cameras == nullptr) return SessionPayload(world_);
  return Fail({}, "with cameras, every method makes its own skeletons, so there is no common stream to send");
}

Result<Payload> SessionWorld::MakeTruth() { return TruthPayload(world_); }

Result<CellResult> SessionWorld::Judge(const Json& answer) {
  ASSIGN_OR_RETURN(const auto verdict, ReadSessionAnswer(answer, world_, repertoire_));
  return Score(verdict);
}

const SeenStream& SessionWorld::SeenBy(const DetectionMethod& method) {
  const auto same = [&](const SeenByMethods& known) {
    return known.filter == method.filter && known.sees_truth == method.sees_truth && known.capture == method.capture;
  };
  auto found = std::ranges::find_if(seen_, same);
  if (found == seen_.end()) {
    found = seen_.insert(found, {method.filter, method.sees_truth, method.capture, SeeSession(world_, method)});
  }
  return found->seen;
}

CellResult SessionWorld::Score(const SessionVerdict& verdict) const {
  CellResult result = CellResult::Ended(Status::kOk, "");
  ScoreSession(world_, verdict, repertoire_, result);
  result.digests = world_digests_;
  for (auto& stage : VerdictDigests(verdict, repertoire_)) result.digests.push_back(std::move(stage));
  result.series = PerformanceSeries(world_, verdict, repertoire_);
  result.series.push_back(ScoreSeries(world_, verdict));
  if (keeps_motion_) result.recording = RecordSession(world_, verdict, repertoire_);
  return result;
}

}  // namespace etude
