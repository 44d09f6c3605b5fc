#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/matching.h"
#include "bench/statistics/curves/curves.h"
#include "tests/bench/metrics/evaluators.h"
#include "tests/bench/metrics/vector_input.h"

namespace etude {
namespace {

Value CalledAlike(const Json& in) {
  const Json& pairs = in.at("pairs");
  if (pairs.size() != 1) return std::nullopt;
  return pairs.at(0).at("distance").get<double>() < in.at("threshold").get<double>() ? 1 : 0;
}

double RootMeanSquareJointDistanceCm(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (const Role role : AllRoles()) sum += glm::dot(a[role] - b[role], a[role] - b[role]);
  return 100 * std::sqrt(sum / static_cast<double>(kRoleCount));
}

Value JointDistance(const Json& in) {
  const BodyPose a = ReadPose(in.at("a")), b = ReadPose(in.at("b"));
  return in.at("method") == "point-cloud" ? RootMeanSquareJointDistanceCm(a, b) : MeanJointDistanceCm(a, b);
}

/// Turns pairs of poses into events: a close pair is "right", and a pair called alike is "called right".
std::vector<JudgedEvent> PairEvents(const Json& in) {
  std::vector<JudgedEvent> events;
  for (const Json& pair : in.at("pairs")) {
    const double distance = pair.at("distance").get<double>();
    events.push_back({pair.at("pose_gap_cm").get<double>() < 100 * kCloseGap,
                      distance < in.at("threshold").get<double>(), -distance});
  }
  return events;
}

}  // namespace

std::span<const Evaluator> PoseDistanceEvaluators() {
  static constexpr Evaluator kAll[] = {
      {"called_alike", CalledAlike},
      {"joint_distance_cm", JointDistance},
      {"close_auc", [](const Json& in) -> Value { return RocAuc(PairEvents(in)); }},
      {"close_f1", [](const Json& in) -> Value { return F1(CountConfusion(PairEvents(in))); }},
  };
  return kAll;
}

}  // namespace etude
