#include "bench/tasks/tracking/exchange.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/tree_json.h"

namespace etude {

Payload DescribeTrackingSetting(const TrackingOptions& options, const IkOptions& common) {
  Json setting = DescribeGoals(common);
  setting["rate_hz"] = options.rate_hz;
  return PayloadOf(std::move(setting));
}

Payload DescribeMotion(const TrackingWorld& world) {
  Json problem = DescribeBodyTree(world.tree);
  problem["start_angles_deg"] = InDegrees(world.first_angles);
  Json& frames = problem["frames"] = Json::array();
  for (std::size_t k = 0; k < world.truth.size(); ++k) {
    frames.push_back(
        {{"root", DescribeRoot(world.truth[k])}, {"targets", DescribeTargets(world.tree, world.targets[k])}});
  }
  return PayloadOf(std::move(problem));
}

Payload DescribeTrueAngles(const TrackingWorld& world) {
  Json frames = Json::array();
  for (const TreeState& state : world.truth) frames.push_back(InDegrees(state.angles));
  return PayloadOf({{"angles_deg", std::move(frames)}});
}

Result<TrackingAnswer> ReadTrackingAnswer(const Json& json, const TrackingWorld& world) {
  constexpr double kMaxReportedIterations = 1e9;
  const std::size_t count = world.truth.size();
  AnswerFields fields(json);
  TrackingAnswer answer;
  const Json& frames = fields.List("angles_deg", count, count);
  const bool tells_iterations = fields.Has("iterations");
  if (tells_iterations) answer.iterations.emplace();
  const Json& iterations = fields.List("iterations", 0, count);
  RETURN_IF_ERROR(fields.Finish());
  for (std::size_t k = 0; k < count; ++k) {
    ASSIGN_OR_RETURN(auto angles, ReadDegrees(frames[k], fields.PathOf("angles_deg", k), world.tree.limits.size()));
    answer.angles.push_back(std::move(angles));
  }
  if (!tells_iterations) return answer;
  ASSIGN_OR_RETURN(const auto counts, ReadNumbers(iterations, "iterations", count, {0, kMaxReportedIterations}));
  for (const double each : counts) {
    if (each != std::floor(each)) {
      return Fail({}, "iterations[{}]: {} is not a whole number", answer.iterations->size(), each);
    }
    answer.iterations->push_back(static_cast<int>(each));
  }
  return answer;
}

}  // namespace etude
