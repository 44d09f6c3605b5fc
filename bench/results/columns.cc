#include "bench/results/columns.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <tuple>
#include <utility>

#include "bench/results/row_json.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kColumnsVersion = 2;

Json Encode(const ColumnIndex& index) {
  // Encode the swept values of each condition.
  Json conditions = Json::array(), kinds = Json::array(), statuses = Json::array();
  for (const std::vector<SweptValue>& condition : index.conditions) {
    Json values = Json::object();
    for (const SweptValue& swept : condition) values[swept.key] = swept.value;
    conditions.push_back(std::move(values));
  }
  // Encode each kind: its metrics with the reasons of missing values, its stages and its curves.
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
  for (const Named<Status>& status : kStatuses) statuses.push_back(status.name);
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
      return Fail(place, "found columns of version {}; this program reads version {}", version, kColumnsVersion);
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
    // Decode each kind. Reasons are indices of texts.
    for (const Json& entry : json.at("kinds")) {
      ColumnIndex::Kind& kind = index.kinds.emplace_back();
      kind.metrics = entry.at("metrics").get<std::vector<std::string>>();
      for (const Json& why : entry.at("why")) {
        kind.why.push_back(why.is_null() ? std::nullopt : std::optional(why.get<int>()));
        const int text = kind.why.back().value_or(0);
        if (text < ColumnIndex::kOwnReason || text >= static_cast<int>(index.texts.size())) {
          return Fail(place, "refers to a text that does not exist");
        }
      }
      if (kind.why.size() != kind.metrics.size())
        return Fail(place, "must state, for every metric, why the metric's value is missing");
      kind.stages = entry.at("stages").get<std::vector<std::string>>();
      for (const Json& curve : entry.at("series")) {
        kind.series.push_back({curve.at("name").get<std::string>(), curve.at("axis").get<std::string>(), {}, {}});
        if (curve.contains("names")) kind.series.back().names = curve.at("names").get<std::vector<std::string>>();
      }
    }
  } catch (const Json::exception& error) {
    return Fail(place, "is not an index of columns: {}", error.what());
  }
  if (index.conditions.empty() || index.trials < 1 || index.methods.empty()) return Fail(place, "contains no cells");
  if (index.texts.empty()) return Fail(place, "contains no texts; needed: at least one text, the empty text");
  // Encode the result again and compare it with the input: keys that this program ignores must be right too, because
  // other programs may use them.
  if (nlohmann::json(Encode(index)) != nlohmann::json(json)) return Fail(place, "differs from what a run writes");
  return index;
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

constexpr std::array<std::pair<const char*, double CellUsage::*>, 5> kTimes = {
    {{"wall_s", &CellUsage::wall_s},
     {"cpu_s", &CellUsage::cpu_s},
     {"peak_mb", &CellUsage::peak_mb},
     {"world_wall_s", &CellUsage::world_wall_s},
     {"world_cpu_s", &CellUsage::world_cpu_s}}};

Result<std::uint64_t> DigestNumber(const std::string& stage, const std::string& hex) {
  std::uint64_t number = 0;
  const auto [stop, status] = std::from_chars(hex.data(), hex.data() + hex.size(), number, 16);
  if (status == std::errc() && stop == hex.data() + hex.size() && hex.size() == 16) return number;
  return Fail({}, "the digest of {} is '{}'; allowed: 16 hexadecimal digits", stage, hex);
}

/// Returns a curve's identity: everything but its values.
auto IdentityOf(const Series& series) { return std::tie(series.name, series.axis, series.names); }

/// Returns true if `why` is right for a row's metric. If the metric has a value, `why` must be nullopt. Otherwise it
/// must be the index of the metric's reason in `texts`, or kOwnReason if this reason is the row's own.
bool IsWhy(std::optional<int> why, const MetricValue& metric, const Row& row, const std::vector<std::string>& texts) {
  if (!why || metric.value) return !why && metric.value;
  return metric.null_reason ==
         (*why == ColumnIndex::kOwnReason ? row.result.reason : texts[static_cast<std::size_t>(*why)]);
}

}  // namespace

Result<void> WriteColumnIndex(const FilePath& folder, const ColumnIndex& index) {
  return SaveJson(folder / kIndexFile, Encode(index), OnDisk::kLater);
}

