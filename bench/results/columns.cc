#include "bench/results/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "bench/files/files.h"
#include "bench/files/json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kColumnsVersion = 1;
constexpr const char* kIndexFile = "index.json";
constexpr int kOwnReason = -1;  // a value is missing for the reason that the cell has
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The times of a cell, by the names of their columns.
constexpr std::array<std::pair<const char*, double CellUsage::*>, 5> kTimes = {
    {{"wall_s", &CellUsage::wall_s},
     {"cpu_s", &CellUsage::cpu_s},
     {"peak_mb", &CellUsage::peak_mb},
     {"world_wall_s", &CellUsage::world_wall_s},
     {"world_cpu_s", &CellUsage::world_cpu_s}}};

constexpr const char* kSeriesFolder = "series";
constexpr std::string_view kEnds = ".ends";  // of each row's part of a curve's values

fs::path ColumnFile(const fs::path& folder, const std::string& name) { return folder / (name + ".npy"); }

Json EncodeIndex(const ColumnIndex& index) {
  Json conditions = Json::array(), kinds = Json::array(), statuses = Json::array();
  for (const std::vector<SweptValue>& condition : index.conditions) {
    Json values = Json::object();
    for (const SweptValue& swept : condition) values[swept.key] = swept.value;
    conditions.push_back(std::move(values));
  }
  for (const ColumnIndex::Kind& kind : index.kinds) {
    Json why = Json::array();
    for (const auto& text : kind.why) why.push_back(text ? Json(*text) : Json(nullptr));
    kinds.push_back({{"metrics", kind.metrics}, {"why", why}, {"stages", kind.stages}, {"series", kind.series}});
  }
  for (int i = 0; i <= static_cast<int>(Status::kSkipped); ++i) statuses.push_back(StatusName(static_cast<Status>(i)));
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

Result<ColumnIndex> ReadIndex(const fs::path& path) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  ASSIGN_OR_RETURN(const auto json, ReadJson(text, path.string()));
  const Place place{path.string()};
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
        if (kind.why.back().value_or(0) >= static_cast<int>(index.texts.size())) {
          return Fail(place, "names a text that is not there");
        }
      }
      if (kind.why.size() != kind.metrics.size()) return Fail(place, "does not tell of every metric why it is missing");
      kind.stages = entry.at("stages").get<std::vector<std::string>>();
      kind.series = entry.at("series").get<std::vector<std::pair<std::string, std::string>>>();
    }
  } catch (const Json::exception& error) {
    return Fail(place, "not an index of columns: {}", error.what());
  }
  return index;
}

/// "00c0ffee00c0ffee" as a number.
Result<std::uint64_t> DigestNumber(const std::string& stage, const std::string& hex) {
  std::uint64_t number = 0;
  const auto [stop, status] = std::from_chars(hex.data(), hex.data() + hex.size(), number, 16);
  if (status == std::errc() && stop == hex.data() + hex.size() && hex.size() == 16) return number;
  return Fail({}, "the digest of {} is '{}', not 16 hexadecimal digits", stage, hex);
}

/// How the text of a missing value is named, given the row's own reason.
bool IsWhy(std::optional<int> why, const MetricValue& metric, const Row& row, const std::vector<std::string>& texts) {
  if (!why || metric.value) return !why && metric.value;
  return metric.null_reason == (*why == kOwnReason ? row.result.reason : texts[static_cast<std::size_t>(*why)]);
}

}  // namespace

