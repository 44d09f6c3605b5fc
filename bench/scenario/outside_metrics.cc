#include "bench/scenario/outside_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/keys/key_schema.h"
#include "bench/scenario/judging.h"
#include "bench/scenario/methods.h"
#include "engine/motion/body.h"
#include "io/files/json.h"

namespace etude {
namespace {

constexpr int kMaxExampleFrames = 10'000;
constexpr const char* kIdPattern = "^[a-z][a-z0-9_]{0,59}$";
/// The keys of a row of cells.jsonl that are not metrics. A metric must not have one of these names.
constexpr std::string_view kRowKeys[] = {"cell",   "scenario", "task",   "condition",    "trial",  "clip",    "units",
                                         "method", "status",   "reason", "null_reasons", "judged", "ok_share"};
/// The task for which a scenario cannot define metrics, because its cells keep no motion.
constexpr std::string_view kTaskWithoutMotion = "pose-distance";

bool IsMetricId(const std::string& name) {
  const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !name.empty() && name.size() <= 60 && name[0] >= 'a' && std::ranges::all_of(name, plain) &&
         !name.starts_with("digest_");
}

void ReadName(Fields& metric, OutsideMetric& own) {
  own.info.id = own.program.name = metric.RequiredText("name");
  if (!metric.ok()) return;
  const Place& place = metric.node().Find("name")->place;
  if (std::ranges::find(kRowKeys, own.info.id) != std::end(kRowKeys)) {
    metric.Complain(
        place, fmt::format("'{}' is a key of every row of results; choose another name for the metric", own.info.id));
  } else if (!IsMetricId(own.info.id)) {
    metric.Complain(place,
                    fmt::format("'{}' is not a valid metric name; allowed: at most 60 lower-case letters, digits and "
                                "'_'; the first must be a letter, and the name must not begin with 'digest_'",
                                own.info.id));
  }
}

/// Replaces `frames` and `joints_m` of a track by `poses`. A joint without positions is put at the origin.
Result<void> SpellOut(Json& track, const Place& place) {
  if (!track.is_object()) return Fail(place, "a track must be a mapping, found {}", ShowJson(track));
  if (track.contains("poses")) return {};
  // The track has the short form: a number of frames, and the positions of some joints.
  const Json frames = track.value("frames", Json());
  if (!frames.is_number_integer() || frames < 1 || frames > kMaxExampleFrames) {
    return Fail(place, "a track needs either 'poses', or 'frames' (from 1 to {}) and 'joints_m'; found {}",
                kMaxExampleFrames, ShowJson(track));
  }
  // Fill in the positions of the joints that the track lists.
  const std::size_t roles = AllRoles().size();
  Json poses(frames.get<std::size_t>(), Json(3 * roles, 0.0));
  const Json joints = track.value("joints_m", Json::object());
  for (const auto& [name, places] : joints.items()) {
    const auto role = FindRole(name);
    if (!role) return Fail(place, "'joints_m' contains '{}', which is not one of the twenty joints", name);
    if (!places.is_array() || places.size() != poses.size()) {
      return Fail(place, "'{}' needs {} positions, found {}", name, poses.size(), ShowJson(places));
    }
    for (std::size_t f = 0; f < places.size(); ++f) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!places[f].is_array() || places[f].size() != 3 || !places[f][axis].is_number()) {
          return Fail(place, "'{}' must be [x, y, z] in each frame, found {}", name, ShowJson(places[f]));
        }
        poses[f][3 * static_cast<std::size_t>(*role) + axis] = places[f][axis];
      }
    }
  }
  track.erase("frames");
  track.erase("joints_m");
  track["poses"] = std::move(poses);
  return {};
}

void ReadCell(Fields& fields, MetricExample& example) {
  const Node* node = fields.Raw("cell");
  if (node == nullptr) return;
  example.place = fields.node().place;
  Json cell = ToJson(*node);
  if (!cell.is_object() || !cell.contains("tracks") || !cell["tracks"].is_array()) {
    return fields.Complain(node->place, "'cell' must be a mapping with a list 'tracks', found " + Describe(*node));
  }
  for (Json& track : cell["tracks"]) {
    if (auto told = SpellOut(track, node->place); !told) return fields.Complain(node->place, told.error().message);
  }
  if (!cell.contains("extras")) cell["extras"] = Json::object();
  const auto text = WriteJson(cell);
  text ? void(example.cell_json = *text) : fields.Complain(node->place, text.error().message);
}

void ReadExpected(Fields& fields, MetricExample& example) {
  const Node* node = fields.Raw("expected");
  const Json value = node == nullptr ? Json() : ToJson(*node);
  if (value.is_number()) example.expected = value.get<double>();
  if (node == nullptr || value.is_number() || value.is_null() || value == "null") return;
  fields.Complain(node->place, "'expected' must be a number or null, found " + Describe(*node));
}

}  // namespace

const FieldTable<MetricExample>& MetricExampleFields() {
  using Key = Field<MetricExample>;
  static const FieldTable<MetricExample> table{
      {Key::Text("title", &MetricExample::title, "a text", "A title that states what the vector tests.")
           .WhenAbsent("(none)"),
       {{"cell",
         {"a mapping with a list `tracks` and, optionally, `extras`; each track has `name`, `rate_hz`, and either "
          "`poses` or both `frames` and `joints_m`",
          R"({"type":"object","required":["tracks"]})"},
         "",
         "The program's input. Joints that `joints_m` does not list are at the origin."},
        ReadCell},
       {{"expected",
         {"a number, or null if the metric has no value for this cell", R"({"type":["number","null","string"]})"},
         "null",
         "The value that the program must return."},
        ReadExpected},
       Key::Number("tolerance", &MetricExample::tolerance, {0, 1e9},
                   "Largest allowed absolute error of the returned value.")}};
  return table;
}