Result<ColumnIndex> ReadColumnIndex(const FilePath& folder) {
  ASSIGN_OR_RETURN(const auto json, ReadJsonFile(folder / kIndexFile));
  return Decode(json, {(folder / kIndexFile).string()});
}

FilePath ColumnFile(const FilePath& folder, const std::string& name) { return folder / (name + ".npy"); }
std::string DigestColumn(const std::string& stage) { return "digest_" + stage; }

std::set<fs::path> FilesOfColumns(const ColumnIndex& index) {
  const fs::path own = fs::path(kColumnsFolder) / index.scenario, times = fs::path(kTimesFolder) / index.scenario;
  std::set<fs::path> files = {own / kIndexFile};
  const auto add = [&](const fs::path& folder, const std::string& name) {
    files.insert(ColumnFile(folder, name).whole());
  };
  for (const char* name : {"status", "kind", "reason", "clip", "units"}) add(own, name);
  for (const auto& [name, time] : kTimes) add(times, name);
  for (const ColumnIndex::Kind& kind : index.kinds) {
    for (const std::string& metric : kind.metrics) add(own, metric);
    for (const std::string& stage : kind.stages) add(own, DigestColumn(stage));
    for (const Series& series : kind.series) {
      add(own / kSeriesFolder, series.name);
      add(own / kSeriesFolder, series.name + kCurveEnds);
    }
  }
  return files;
}

template <typename Number>
Result<void> NpyColumns<Number>::Put(std::size_t row, const std::string& name, Number number) {
  NpyWriter* column = columns_.Find(name);
  if (column == nullptr) {
    ASSIGN_OR_RETURN(auto writer, NpyWriter::Begin(ColumnFile(folder_, name), kNpyType<Number>));
    column = &columns_.Add(name, std::move(writer));
  }
  RETURN_IF_ERROR(FillUp(row, *column));
  return column->Add(number);
}

template <typename Number>
Result<void> NpyColumns<Number>::FillUp(std::size_t rows, NpyWriter& writer) const {
  while (writer.count() < rows) RETURN_IF_ERROR(writer.Add(fill_));
  return {};
}

template <typename Number>
Result<void> NpyColumns<Number>::Finish(const std::vector<std::size_t>& shape) {
  const std::size_t rows = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  for (auto& [name, writer] : columns_) {
    RETURN_IF_ERROR(FillUp(rows, writer));
    RETURN_IF_ERROR(writer.Finish(shape));
  }
  return {};
}

ColumnWriter::ColumnWriter(const fs::path& folder, const Study& study)
    : folder_(Inside(folder) / kColumnsFolder / study.scenario),
      values_(folder_, kNone),
      digests_(folder_, 0),
      indices_(folder_, 0),
      statuses_(folder_, 0),
      times_(Inside(folder) / kTimesFolder / study.scenario, 0) {
  index_.scenario = study.scenario;
  index_.task = study.task;
  index_.conditions = study.conditions;
  index_.trials = study.trials;
  for (const ComparedMethod& method : study.methods) index_.methods.push_back(method.name);
  text_indices_[""] = 0;
}

std::uint32_t ColumnWriter::TextOf(const std::string& text) {
  if (text.empty()) return 0;
  const auto [place, is_new] = text_indices_.emplace(text, static_cast<std::uint32_t>(index_.texts.size()));
  if (is_new) index_.texts.push_back(text);
  return place->second;
}

std::uint32_t ColumnWriter::KindOf(const Row& row) {
  const CellResult& result = row.result;
  const auto is_like = [&](const ColumnIndex::Kind& kind) {
    return std::ranges::equal(kind.metrics, result.metrics, {}, {}, &MetricValue::id) &&
           std::ranges::equal(
               kind.why, result.metrics,
               [&](const auto& why, const MetricValue& metric) { return IsWhy(why, metric, row, index_.texts); }) &&
           std::ranges::equal(kind.stages, result.digests, {}, {}, [](const auto& digest) { return digest.first; }) &&
           std::ranges::equal(kind.series, result.series, {}, IdentityOf, IdentityOf);
  };
  // Try the kind of the previous row first, because most rows have the same kind.
  if (!index_.kinds.empty() && is_like(index_.kinds[last_kind_])) return last_kind_;
  const auto found = std::ranges::find_if(index_.kinds, is_like);
  last_kind_ = static_cast<std::uint32_t>(found - index_.kinds.begin());
  if (found != index_.kinds.end()) return last_kind_;
  ColumnIndex::Kind& kind = index_.kinds.emplace_back();
  for (const MetricValue& metric : result.metrics) {
    kind.metrics.push_back(metric.id);
    const bool is_own = !metric.value && metric.null_reason == result.reason;
    kind.why.push_back(metric.value ? std::nullopt
                       : is_own     ? std::optional(ColumnIndex::kOwnReason)
                                    : std::optional(static_cast<int>(TextOf(metric.null_reason))));
  }
  for (const auto& [stage, digest] : result.digests) kind.stages.push_back(stage);
  for (const Series& series : result.series) kind.series.push_back({series.name, series.axis, {}, series.names});
  return last_kind_;
}