template <typename Number>
Result<void> NpyColumns<Number>::Put(std::size_t row, const std::string& name, Number number) {
  auto column = columns_.find(name);
  if (column == columns_.end()) {
    ASSIGN_OR_RETURN(auto writer, NpyWriter::Begin(ColumnFile(folder_, name), kNpyType<Number>));
    column = columns_.emplace(name, std::move(writer)).first;
  }
  RETURN_IF_ERROR(FillUp(row, column->second));
  return column->second.Add(number);
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
    : folder_(folder / kColumnsFolder / study.scenario),
      values_(folder_, kNone),
      digests_(folder_, 0),
      places_(folder_, 0),
      statuses_(folder_, 0),
      times_(folder / kTimesFolder / study.scenario, 0) {
  index_.scenario = study.scenario;
  index_.task = study.task;
  index_.conditions = study.conditions;
  index_.trials = study.trials;
  for (const ComparedMethod& method : study.methods) index_.methods.push_back(method.name);
  text_places_[""] = 0;
}

std::uint32_t ColumnWriter::TextOf(const std::string& text) {
  if (text.empty()) return 0;
  const auto [place, is_new] = text_places_.emplace(text, static_cast<std::uint32_t>(index_.texts.size()));
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
           std::ranges::equal(kind.series, result.series, [](const auto& known, const Series& series) {
             return known.first == series.name && known.second == series.axis;
           });
  };
  // Most rows are of the kind of the one before them.
  if (!index_.kinds.empty() && is_like(index_.kinds[last_kind_])) return last_kind_;
  const auto found = std::ranges::find_if(index_.kinds, is_like);
  last_kind_ = static_cast<std::uint32_t>(found - index_.kinds.begin());
  if (found != index_.kinds.end()) return last_kind_;
  ColumnIndex::Kind& kind = index_.kinds.emplace_back();
  for (const MetricValue& metric : result.metrics) {
    kind.metrics.push_back(metric.id);
    const bool is_own = !metric.value && metric.null_reason == result.reason;
    kind.why.push_back(metric.value ? std::nullopt
                       : is_own     ? std::optional(kOwnReason)
                                    : std::optional(static_cast<int>(TextOf(metric.null_reason))));
  }
  for (const auto& [stage, digest] : result.digests) kind.stages.push_back(stage);
  for (const Series& series : result.series) kind.series.emplace_back(series.name, series.axis);
  return last_kind_;
}

Result<void> ColumnWriter::Add(const Row& row, const CellUsage& usage) {
  const CellResult& result = row.result;
  RETURN_IF_ERROR(statuses_.Put(rows_, "status", static_cast<std::uint8_t>(result.status)));
  RETURN_IF_ERROR(places_.Put(rows_, "kind", KindOf(row)));
  if (!result.reason.empty()) RETURN_IF_ERROR(places_.Put(rows_, "reason", TextOf(result.reason)));
  if (!row.clip.empty()) RETURN_IF_ERROR(places_.Put(rows_, "clip", TextOf(row.clip)));
  if (!row.units.empty()) RETURN_IF_ERROR(places_.Put(rows_, "units", TextOf(Json(row.units).dump())));
  for (const MetricValue& metric : result.metrics) {
    if (metric.value) RETURN_IF_ERROR(values_.Put(rows_, metric.id, *metric.value));
  }
  for (const auto& [stage, digest] : result.digests) {
    ASSIGN_OR_RETURN(const auto number, DigestNumber(stage, digest));
    RETURN_IF_ERROR(digests_.Put(rows_, "digest_" + stage, number));
  }
  for (const Series& series : result.series) RETURN_IF_ERROR(AddSeries(series));
  for (const auto& [name, time] : kTimes) RETURN_IF_ERROR(times_.Put(rows_, name, static_cast<float>(usage.*time)));
  ++rows_;
  return {};
}

Result<void> ColumnWriter::AddSeries(const Series& series) {
  auto curve = curves_.find(series.name);
  if (curve == curves_.end()) {
    ASSIGN_OR_RETURN(auto values, NpyWriter::Begin(ColumnFile(folder_ / kSeriesFolder, series.name), kNpyType<double>));
    ASSIGN_OR_RETURN(auto ends, NpyWriter::Begin(ColumnFile(folder_ / kSeriesFolder, series.name + std::string(kEnds)),
                                                 kNpyType<std::uint64_t>));
    curve = curves_.emplace(series.name, Curve{std::move(values), std::move(ends)}).first;
  }
  RETURN_IF_ERROR(curve->second.FillUp(rows_));
  for (double value : series.values) RETURN_IF_ERROR(curve->second.values.Add(value));
  return curve->second.ends.Add(curve->second.values.count());
}

Result<void> ColumnWriter::Curve::FillUp(std::size_t rows) {
  while (ends.count() < rows) RETURN_IF_ERROR(ends.Add(values.count()));
  return {};
}

