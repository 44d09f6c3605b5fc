// Writes the catalogue's files as C++, when the program is built:
//     etude_metric_table <out.cc> <file.yaml>...
// An error in a file stops the build with a message that states the error's position. The program does not read the
// files itself, because yaml-cpp would need 30 ms or more for them at every start.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "engine/document/fields.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {
namespace {

constexpr auto kSource = R"(#include "bench/metrics/catalogue.h"

namespace etude {{

// The list takes 90 kB of stack while it is built, so it is built in a function of its own: a caller of AllMetrics would
// reserve them each time.
[[gnu::noinline]] static std::vector<MetricInfo> BuildMetrics() {{
{}
  return {{
{}  }};
}}

std::span<const MetricInfo> AllMetrics() {{
  static const std::vector<MetricInfo> metrics = BuildMetrics();
  return metrics;
}}

}}  // namespace etude
)";

/// The texts that fill the placeholders of kSource.
struct Table {
  std::string vectors;  ///< one array per metric
  std::string metrics;
  std::set<std::string> ids;
};

std::string Literal(std::string_view text) { return fmt::format("R\"__text__({})__text__\"", text); }

/// Reads a required text that must be one of the names in `values`; returns the C++ code for it.
std::string_view OneOf(Fields& fields, const char* key,
                       const std::vector<std::pair<std::string, std::string_view>>& values) {
  std::vector<std::string> allowed;
  for (const auto& [name, code] : values) allowed.push_back(name);
  fields.RequiredText(key);
  const std::string found = fields.Choice(key, allowed, allowed.front());
  return std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.first == found; })->second;
}

double RequiredNumber(Fields& fields, const char* key) {
  const auto number = fields.OptionalNumber(key, {.lowest = 0});
  if (!number) fields.Complain(fields.node().place, fmt::format("'{}' is missing", key));
  return number.value_or(0);
}

const std::vector<Node>& RequiredList(Fields& fields, const char* key) {
  static const std::vector<Node> none;
  const Node* list = fields.Raw(key);
  if (list != nullptr && list->kind == Node::Kind::kSequence && !list->items.empty()) return list->items;
  fields.Complain(list != nullptr ? list->place : fields.node().place,
                  fmt::format("'{}' must be a list of one or more", key));
  return none;
}

/// Returns the code for an input of a metric. The YAML is `- key: meaning`, or `- key` if the domain's `inputs` give
/// the meaning.
Result<std::string> InputCode(const Node& node, const Node* shared) {
  const bool has_meaning = node.kind == Node::Kind::kMapping && node.entries.size() == 1;
  const std::string key = has_meaning ? node.entries[0].key : node.scalar;
  const Node* meaning = has_meaning ? &node.entries[0].value : shared != nullptr ? shared->Find(key) : nullptr;
  if (meaning == nullptr || meaning->scalar.empty()) return Fail(node.place, "what is the input '{}'?", key);
  return fmt::format("{{{}, {}}}, ", Literal(key), Literal(meaning->scalar));
}

Result<std::string> VectorCode(const Node& node) {
  Fields fields(node, "a test vector");
  const std::string title = fields.RequiredText("title"), input = fields.RequiredText("input");
  const auto expected = fields.OptionalNumber("expected");
  const std::string null_reason = fields.Text("null_reason", "");
  const double tolerance = RequiredNumber(fields, "tolerance");
  const std::string source = fields.RequiredText("source");
  if (expected.has_value() != null_reason.empty()) {
    fields.Complain(node.place, "either 'expected' gives the value, or 'null_reason' says why there is none");
  }
  if (!source.starts_with("derived: ") && !source.starts_with("published: ")) {
    fields.Complain(node.place, "the source begins with neither 'derived: ' nor 'published: '");
  }
  RETURN_IF_ERROR(fields.Finish());
  const Place& place = node.Find("input")->place;
  ASSIGN_OR_RETURN(const Json json, ReadJson(input, place.file, place.line));
  if (!json.is_object()) return Fail(place, "the input must be one JSON object");
  const std::string value = expected ? fmt::format("{}", *expected) : "std::nullopt";
  return fmt::format("    {{{}, {}, {}, {}, {}, {}}},\n", Literal(title), Literal(input), value, Literal(null_reason),
                     tolerance, Literal(source));
}

