// Writes the files of metrics as C++, when the program is built:
//     etude_metric_table <out.cc> <file.yaml>...
// A file with a fault ends the build with its place. Not read by the program itself: yaml-cpp would take 30 ms of every
// start.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "bench/files/files.h"
#include "bench/files/json.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

std::string Literal(std::string_view text) { return fmt::format("R\"__text__({})__text__\"", text); }

std::string OneOf(Fields& fields, const char* key, const std::vector<std::string>& allowed) {
  fields.RequiredText(key);
  return fields.Choice(key, allowed, "");
}

double RequiredNumber(Fields& fields, const char* key) {
  const auto number = fields.OptionalNumber(key, {.lowest = 0});
  if (!number) fields.Complain(fields.node().place, fmt::format("'{}' is missing", key));
  return number.value_or(0);
}

const std::vector<Node>& RequiredList(Fields& fields, const char* key) {
  static const std::vector<Node> kNone;
  const Node* list = fields.Raw(key);
  if (list != nullptr && list->kind == Node::Kind::kSequence && !list->items.empty()) return list->items;
  fields.Complain(list != nullptr ? list->place : fields.node().place, fmt::format("'{}' must be a list", key));
  return kNone;
}

/// `- key`, whose meaning the domain tells, or `- key: meaning`.
Result<std::string> InputLiteral(const Node& node, const Node* shared) {
  const bool is_own = node.kind == Node::Kind::kMapping && node.entries.size() == 1;
  const std::string key = is_own ? node.entries[0].key : node.scalar;
  const Node* meaning = is_own ? &node.entries[0].value : shared != nullptr ? shared->Find(key) : nullptr;
  if (meaning == nullptr || meaning->scalar.empty()) return Fail(node.place, "what is the input '{}'?", key);
  return fmt::format("{{{}, {}}}, ", Literal(key), Literal(meaning->scalar));
}

Result<std::string> VectorLiteral(const Node& node) {
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
  if (auto done = fields.Finish(); !done) return tl::unexpected(done.error());
  const Place& place = node.Find("input")->place;
  const auto json = ReadJson(input, place.file, place.line);
  if (!json) return tl::unexpected(json.error());
  if (!json->is_object()) return Fail(place, "the input must be one JSON object");
  return fmt::format("    {{{}, {}, {}, {}, {}, {}}},\n", Literal(title), Literal(input),
                     expected ? fmt::format("{}", *expected) : "std::nullopt", Literal(null_reason), tolerance,
                     Literal(source));
}

/// The table of C++ as it grows.
struct Table {
  std::string vectors;  ///< an array per metric
  std::string metrics;
  std::set<std::string> ids;
};

Result<void> AddMetric(const Node& node, const std::string& domain, const Node* shared_inputs, Table& table) {
  Fields fields(node, "a metric");
  const std::string id = fields.RequiredText("id");
  if (!table.ids.insert(id).second) fields.Complain(node.place, fmt::format("the metric '{}' stands here twice", id));
  std::string text = fmt::format("{{.id = \"{}\", .version = {}", id, fields.Integer("version", 1, {.lowest = 1}));
  text +=
      fmt::format(", .label = {}, .unit = {}", Literal(fields.RequiredText("label")), Literal(fields.Text("unit", "")));
  const std::string direction = OneOf(fields, "direction", {"lower", "higher", "neither"});
  text += direction == "neither"
              ? ", .direction = Direction::kNeither"
              : fmt::format(", .direction = Direction::k{}IsBetter", direction == "lower" ? "Lower" : "Higher");
  text += fmt::format(", .aggregate = Aggregate::k{}",
                      OneOf(fields, "aggregate", {"median", "mean"}) == "median" ? "Median" : "Mean");
  text += fmt::format(", .practical = {}", RequiredNumber(fields, "practical_threshold"));
  for (const char* key : {"definition", "practical_reason", "formula", "null_rule", "source"}) {
    text += fmt::format(", .{} = {}", key, Literal(fields.RequiredText(key)));
  }
  const std::vector<Node>&inputs = RequiredList(fields, "inputs"), &vectors = RequiredList(fields, "vectors");
  if (auto done = fields.Finish(); !done) return done;
  text += ", .inputs = {";
  for (const Node& input : inputs) {
    const auto literal = InputLiteral(input, shared_inputs);
    if (!literal) return tl::unexpected(literal.error());
    text += *literal;
  }
  const std::string array = fmt::format("kVectors{}", table.ids.size());
  table.vectors += fmt::format("constexpr MetricVector {}[] = {{\n", array);
  for (const Node& vector : vectors) {
    const auto literal = VectorLiteral(vector);
    if (!literal) return tl::unexpected(literal.error());
    table.vectors += *literal;
  }
  table.vectors += "};\n";
  table.metrics += fmt::format("{}}}, .vectors = {}, .domain = {}}},\n", text, array, Literal(domain));
  return {};
}

Result<void> AddDomain(const std::string& file, Table& table) {
  const auto text = ReadWholeFile(file);
  if (!text) return tl::unexpected(text.error());
  const auto document = ParseYaml(*text, file);
  if (!document) return tl::unexpected(document.error());
  Fields fields(*document, "a domain of metrics");
  const std::string domain = fields.RequiredText("domain");
  const Node* shared_inputs = fields.Raw("inputs");
  const std::vector<Node>& metrics = RequiredList(fields, "metrics");
  if (auto done = fields.Finish(); !done) return done;
  for (const Node& metric : metrics) {
    if (auto done = AddMetric(metric, domain, shared_inputs, table); !done) return done;
  }
  return {};
}

Result<void> Run(const std::string& out, const std::vector<std::string>& files) {
  Table table;
  for (const std::string& file : files) {
    if (auto done = AddDomain(file, table); !done) return done;
  }
  return WriteFileAtomically(
      out, fmt::format("#include \"bench/metrics/catalogue.h\"\n\nnamespace etude {{\nnamespace {{\n\n{}\n"
                       "}}  // namespace\n\nstd::span<const MetricInfo> AllMetrics() {{\n"
                       "  static const std::vector<MetricInfo> metrics = {{\n{}}};\n  return metrics;\n}}\n"
                       "\n}}  // namespace etude\n",
                       table.vectors, table.metrics));
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: etude_metric_table OUT.cc FILE.yaml...\n");
    return 2;
  }
  const auto done = etude::Run(argv[1], {argv + 2, argv + argc});
  if (!done) fmt::print(stderr, "{}\n", etude::ToString(done.error()));
  return done ? 0 : 1;
}