Result<void> ColumnWriter::Finish() {
  const std::vector<std::size_t> shape = {index_.conditions.size(), static_cast<std::size_t>(index_.trials),
                                          index_.methods.size()};
  RETURN_IF_ERROR(values_.Finish(shape));
  RETURN_IF_ERROR(digests_.Finish(shape));
  RETURN_IF_ERROR(places_.Finish(shape));
  RETURN_IF_ERROR(statuses_.Finish(shape));
  RETURN_IF_ERROR(times_.Finish(shape));
  for (auto& [name, curve] : curves_) {
    RETURN_IF_ERROR(curve.FillUp(rows_));
    RETURN_IF_ERROR(curve.values.Finish({curve.values.count()}));
    RETURN_IF_ERROR(curve.ends.Finish(shape));
  }
  ASSIGN_OR_RETURN(const auto text, WriteJson(EncodeIndex(index_)));
  return WriteFileAtomically(folder_ / kIndexFile, text + "\n");
}

namespace {

/// The columns of one scenario.
class ScenarioColumns {
 public:
  static Result<ScenarioColumns> Open(const fs::path& folder, const std::string& scenario) {
    const fs::path own = folder / kColumnsFolder / scenario;
    ScenarioColumns columns;
    ASSIGN_OR_RETURN(columns.index_, ReadIndex(own / kIndexFile));
    const ColumnIndex& index = columns.index_;
    ASSIGN_OR_RETURN(columns.status_, columns.OpenColumn<std::uint8_t>(own, "status"));
    ASSIGN_OR_RETURN(columns.kind_, columns.OpenColumn<std::uint32_t>(own, "kind"));
    for (std::size_t i = 0; i < columns.texts_.size(); ++i) {
      if (std::error_code none; !fs::exists(ColumnFile(own, kTextColumns[i]), none)) continue;
      ASSIGN_OR_RETURN(columns.texts_[i], columns.OpenColumn<std::uint32_t>(own, kTextColumns[i]));
    }
    for (const ColumnIndex::Kind& kind : index.kinds) {
      KindColumns& of_kind = columns.kinds_.emplace_back();
      for (std::size_t i = 0; i < kind.metrics.size(); ++i) {
        if (!kind.why[i]) RETURN_IF_ERROR(columns.OpenOnce<double>(own, kind.metrics[i], columns.values_));
        of_kind.values.push_back(kind.why[i] ? nullptr : &columns.values_->at(kind.metrics[i]));
      }
      for (const std::string& stage : kind.stages) {
        RETURN_IF_ERROR(columns.OpenOnce<std::uint64_t>(own, "digest_" + stage, columns.digests_));
        of_kind.digests.push_back(&columns.digests_->at("digest_" + stage));
      }
      for (const auto& [name, axis] : kind.series) {
        RETURN_IF_ERROR(columns.OpenOnce<std::uint64_t>(own / kSeriesFolder, name + std::string(kEnds), columns.ends_));
        of_kind.ends.push_back(&columns.ends_->at(name + std::string(kEnds)));
        if (!columns.curves_->contains(name)) {
          ASSIGN_OR_RETURN(auto curve, NpyFile::Open(ColumnFile(own / kSeriesFolder, name), kNpyType<double>));
          columns.curves_->emplace(name, std::move(curve));
        }
        of_kind.curves.push_back(&columns.curves_->at(name));
      }
    }
    const fs::path times = folder / kTimesFolder / scenario;
    if (std::error_code none; fs::exists(ColumnFile(times, "cpu_s"), none)) {
      ASSIGN_OR_RETURN(columns.cpu_s_, columns.OpenColumn<float>(times, "cpu_s"));
    }
    RETURN_IF_ERROR(columns.CheckNumbers(own));
    return columns;
  }

  const ColumnIndex& index() const { return index_; }