const FieldTable<OutsideMetric>& OutsideMetricFields() {
  using Key = Field<OutsideMetric>;
  static const FieldTable<OutsideMetric> table = [] {
    const auto info = [](auto member) { return Path(&OutsideMetric::info, member); };
    std::vector<Field<OutsideMetric>> fields = {
        {{"name", TextKind("a letter, then at most 59 of a…z, 0…9, '_'", kIdPattern), "",
          "The metric's id in rows and tables. It must differ from the ids of built-in metrics."},
         ReadName}};
    // The keys about the program are those of an outside method, but their descriptions differ.
    for (auto& field : FieldsOf<OutsideMetric>(OutsideMethodFields(), &OutsideMetric::program, Keep::kThese,
                                               {"exec", "options", "files", "time_s"})) {
      if (field.info.key == "exec") {
        field.info.fallback = "";
        field.info.meaning = "The program that computes the metric. It never runs in the process of a method.";
      }
      if (field.info.key == "time_s") field.info.meaning = "Time limit for one cell, in seconds.";
      fields.push_back(std::move(field));
    }
    // Add the keys about the metric.
    Append<OutsideMetric>(
        {Key::Text("unit", info(&MetricInfo::unit), "a text", "Unit of the metric's values, such as `mm` or `deg`.")
             .WhenAbsent("(none)")
             .With("reads", {"amount"}),
         Key::Name("direction", info(&MetricInfo::direction),
                   {{"lower", Direction::kLowerIsBetter},
                    {"higher", Direction::kHigherIsBetter},
                    {"neither", Direction::kNeither}},
                   "States which values are better."),
         Key::Number("version", info(&MetricInfo::version), {1, 1e6},
                     "Version of the metric. Increase it when you change the metric, because Etude never mixes values "
                     "of two versions."),
         Key::Name("aggregate", info(&MetricInfo::aggregate),
                   {{"median", Aggregate::kMedian}, {"mean", Aggregate::kMean}},
                   "How a run aggregates the values of all cells."),
         Key::Name("reads", info(&MetricInfo::reading),
                   {{"amount", Reading::kAmount},
                    {"yes-no", Reading::kYesNo},
                    {"share", Reading::kShare},
                    {"score", Reading::kScore}},
                   "The kind of value. Values of all kinds except `amount` must lie between 0 and 1; reports show them "
                   "in per cent."),
         {{"practical", NumberKind({1e-12, 1e12}), "(1; without a unit, 0.01)",
           "The smallest difference that matters."},
          [](Fields& metric, OutsideMetric& own) {
            own.info.practical = metric.Number("practical", own.info.unit.empty() ? 0.01 : 1, {1e-12, 1e12});
          }},
         Key::Text("label", info(&MetricInfo::label), "a text", "The metric's name in reports.").WhenAbsent("(`name`)"),
         Key::Text("definition", info(&MetricInfo::definition), "a text",
                   "One sentence that states what the metric measures.")
             .WhenAbsent("(none)"),
         // Add the key of the metric's test vectors.
         {{"vectors", ListKind("a list of test vectors", MappingKind("", MetricExampleFields().Describe())), "[]",
           "Cells whose value is known. Before a run computes its first cell, the program must reproduce these "
           "values."},
          [](Fields& metric, OutsideMetric& own) {
            own.vectors = ReadListed(metric, "vectors", "a test vector", MetricExampleFields());
          }}},
        fields);
    return FieldTable<OutsideMetric>{std::move(fields)};
  }();
  return table;
}

ValueKind HeadlineKind() {
  return {"a list; each entry is a metric of the task or a mapping",
          R"({"type":"array","items":{"anyOf":[{"type":"string"},{"$ref":"#/definitions/outside-metric"}]}})"};
}

std::vector<std::string> ReadHeadline(Fields& fields, const TaskKind& kind, std::vector<OutsideMetric>& own) {
  const Node* list = fields.Raw("metrics");
  // If the value is not a list, Fields::Texts adds the error.
  if (list != nullptr && list->kind != Node::Kind::kSequence) fields.Texts("metrics");
  if (list == nullptr || list->items.empty()) return kind.default_metrics;
  // Mappings define the scenario's own metrics. If the list has only mappings, the task's metrics come first.
  const auto is_own = [](const Node& item) { return item.kind == Node::Kind::kMapping; };
  std::vector<std::string> names;
  if (std::ranges::all_of(list->items, is_own)) names = kind.default_metrics;
  std::vector<std::string> known = MetricsOf(kind);
  for (const Node& item : list->items) {
    if (!is_own(item)) {
      NoteMetric(fields, kind.name, known, item.scalar, item.place, names);
      continue;
    }
    if (kind.name == kTaskWithoutMotion) {
      fields.Complain(item.place, fmt::format("a scenario of task {} cannot define its own metrics, because cells of "
                                              "this task keep no motion that a program could measure",
                                              kind.name));
    }
    auto read = ReadMapping(item, "your own metric", OutsideMetricFields());
    if (!read) {
      fields.Complain(read.error().place, read.error().message);
      continue;
    }
    MetricInfo& info = read->info;
    if (info.label.empty()) info.label = info.id;
    info.domain = "A metric that the scenario defines itself";
    if (auto added = AddMetric(info); !added) fields.Complain(item.place, added.error().message);
    known.push_back(info.id);
    NoteMetric(fields, kind.name, known, info.id, item.place, names);
    own.push_back(*std::move(read));
  }
  return names;
}

}  // namespace etude
