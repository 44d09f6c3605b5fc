#include "bench/results/column_index.h"

#include <nlohmann/json.hpp>

#include "bench/files/files.h"
#include "bench/files/json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kColumnsVersion = 2;
constexpr const char* kIndexFile = "index.json";

Json Encode(const ColumnIndex& index) {
  Json conditions = Json::array(), kinds = Json::array(), statuses = Json::array();
  for (const std::vector<SweptValue>& condition : index.conditions) {
    Json values = Json::object();
    for (const SweptValue& swept : condition) values[swept.key] = swept.value;
    conditions.push_back(std::move(values));
  }
  for (const ColumnIndex::Kind& kind : index.kinds) {
    Json why = Json::array();
    for (const auto& text : kind.why) why.push_back(text ? Json(*text) : Json(nullptr));
    Json curves = Json::array();
    for (const Series& series : kind.series) {
      curves.push_back({{"name", series.name}, {"axis", series.axis}});
      if (!series.names.empty()) curves.back()["names"] = series.names;
    }
    kinds.push_back({{"metrics", kind.metrics}, {"why", why}, {"stages", kind.stages}, {"series", curves}});
  }
  for (int i = 0; i < kStatusCount; ++i) statuses.push_back(StatusName(static_cast<Status>(i)));
  return {{"format", "etude-columns"},
          {"version", kColumnsVersion},
          {"scenario", index.scenario},
          {"task", index.task},
          {"axes", {"condition", "trial", "method"}},
          {"conditions", std::move(conditions)},
          {"trials", index.trials},
          {"methods", index.methods},
          {"statuses", std::move(statuses)},
          {"kinds", std::move(kinds)},
          {"texts", index.texts}};
}

Result<ColumnIndex> Decode(const Json& json, const Place& place) {
  ColumnIndex index;
  try {
    if (const int version = json.at("version").get<int>(); version != kColumnsVersion) {
      return Fail(place, "columns of version {}; this program reads {}", version, kColumnsVersion);
    }
    index.scenario = json.at("scenario").get<std::string>();
    index.task = json.at("task").get<std::string>();
    for (const Json& values : json.at("conditions")) {
      std::vector<SweptValue>& condition = index.conditions.emplace_back();
      for (const auto& [key, value] : values.items()) condition.push_back({key, value.get<std::string>()});
    }
    index.trials = json.at("trials").get<int>();
    index.methods = json.at("methods").get<std::vector<std::string>>();
    index.texts = json.at("texts").get<std::vector<std::string>>();
    for (const Json& entry : json.at("kinds")) {
      ColumnIndex::Kind& kind = index.kinds.emplace_back();
      kind.metrics = entry.at("metrics").get<std::vector<std::string>>();
      for (const Json& why : entry.at("why")) {
        kind.why.push_back(why.is_null() ? std::nullopt : std::optional(why.get<int>()));
        const int text = kind.why.back().value_or(0);
        if (text < ColumnIndex::kOwnReason || text >= static_cast<int>(index.texts.size())) {
          return Fail(place, "names a text that is not there");
        }
      }
      if (kind.why.size() != kind.metrics.size()) return Fail(place, "does not tell of every metric why it is missing");
      kind.stages = entry.at("stages").get<std::vector<std::string>>();
      for (const Json& curve : entry.at("series")) {
        kind.series.push_back({curve.at("name").get<std::string>(), curve.at("axis").get<std::string>(), {}, {}});
        if (curve.contains("names")) kind.series.back().names = curve.at("names").get<std::vector<std::string>>();
      }
    }
  } catch (const Json::exception& error) {
    return Fail(place, "not an index of columns: {}", error.what());
  }
  if (index.conditions.empty() || index.trials < 1 || index.methods.empty()) return Fail(place, "tells of no cells");
  if (index.texts.empty()) return Fail(place, "holds no texts, the first of which is empty");
  return index;
}

}  // namespace

Result<void> WriteColumnIndex(const fs::path& folder, const ColumnIndex& index) {
  return SaveJson(folder / kIndexFile, Encode(index));
}

Result<ColumnIndex> ReadColumnIndex(const fs::path& folder) {
  const std::string path = (folder / kIndexFile).string();
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  ASSIGN_OR_RETURN(const auto json, ReadJson(text, path));
  return Decode(json, {path});
}

fs::path ColumnFile(const fs::path& folder, const std::string& name) { return folder / (name + ".npy"); }
std::string DigestColumn(const std::string& stage) { return "digest_" + stage; }

}  // namespace etude