  void Read(std::size_t at, Row& row) const {
    const std::size_t methods = index_.methods.size(), trials = static_cast<std::size_t>(index_.trials);
    row.scenario = index_.scenario;
    row.task = index_.task;
    row.condition = index_.conditions[at / (methods * trials)];
    row.trial = static_cast<int>(at / methods % trials);
    row.method = index_.methods[at % methods];
    row.clip = TextAt(kClip, at);
    const std::string& units = TextAt(kUnits, at);
    row.units = units.empty() ? std::vector<std::string>{} : Json::parse(units).get<std::vector<std::string>>();
    CellResult& result = row.result;
    result.status = static_cast<Status>(status_->Numbers<std::uint8_t>()[at]);
    result.reason = TextAt(kReason, at);
    const std::uint32_t number = kind_->Numbers<std::uint32_t>()[at];
    const ColumnIndex::Kind& kind = index_.kinds[number];
    const KindColumns& columns = kinds_[number];
    result.metrics.resize(kind.metrics.size());
    for (std::size_t i = 0; i < kind.metrics.size(); ++i) {
      MetricValue& metric = result.metrics[i];
      metric.id = kind.metrics[i];
      metric.value.reset();
      metric.null_reason.clear();
      if (!kind.why[i]) {
        metric.value = columns.values[i]->Numbers<double>()[at];
      } else {
        metric.null_reason =
            *kind.why[i] == kOwnReason ? result.reason : index_.texts[static_cast<std::size_t>(*kind.why[i])];
      }
    }
    result.digests.resize(kind.stages.size());
    for (std::size_t i = 0; i < kind.stages.size(); ++i) {
      auto& [stage, digest] = result.digests[i];
      stage = kind.stages[i];
      digest.clear();
      fmt::format_to(std::back_inserter(digest), "{:016x}", columns.digests[i]->Numbers<std::uint64_t>()[at]);
    }
    result.series.clear();
    result.recording.reset();
  }

  std::vector<Series> SeriesOf(std::size_t at) const {
    const std::uint32_t number = kind_->Numbers<std::uint32_t>()[at];
    const KindColumns& columns = kinds_[number];
    std::vector<Series> series;
    for (std::size_t i = 0; i < columns.curves.size(); ++i) {
      const auto& [name, axis] = index_.kinds[number].series[i];
      const auto ends = columns.ends[i]->Numbers<std::uint64_t>();
      const auto values = columns.curves[i]->Numbers<double>();
      const std::size_t begin = at == 0 ? 0 : ends[at - 1];
      series.push_back({name,
                        axis,
                        {values.begin() + static_cast<std::ptrdiff_t>(begin),
                         values.begin() + static_cast<std::ptrdiff_t>(ends[at])}});
    }
    return series;
  }

  std::optional<double> CpuSecondsOf(std::size_t at) const {
    return cpu_s_ ? std::optional<double>(cpu_s_->Numbers<float>()[at]) : std::nullopt;
  }

 private:
  /// Columns that name texts by their places.
  enum TextColumn { kReason, kClip, kUnits };
  static constexpr std::array<const char*, 3> kTextColumns = {"reason", "clip", "units"};
  /// In the order of a kind's metrics, stages and series; null where a kind has no value.
  struct KindColumns {
    std::vector<const NpyFile*> values, digests, curves, ends;
  };
  using Files = std::map<std::string, NpyFile>;

  template <typename Number>
  Result<NpyFile> OpenColumn(const fs::path& folder, const std::string& name) const {
    ASSIGN_OR_RETURN(auto file, NpyFile::Open(ColumnFile(folder, name), kNpyType<Number>));
    const std::size_t found = file.template Numbers<Number>().size();
    if (found == index_.row_count()) return file;
    return Fail({ColumnFile(folder, name).string()}, "holds {} numbers; its run has {} rows", found,
                index_.row_count());
  }

  template <typename Number>
  Result<void> OpenOnce(const fs::path& folder, const std::string& name, const std::unique_ptr<Files>& files) const {
    if (files->contains(name)) return {};
    ASSIGN_OR_RETURN(auto file, OpenColumn<Number>(folder, name));
    files->emplace(name, std::move(file));
    return {};
  }

