#include "io/real_takes/real_take.h"

#include <nlohmann/json.hpp>

#include "engine/document/fields.h"
#include "engine/document/node.h"

namespace etude {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr Range kMillimetres{0, 1e6};

OrderedJson OrNull(std::optional<double> value) { return value ? OrderedJson(*value) : OrderedJson(nullptr); }

RealDistance ReadDistance(const Node& node, Fields& take) {
  Fields fields(node, "a distance");
  RealDistance distance{.cameras = fields.RequiredText("cameras")};
  const auto number = [&](std::string_view key) -> std::optional<double> {
    const Node* value = fields.Raw(key);
    return value == nullptr || value->kind == Node::Kind::kNull ? std::nullopt
                                                                : fields.OptionalNumber(key, kMillimetres);
  };
  distance.median_mm = number("median_mm");
  distance.p95_mm = number("p95_mm");
  if (const auto read = fields.Finish(); !read) take.Complain(read.error().place, read.error().message);
  return distance;
}

}  // namespace

const std::vector<std::string>& RealRecoveries() {
  static const std::vector<std::string> names = {"keypoints", "marks", "silhouettes"};
  return names;
}

std::string WriteRealTake(const RealTake& take) {
  OrderedJson distances = OrderedJson::array();
  for (const RealDistance& distance : take.distances) {
    distances.push_back({{"cameras", distance.cameras},
                         {"median_mm", OrNull(distance.median_mm)},
                         {"p95_mm", OrNull(distance.p95_mm)}});
  }
  const OrderedJson json = {{"name", take.name},     {"recovery", take.recovery}, {"reference", take.reference},
                            {"films", take.films},   {"frames", take.frames},     {"rate_hz", take.rate_hz},
                            {"distances", distances}};
  return json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

Result<RealTake> ReadRealTake(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const Node node, ParseYaml(text, file));  // JSON is YAML
  Fields fields(node, "a capture of real films");
  RealTake take;
  take.name = fields.RequiredText("name");
  take.recovery = fields.Choice("recovery", RealRecoveries(), "");
  take.reference = fields.RequiredText("reference");
  take.films = fields.Texts("films");
  take.frames = fields.Integer("frames", 0, {1, 1e9});
  take.rate_hz = fields.Number("rate_hz", 0, {0.01, 1e6});
  const Node* distances = fields.Raw("distances");
  if (distances == nullptr || distances->items.empty()) {
    fields.Complain(distances == nullptr ? node.place : distances->place,
                    "'distances' is missing or empty; allowed: a list of one or more distances, each with its cameras");
  }
  if (take.recovery.empty()) fields.Complain(node.place, "'recovery' is missing");
  if (distances != nullptr) {
    for (const Node& distance : distances->items) take.distances.push_back(ReadDistance(distance, fields));
  }
  RETURN_IF_ERROR(fields.Finish());
  return take;
}

}  // namespace etude
