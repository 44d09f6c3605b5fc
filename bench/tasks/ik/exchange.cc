#include "bench/tasks/ik/exchange.h"

#include <nlohmann/json.hpp>

#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/tree_json.h"

namespace etude {
namespace {

std::optional<int> ReadCount(AnswerFields& fields, const char* key) {
  constexpr int kMost = 1'000'000'000;
  if (!fields.Has(key)) return std::nullopt;
  return fields.Integer(key, 0, kMost);
}

}  // namespace

Payload DescribeIkSetting(const KinematicTree& tree, const IkOptions& options, const IkTrialOptions& trial) {
  Json setting = DescribeBodyTree(tree);
  setting.update(DescribeGoals(options));
  Json& asked = setting["asked"] = Json::array();
  if (trial.asks_positions) asked.push_back("position");
  if (trial.asks_axes) asked.push_back("orientation");
  return PayloadOf(std::move(setting));
}

Payload DescribeProblem(const KinematicTree& tree, const IkProblem& problem) {
  return PayloadOf({{"root", DescribeRoot(problem.start)},
                    {"start_angles_deg", InDegrees(problem.start.angles)},
                    {"targets", DescribeTargets(tree, problem.targets)}});
}

Payload DescribeTruth(const IkWorld& world) { return PayloadOf({{"angles_deg", InDegrees(world.truth.angles)}}); }

Result<IkAnswer> ReadIkAnswer(const Json& json, const KinematicTree& tree) {
  AnswerFields fields(json);
  IkAnswer answer;
  const Json& degrees = fields.List("angles_deg", tree.limits.size(), tree.limits.size());
  answer.iterations = ReadCount(fields, "iterations");
  answer.fk_evaluations = ReadCount(fields, "fk_evaluations");
  RETURN_IF_ERROR(fields.Finish());
  ASSIGN_OR_RETURN(auto angles, ReadDegrees(degrees, "angles_deg", tree.limits.size()));
  answer.angles = std::move(angles);
  return answer;
}

}  // namespace etude
