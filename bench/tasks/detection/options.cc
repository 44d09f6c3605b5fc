#include "bench/tasks/detection/options.h"

#include "engine/base/names.h"

namespace etude {
namespace {

const std::vector<std::string> kWeights = {"fixed", "adaptive"};
const std::vector<std::string> kOracles = {"stream"};
constexpr Range kShare{0, 1};

void ReadRecogniser(Fields& fields, KeyPoseOptions& options) {
  // A threshold of 0 would call everything right.
  options.threshold = fields.Number("threshold", options.threshold, {0.01, 1});
  options.hold_frames = fields.Integer("hold_frames", options.hold_frames, {1, 30});
}

bool ReadOracle(Fields& fields) {
  const Node* node = fields.Raw("oracle");
  if (node == nullptr) return false;
  const std::vector<std::string> stages = fields.Texts("oracle");
  for (const std::string& stage : stages) {
    if (stage != kOracles.front()) fields.Complain(node->place, UnknownName("oracle", stage, kOracles));
  }
  return !stages.empty();
}

Result<DetectionMethod> ReadMethod(const Node& node, const KeyPoseOptions& common) {
  Fields fields(node, "a method of task detection");
  DetectionMethod method;
  method.name = fields.RequiredText("name");
  method.filter.kind = FilterOf(fields.Choice("filter", FilterNames(), "none"));
  method.sees_truth = ReadOracle(fields);
  fields.Choice("recogniser", {"key-pose"}, "key-pose");
  KeyPoseOptions& recogniser = method.recogniser;
  recogniser = common;
  ReadRecogniser(fields, recogniser);
  const bool adaptive = fields.Choice("weights", kWeights, "fixed") == "adaptive";
  recogniser.weights = adaptive ? Weighting::kAdaptive : Weighting::kFixed;
  if (adaptive) {
    recogniser.inferred_weight = fields.Number("inferred_weight", recogniser.inferred_weight, kShare);
    recogniser.not_tracked_weight = fields.Number("not_tracked_weight", recogniser.not_tracked_weight, kShare);
  }
  RETURN_IF_ERROR(fields.Finish());
  return method;
}

}  // namespace

DetectionOptions ReadDetectionOptions(Fields& condition) {
  DetectionOptions options;
  options.session.events = condition.Integer("events", options.session.events, {1, 200});
  options.session.fault_share = condition.Number("fault_share", options.session.fault_share, kShare);
  options.session.skill = condition.Number("skill", options.session.skill, kShare);
  options.noise = condition.Number("noise", options.noise, {0, 10});
  options.turn_deg = condition.Number("turn_deg", options.turn_deg, {-180, 180});
  return options;
}

Result<std::vector<DetectionMethod>> ReadDetectionMethods(Fields& condition, std::span<const Node> methods) {
  KeyPoseOptions common;
  ReadRecogniser(condition, common);
  std::vector<DetectionMethod> read;
  for (const Node& node : methods) {
    ASSIGN_OR_RETURN(auto method, ReadMethod(node, common));
    read.push_back(std::move(method));
  }
  return read;
}

std::vector<KeyInfo> DetectionConditionKeys() {
  return {
      {"events", "1…200", "10", "How many performances a session holds."},
      {"fault_share", "0…1", "0.5", "Which share of them is danced wrong."},
      {"skill", "0…1", "1", "The learner's: 1 is careful, at 0 every deviation is twice as large."},
      {"noise", "0…10", "1", "Times the measured errors of a Kinect-like sensor."},
      {"turn_deg", "-180…180 (degrees)", "0", "How far the dancer is turned away from the sensor."},
      {"threshold", "0.01…1", "0.8", "The weighted share of a key pose's angles that must be met; for all methods."},
      {"hold_frames", "1…30", "3", "For how many frames in a row a key pose must be met; for all methods."}};
}

std::vector<KeyInfo> DetectionMethodKeys() {
  return {
      {"filter", Join(FilterNames()), "none", "How the sensed joints are smoothed first."},
      {"oracle", "a list of: " + Join(kOracles), "[]",
       "What is replaced by the truth: the skeletons as danced instead of as sensed, so what the sensor costs."},
      {"recogniser", "key-pose", "key-pose", "How a move is recognised: by passing its key poses in order."},
      {"weights", Join(kWeights), "fixed", "How much an angle counts: all alike, or by how well its joints are seen."},
      {"threshold", "0.01…1", "(the scenario's)", "The weighted share of a key pose's angles that must be met."},
      {"hold_frames", "1…30", "(the scenario's)", "For how many frames in a row it must be met."},
      {"inferred_weight", "0…1", "0.3", "What an angle with an inferred joint counts.", {"weights", {"adaptive"}}},
      {"not_tracked_weight",
       "0…1",
       "0",
       "What an angle with a joint that is not tracked counts.",
       {"weights", {"adaptive"}}}};
}

}  // namespace etude
