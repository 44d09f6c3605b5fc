#include "bench/gate/baseline_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/files/files.h"
#include "bench/files/json.h"

namespace etude {
namespace {

Json EncodePairs(const NamedDigests& pairs) {
  Json json = Json::object();
  for (const auto& [name, digest] : pairs) json[name] = digest;
  return json;
}

Json EncodeScenario(const SnapshotScenario& scenario) {
  Json metrics = Json::object();
  for (const auto& [id, version] : scenario.metrics) metrics[id] = version;
  return {{"scenario", scenario.name},
          {"seed", scenario.seed},
          {"trials", scenario.trials},
          {"metrics", std::move(metrics)},
          {"worlds", EncodePairs(scenario.worlds)},
          {"methods", EncodePairs(scenario.methods)}};
}

Json IdentityOf(const SnapshotScenario& scenario, const SnapshotCells& cells) {
  return {{"scenario", scenario.name}, {"condition", cells.condition}, {"method", cells.method}};
}

Json EncodeValues(const SnapshotValues& kept) {
  Json values = Json::array();
  for (const auto& value : kept.values) values.push_back(value ? Json(*value) : Json(nullptr));
  return values;
}

/// The lines of an array, one value each.
class Lines {
 public:
  void Add(const Json& json) {
    const auto text = WriteJson(json);
    if (!text && !error_) error_ = text.error();
    if (text) text_ += (text_.empty() ? "\n" : ",\n") + *text;
  }
  const std::string& text() const { return text_; }
  const std::optional<Error>& error() const { return error_; }

 private:
  std::string text_;
  std::optional<Error> error_;
};

}  // namespace

Result<std::string> WriteBaseline(const Snapshot& snapshot) {
  Lines scenarios, statuses, values;
  for (const SnapshotScenario& scenario : snapshot.scenarios) {
    scenarios.Add(EncodeScenario(scenario));
    for (const SnapshotCells& cells : scenario.cells) {
      const Json identity = IdentityOf(scenario, cells);
      Json line = identity;
      line["cells"] = cells.statuses;
      statuses.Add(line);
      for (const SnapshotValues& kept : cells.metrics) {
        line = identity;
        line["metric"] = kept.metric;
        if (const auto nulls = std::ranges::count(kept.values, std::optional<double>()); nulls > 0)
          line["nulls"] = nulls;
        line["values"] = EncodeValues(kept);
        values.Add(line);
      }
    }
  }
  for (const Lines* lines : {&scenarios, &statuses, &values}) {
    if (lines->error()) return tl::unexpected(*lines->error());
  }
  auto head = WriteJson({{"schema", kBaselineSchema}, {"etude", snapshot.program_version}, {"suite", snapshot.suite}});
  if (!head) return head;
  head->pop_back();  // its brace, to go on in it
  return fmt::format("{},\n\"scenarios\":[{}\n],\n\"statuses\":[{}\n],\n\"values\":[{}\n]}}\n", *head, scenarios.text(),
                     statuses.text(), values.text());
}

Result<Snapshot> LoadBaseline(const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  return ReadBaseline(text, path.string());
}

}  // namespace etude
