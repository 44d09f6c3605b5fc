#include "bench/tasks/detection/task_world.h"

#include <nlohmann/json.hpp>

#include "bench/tasks/detection/exchange.h"

namespace etude {

DetectionTaskWorld::DetectionTaskWorld(const std::vector<DetectionMethod>& methods, const Repertoire& repertoire,
                                       DetectionWorld world, bool keeps_motion)
    : methods_(methods),
      repertoire_(repertoire),
      world_(std::move(world)),
      world_digests_(WorldDigests(world_)),
      keeps_motion_(keeps_motion) {}

CellResult DetectionTaskWorld::Run(std::size_t method) {
  return Score(JudgeSession(world_, See(methods_[method]), repertoire_, methods_[method]));
}

Result<Payload> DetectionTaskWorld::MakeProblem() { return SessionPayload(world_); }

Result<Payload> DetectionTaskWorld::MakeTruth() { return TruthPayload(world_); }

Result<CellResult> DetectionTaskWorld::Judge(const Json& answer) {
  ASSIGN_OR_RETURN(const auto verdict, ReadSessionAnswer(answer, world_, repertoire_));
  return Score(verdict);
}

const SeenSession& DetectionTaskWorld::See(const DetectionMethod& method) {
  const auto [seen, is_new] = seen_.try_emplace({method.filter.kind, method.sees_truth});
  if (is_new) seen->second = SeeSession(world_, method);
  return seen->second;
}

CellResult DetectionTaskWorld::Score(const SessionVerdict& verdict) const {
  CellResult result = CellResult::Ended(Status::kOk, "");
  ScoreSession(world_, verdict, result);
  result.digests = world_digests_;
  for (auto& stage : VerdictDigests(verdict)) result.digests.push_back(std::move(stage));
  result.series.push_back(ScoreSeries(world_, verdict));
  if (keeps_motion_) result.recording = RecordSession(world_, verdict);
  return result;
}

}  // namespace etude
