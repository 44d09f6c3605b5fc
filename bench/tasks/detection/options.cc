#include "bench/tasks/detection/options.h"

#include "engine/base/names.h"

namespace etude {
namespace {

const std::vector<std::string> kWeights = {"fixed", "adaptive"};
constexpr Range kShare{0, 1};

void ReadRecogniser(Fields& fields, KeyPoseOptions& options) {
  // A threshold of 0 would call everything right.
  options.threshold = fields.Number("threshold", options.threshold, {0.01, 1});
  options.hold_frames = fields.Integer("hold_frames", options.hold_frames, {1, 30});
}

Result<DetectionMethod> ReadMethod(const Node& node, const KeyPoseOptions& common) {
  Fields fields(node, "a method of task detection");
  DetectionMethod method;
  method.name = fields.RequiredText("name");
  method.filter.kind = FilterOf(fields.Choice("filter", FilterNames(), "none"));
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
  if (auto done = fields.Finish(); !done) return tl::unexpected(done.error());
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
    auto method = ReadMethod(node, common);
    if (!method) return tl::unexpected(method.error());
    read.push_back(*std::move(method));
  }
  return read;
}

std::vector<std::pair<std::string, std::string>> DetectionMethodKeys() {
  return {{"filter", Join(FilterNames())},
          {"recogniser", "key-pose"},
          {"weights", Join(kWeights)},
          {"threshold", "the weighted share of a key pose's angles that must be met, in (0, 1]"},
          {"hold_frames", "for how many frames in a row"},
          {"inferred_weight", "adaptive weights: what a feature with an inferred joint counts"},
          {"not_tracked_weight", "adaptive weights: what a feature with a joint not tracked counts"}};
}

}  // namespace etude