/// Returns the code for the fields that hold a single value, in the order of MetricInfo.
std::string FactsCode(Fields& fields) {
  std::string code = fmt::format("{{.id = {}, .version = {}", Literal(fields.RequiredText("id")),
                                 fields.Integer("version", 1, {.lowest = 1}));
  code +=
      fmt::format(", .label = {}, .unit = {}", Literal(fields.RequiredText("label")), Literal(fields.Text("unit", "")));
  code += fmt::format(", .direction = Direction::{}",
                      OneOf(fields, "direction",
                            {{"lower", "kLowerIsBetter"}, {"higher", "kHigherIsBetter"}, {"neither", "kNeither"}}));
  code += fmt::format(", .aggregate = Aggregate::{}",
                      OneOf(fields, "aggregate", {{"median", "kMedian"}, {"mean", "kMean"}}));
  if (fields.Raw("weight") != nullptr) code += fmt::format(", .weight = {}", Literal(fields.RequiredText("weight")));
  if (fields.Raw("reads") != nullptr) {
    code += fmt::format(", .reading = Reading::{}",
                        OneOf(fields, "reads", {{"yes-no", "kYesNo"}, {"share", "kShare"}, {"score", "kScore"}}));
  }
  if (fields.Boolean("success", false)) code += ", .is_success = true";
  if (fields.Boolean("by_rate", false)) code += ", .by_rate = true";
  code += fmt::format(", .practical = {}", RequiredNumber(fields, "practical_threshold"));
  for (const char* key : {"definition", "practical_reason", "formula", "null_rule", "source"}) {
    code += fmt::format(", .{} = {}", key, Literal(fields.RequiredText(key)));
  }
  return code;
}

Result<void> AddMetric(const Node& node, const std::string& domain, const Node* shared_inputs, Table& table) {
  Fields fields(node, "a metric");
  std::string code = FactsCode(fields);
  const std::vector<Node>& inputs = RequiredList(fields, "inputs");
  const std::vector<Node>& vectors = RequiredList(fields, "vectors");
  RETURN_IF_ERROR(fields.Finish());
  const std::string& id = node.Find("id")->scalar;
  if (!table.ids.insert(id).second) return Fail(node.place, "the metric '{}' stands here twice", id);
  code += ", .inputs = {";
  for (const Node& input : inputs) {
    ASSIGN_OR_RETURN(const std::string input_code, InputCode(input, shared_inputs));
    code += input_code;
  }
  const std::string array = fmt::format("kVectors{}", table.ids.size());
  table.vectors += fmt::format("  static constexpr MetricVector {}[] = {{\n", array);
  for (const Node& vector : vectors) {
    ASSIGN_OR_RETURN(const std::string vector_code, VectorCode(vector));
    table.vectors += vector_code;
  }
  table.vectors += "  };\n";
  table.metrics += fmt::format("    {}}}, .vectors = {}, .domain = {}}},\n", code, array, Literal(domain));
  return {};
}

Result<void> AddDomain(const std::string& file, Table& table) {
  ASSIGN_OR_RETURN(const std::string text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(const Node document, ParseYaml(text, file));
  Fields fields(document, "a domain of metrics");
  const std::string domain = fields.RequiredText("domain");
  const Node* shared_inputs = fields.Raw("inputs");
  const std::vector<Node>& metrics = RequiredList(fields, "metrics");
  RETURN_IF_ERROR(fields.Finish());
  for (const Node& metric : metrics) RETURN_IF_ERROR(AddMetric(metric, domain, shared_inputs, table));
  return {};
}

Result<void> WriteTable(const std::string& out, const std::vector<std::string>& files) {
  Table table;
  for (const std::string& file : files) RETURN_IF_ERROR(AddDomain(file, table));
  return WriteFileAtomically(out, fmt::format(kSource, table.vectors, table.metrics));
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: etude_metric_table OUT.cc FILE.yaml...\n");
    return 2;
  }
  const auto done = etude::WriteTable(argv[1], {argv + 2, argv + argc});
  if (!done) fmt::print(stderr, "{}\n", etude::ToString(done.error()));
  return done ? 0 : 1;
}