Result<void> ColumnWriter::Add(const Row& row, const CellUsage& usage) {
  const CellResult& result = row.result;
  RETURN_IF_ERROR(statuses_.Put(rows_, "status", static_cast<std::uint8_t>(result.status)));
  RETURN_IF_ERROR(indices_.Put(rows_, "kind", KindOf(row)));
  if (!result.reason.empty()) RETURN_IF_ERROR(indices_.Put(rows_, "reason", TextOf(result.reason)));
  if (!row.clip.empty()) RETURN_IF_ERROR(indices_.Put(rows_, "clip", TextOf(row.clip)));
  if (!row.units.empty()) RETURN_IF_ERROR(indices_.Put(rows_, "units", TextOf(Json(row.units).dump())));
  if (const Json judged = EncodeJudged(result.judged); !judged.empty()) {
    RETURN_IF_ERROR(indices_.Put(rows_, "judged", TextOf(judged.dump())));
  }
  for (const MetricValue& metric : result.metrics) {
    if (metric.value) RETURN_IF_ERROR(values_.Put(rows_, metric.id, *metric.value));
  }
  for (const auto& [stage, digest] : result.digests) {
    ASSIGN_OR_RETURN(const auto number, DigestNumber(stage, digest));
    RETURN_IF_ERROR(digests_.Put(rows_, DigestColumn(stage), number));
  }
  for (const Series& series : result.series) RETURN_IF_ERROR(AddSeries(series));
  for (const auto& [name, time] : kTimes) RETURN_IF_ERROR(times_.Put(rows_, name, static_cast<float>(usage.*time)));
  ++rows_;
  return {};
}

Result<void> ColumnWriter::AddSeries(const Series& series) {
  Curve* curve = curves_.Find(series.name);
  if (curve == nullptr) {
    ASSIGN_OR_RETURN(auto values, NpyWriter::Begin(ColumnFile(folder_ / kSeriesFolder, series.name), kNpyType<double>));
    ASSIGN_OR_RETURN(auto ends, NpyWriter::Begin(ColumnFile(folder_ / kSeriesFolder, series.name + kCurveEnds),
                                                 kNpyType<std::uint64_t>));
    curve = &curves_.Add(series.name, {std::move(values), std::move(ends)});
  }
  RETURN_IF_ERROR(curve->FillUp(rows_));
  for (double value : series.values) RETURN_IF_ERROR(curve->values.Add(value));
  return curve->ends.Add(curve->values.count());
}

Result<void> ColumnWriter::Curve::FillUp(std::size_t rows) {
  while (ends.count() < rows) RETURN_IF_ERROR(ends.Add(values.count()));
  return {};
}

Result<void> ColumnWriter::Finish() {
  const std::vector<std::size_t> shape = index_.shape();
  RETURN_IF_ERROR(values_.Finish(shape));
  RETURN_IF_ERROR(digests_.Finish(shape));
  RETURN_IF_ERROR(indices_.Finish(shape));
  RETURN_IF_ERROR(statuses_.Finish(shape));
  RETURN_IF_ERROR(times_.Finish(shape));
  for (auto& [name, curve] : curves_) {
    RETURN_IF_ERROR(curve.FillUp(rows_));
    RETURN_IF_ERROR(curve.values.Finish({curve.values.count()}));
    RETURN_IF_ERROR(curve.ends.Finish(shape));
  }
  return WriteColumnIndex(folder_, index_);
}

}  // namespace etude