  /// No number of any column leads out of what is there.
  Result<void> CheckNumbers(const fs::path& folder) const {
    const Place place{folder.string()};
    for (const std::uint32_t kind : kind_->Numbers<std::uint32_t>()) {
      if (kind >= kinds_.size()) return Fail(place, "kind.npy holds {}; there are {} kinds", kind, kinds_.size());
    }
    for (const std::uint8_t status : status_->Numbers<std::uint8_t>()) {
      if (status > static_cast<std::uint8_t>(Status::kSkipped)) return Fail(place, "status.npy holds {}", status);
    }
    for (const auto& column : texts_) {
      if (!column) continue;
      for (const std::uint32_t text : column->Numbers<std::uint32_t>()) {
        if (text >= index_.texts.size()) return Fail(place, "names text {} of {}", text, index_.texts.size());
      }
    }
    for (const auto& [name, ends] : *ends_) {
      std::uint64_t last = 0;
      const std::size_t values = curves_->at(name.substr(0, name.size() - kEnds.size())).Numbers<double>().size();
      for (const std::uint64_t end : ends.Numbers<std::uint64_t>()) {
        if (end < last || end > values) return Fail(place, "the curves of {} do not follow each other", name);
        last = end;
      }
    }
    return {};
  }

  const std::string& TextAt(TextColumn column, std::size_t at) const {
    return index_.texts[texts_[column] ? texts_[column]->Numbers<std::uint32_t>()[at] : 0];
  }

  ColumnIndex index_;
  std::optional<NpyFile> status_, kind_, cpu_s_;
  std::array<std::optional<NpyFile>, kTextColumns.size()> texts_;
  // Pointers into these stay when the object is moved.
  std::unique_ptr<Files> values_ = std::make_unique<Files>(), digests_ = std::make_unique<Files>(),
                         curves_ = std::make_unique<Files>(), ends_ = std::make_unique<Files>();
  std::vector<KindColumns> kinds_;
};

class ColumnRows : public RowSource {
 public:
  explicit ColumnRows(std::vector<ScenarioColumns> scenarios) : scenarios_(std::move(scenarios)) {
    for (const ScenarioColumns& scenario : scenarios_) firsts_.push_back(firsts_.back() + scenario.index().row_count());
  }

  std::size_t size() const override { return firsts_.back(); }
  std::vector<std::size_t> PlacesAtEqualSteps(std::size_t rows) const override {
    std::vector<std::size_t> places;
    const std::size_t step = (size() + rows - 1) / rows;
    for (std::size_t scenario = 0; scenario < scenarios_.size(); ++scenario) {
      const std::size_t methods = scenarios_[scenario].index().methods.size();
      const std::size_t worlds = scenarios_[scenario].index().row_count() / methods;
      for (std::size_t world = 0; world < worlds; world += step) {
        for (std::size_t m = 0; m < methods; ++m) places.push_back(firsts_[scenario] + methods * world + m);
      }
    }
    return places;
  }
  void Read(std::size_t place, Row& row) const override { Of(place).Read(Within(place), row); }
  std::vector<Series> SeriesOf(std::size_t place) const override { return Of(place).SeriesOf(Within(place)); }
  std::optional<double> CpuSecondsOf(std::size_t place) const override { return Of(place).CpuSecondsOf(Within(place)); }

 private:
  std::size_t ScenarioAt(std::size_t place) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(firsts_, place) - firsts_.begin()) - 1;
  }
  const ScenarioColumns& Of(std::size_t place) const { return scenarios_[ScenarioAt(place)]; }
  std::size_t Within(std::size_t place) const { return place - firsts_[ScenarioAt(place)]; }

  std::vector<ScenarioColumns> scenarios_;
  std::vector<std::size_t> firsts_ = {0};  ///< of each scenario, and the count of all rows at the end
};

}  // namespace

Result<std::shared_ptr<const RowSource>> OpenColumns(const fs::path& folder,
                                                     const std::vector<std::string>& scenarios) {
  std::vector<ScenarioColumns> opened;
  for (const std::string& scenario : scenarios) {
    ASSIGN_OR_RETURN(auto columns, ScenarioColumns::Open(folder, scenario));
    opened.push_back(std::move(columns));
  }
  return std::make_shared<const ColumnRows>(std::move(opened));
}

}  // namespace etude
