#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "bench/results/columns.h"
#include "bench/results/npy.h"
#include "bench/results/row_json.h"
#include "io/files/json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

class ScenarioColumns {
 public:
  static Result<ScenarioColumns> Open(const FilePath& folder, const std::string& scenario) {
    const FilePath own = folder / kColumnsFolder / scenario;
    ScenarioColumns columns;
    ASSIGN_OR_RETURN(columns.index_, ReadColumnIndex(own));
    const ColumnIndex& index = columns.index_;
    // Open the columns that every row has.
    ASSIGN_OR_RETURN(columns.status_, columns.OpenColumn<std::uint8_t>(own, "status"));
    ASSIGN_OR_RETURN(columns.kind_, columns.OpenColumn<std::uint32_t>(own, "kind"));
    for (std::size_t i = 0; i < columns.texts_.size(); ++i) {
      if (!Exists(ColumnFile(own, kTextColumns[i]))) continue;
      ASSIGN_OR_RETURN(columns.texts_[i], columns.OpenColumn<std::uint32_t>(own, kTextColumns[i]));
    }
    // For each kind of rows (ColumnIndex::Kind), open the columns of its metrics, stages and curves. Each column is
    // opened once.
    for (const ColumnIndex::Kind& kind : index.kinds) {
      KindColumns& of_kind = columns.kinds_.emplace_back();
      for (std::size_t i = 0; i < kind.metrics.size(); ++i) {
        if (!kind.why[i]) RETURN_IF_ERROR(columns.OpenOnce<double>(own, kind.metrics[i], columns.values_));
        of_kind.values.push_back(kind.why[i] ? nullptr : &columns.values_->at(kind.metrics[i]));
      }
      for (const std::string& stage : kind.stages) {
        RETURN_IF_ERROR(columns.OpenOnce<std::uint64_t>(own, DigestColumn(stage), columns.digests_));
        of_kind.digests.push_back(&columns.digests_->at(DigestColumn(stage)));
      }
      for (const Series& series : kind.series) {
        const std::string& name = series.name;
        RETURN_IF_ERROR(columns.OpenOnce<std::uint64_t>(own / kSeriesFolder, name + kCurveEnds, columns.ends_));
        of_kind.ends.push_back(&columns.ends_->at(name + kCurveEnds));
        if (!columns.curves_->contains(name)) {
          ASSIGN_OR_RETURN(auto curve, NpyFile::Open(ColumnFile(own / kSeriesFolder, name), kNpyType<double>));
          columns.curves_->emplace(name, std::move(curve));
        }
        of_kind.curves.push_back(&columns.curves_->at(name));
      }
    }
    // Open the columns of times, which are optional.
    const FilePath times = folder / kTimesFolder / scenario;
    if (Exists(ColumnFile(times, "cpu_s"))) {
      ASSIGN_OR_RETURN(columns.cpu_s_, columns.OpenColumn<float>(times, "cpu_s"));
    }
    RETURN_IF_ERROR(columns.CheckNumbers(own));
    RETURN_IF_ERROR(columns.ReadUnits(own));
    RETURN_IF_ERROR(columns.ReadJudged(own));
    return columns;
  }

  const ColumnIndex& index() const { return index_; }

  void Read(std::size_t at, Row& row) const {
    const std::size_t methods = index_.methods.size(), trials = static_cast<std::size_t>(index_.trials);
    // The row's identity follows from its position in the array.
    row.scenario = index_.scenario;
    row.task = index_.task;
    row.condition = index_.conditions[at / (methods * trials)];
    row.trial = static_cast<int>(at / methods % trials);
    row.method = index_.methods[at % methods];
    row.clip = TextAt(kClip, at);
    row.units = units_[TextNumber(kUnits, at)];
    CellResult& result = row.result;
    result.status = static_cast<Status>(status_->Numbers<std::uint8_t>()[at]);
    result.reason = TextAt(kReason, at);
    const std::uint32_t number = kind_->Numbers<std::uint32_t>()[at];
    const ColumnIndex::Kind& kind = index_.kinds[number];
    const KindColumns& columns = kinds_[number];
    // Read metrics and digests. `row` is reused for many rows, so its old content is replaced.
    result.metrics.resize(kind.metrics.size());
    for (std::size_t i = 0; i < kind.metrics.size(); ++i) {
      MetricValue& metric = result.metrics[i];
      metric.id = kind.metrics[i];
      metric.value.reset();
      metric.null_reason.clear();
      if (!kind.why[i]) {
        metric.value = columns.values[i]->Numbers<double>()[at];
      } else {
        metric.null_reason = *kind.why[i] == ColumnIndex::kOwnReason
                                 ? result.reason
                                 : index_.texts[static_cast<std::size_t>(*kind.why[i])];
      }
    }
    result.digests.resize(kind.stages.size());
    for (std::size_t i = 0; i < kind.stages.size(); ++i) {
      auto& [stage, digest] = result.digests[i];
      stage = kind.stages[i];
      digest.clear();
      fmt::format_to(std::back_inserter(digest), "{:016x}", columns.digests[i]->Numbers<std::uint64_t>()[at]);
    }
    result.judged = judged_[TextNumber(kJudged, at)];
    result.series.clear();
    result.recording.reset();
  }

  std::vector<Series> SeriesOf(std::size_t at) const {
    const std::uint32_t number = kind_->Numbers<std::uint32_t>()[at];
    const KindColumns& columns = kinds_[number];
    std::vector<Series> series;
    for (std::size_t i = 0; i < columns.curves.size(); ++i) {
      const auto ends = columns.ends[i]->Numbers<std::uint64_t>();
      const auto values = columns.curves[i]->Numbers<double>();
      const std::size_t begin = at == 0 ? 0 : ends[at - 1];
      series.push_back(index_.kinds[number].series[i]);
      series.back().values.assign(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                  values.begin() + static_cast<std::ptrdiff_t>(ends[at]));
    }
    return series;
  }

  std::optional<double> CpuSecondsOf(std::size_t at) const {
    return cpu_s_ ? std::optional<double>(cpu_s_->Numbers<float>()[at]) : std::nullopt;
  }

 private:
  enum TextColumn { kReason, kClip, kUnits, kJudged };
  static constexpr std::array<const char*, 4> kTextColumns = {"reason", "clip", "units", "judged"};
  /// The columns of one kind of rows: its metrics, stages and series, in the order of ColumnIndex::Kind. The column of
  /// a metric without values is null.
  struct KindColumns {
    std::vector<const NpyFile*> values, digests, curves, ends;
  };
  using Files = std::map<std::string, NpyFile>;

  template <typename Number>
  Result<NpyFile> OpenColumn(const FilePath& folder, const std::string& name) const {
    ASSIGN_OR_RETURN(auto file, NpyFile::Open(ColumnFile(folder, name), kNpyType<Number>));
    const Place place{ColumnFile(folder, name).string()};
    const std::size_t found = file.template Numbers<Number>().size();
    if (found != index_.row_count())
      return Fail(place, "contains {} numbers, but the run has {} rows", found, index_.row_count());
    // This reader does not need the shape, but NumPy does, so a wrong shape is an error.
    if (!file.HasShape(kNpyType<Number>, index_.shape()))
      return Fail(place, "does not have the shape (conditions, trials, methods) of the run");
    return file;
  }

  template <typename Number>
  Result<void> OpenOnce(const FilePath& folder, const std::string& name, const std::unique_ptr<Files>& files) const {
    if (files->contains(name)) return {};
    ASSIGN_OR_RETURN(auto file, OpenColumn<Number>(folder, name));
    files->emplace(name, std::move(file));
    return {};
  }

  /// Fails if a column holds a number that is out of range.
  Result<void> CheckNumbers(const FilePath& folder) const {
    const Place place{folder.string()};
    // Kinds, statuses and texts must be valid indices.
    for (const std::uint32_t kind : kind_->Numbers<std::uint32_t>()) {
      if (kind >= kinds_.size())
        return Fail(place, "kind.npy contains the index {}, but there are only {} kinds", kind, kinds_.size());
    }
    for (const std::uint8_t status : status_->Numbers<std::uint8_t>()) {
      if (status >= kStatuses.size())
        return Fail(place, "status.npy contains the index {}, but there are only {} statuses", status,
                    kStatuses.size());
    }
    for (std::size_t i = 0; i < texts_.size(); ++i) {
      if (!texts_[i]) continue;
      for (const std::uint32_t text : texts_[i]->Numbers<std::uint32_t>()) {
        if (text >= index_.texts.size())
          return Fail(place, "{}.npy contains the index {}, but there are only {} texts", kTextColumns[i], text,
                      index_.texts.size());
      }
    }
    // The ends of the curves must ascend, and the last end must be the number of values.
    for (const auto& [name, ends] : *ends_) {
      std::uint64_t last = 0;
      const NpyFile& curve = curves_->at(name.substr(0, name.size() - std::string_view(kCurveEnds).size()));
      const std::array<std::size_t, 1> values = {curve.Numbers<double>().size()};
      for (const std::uint64_t end : ends.Numbers<std::uint64_t>()) {
        if (end < last || end > values[0])
          return Fail(place, "the curves of {} are not stored one after the other", name);
        last = end;
      }
      if (last != values[0] || !curve.HasShape(kNpyType<double>, values)) {
        return Fail(place, "contains values of {} that belong to no curve", name);
      }
    }
    return {};
  }

  /// Parses the texts that are lists of sampling units.
  Result<void> ReadUnits(const FilePath& folder) {
    units_.resize(index_.texts.size());
    if (!texts_[kUnits]) return {};
    for (const std::uint32_t text : texts_[kUnits]->Numbers<std::uint32_t>()) {
      if (text == 0 || !units_[text].empty()) continue;
      ASSIGN_OR_RETURN(const auto list, ReadJson(index_.texts[text], folder.string()));
      const auto is_text = [](const Json& unit) { return unit.is_string(); };
      if (!list.is_array() || list.empty() || !std::ranges::all_of(list, is_text)) {
        return Fail({folder.string()}, "'{}' is not a list of units", index_.texts[text]);
      }
      units_[text] = list.template get<std::vector<std::string>>();
    }
    return {};
  }

  /// Parses the texts that say what cells were judged on.
  Result<void> ReadJudged(const FilePath& folder) {
    judged_.resize(index_.texts.size());
    if (!texts_[kJudged]) return {};
    for (const std::uint32_t text : texts_[kJudged]->Numbers<std::uint32_t>()) {
      if (text == 0 || !judged_[text].parts.empty()) continue;
      ASSIGN_OR_RETURN(const auto json, ReadJson(index_.texts[text], folder.string()));
      try {
        judged_[text] = DecodeJudged(json);
      } catch (const Json::exception&) {
        return Fail({folder.string()}, "'{}' does not describe what a cell was judged on", index_.texts[text]);
      }
    }
    return {};
  }

  std::size_t TextNumber(TextColumn column, std::size_t at) const {
    return texts_[column] ? texts_[column]->Numbers<std::uint32_t>()[at] : 0;
  }
  const std::string& TextAt(TextColumn column, std::size_t at) const { return index_.texts[TextNumber(column, at)]; }

  ColumnIndex index_;
  std::optional<NpyFile> status_, kind_, cpu_s_;
  std::array<std::optional<NpyFile>, kTextColumns.size()> texts_;
  /// For each text, the sampling units that it lists; empty if the text is not a list of units.
  std::vector<std::vector<std::string>> units_;
  std::vector<JudgedOn> judged_;  ///< for each text, what it says was judged
  // The maps are behind pointers, so that pointers in KindColumns stay valid when this object is moved.
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
  std::vector<std::size_t> SampleRowIndices(std::size_t rows) const override {
    std::vector<std::size_t> indices;
    const std::size_t step = (size() + rows - 1) / rows;
    for (std::size_t scenario = 0; scenario < scenarios_.size(); ++scenario) {
      const std::size_t methods = scenarios_[scenario].index().methods.size();
      const std::size_t worlds = scenarios_[scenario].index().row_count() / methods;
      for (std::size_t world = 0; world < worlds; world += step) {
        for (std::size_t m = 0; m < methods; ++m) indices.push_back(firsts_[scenario] + methods * world + m);
      }
    }
    return indices;
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
  std::vector<std::size_t> firsts_ = {0};  ///< index of each scenario's first row, and then the number of all rows
};

}  // namespace

Result<std::shared_ptr<const RowSource>> OpenColumns(const fs::path& folder,
                                                     const std::vector<std::string>& scenarios) {
  std::vector<ScenarioColumns> opened;
  for (const std::string& scenario : scenarios) {
    ASSIGN_OR_RETURN(auto columns, ScenarioColumns::Open(Inside(folder), scenario));
    opened.push_back(std::move(columns));
  }
  return std::make_shared<const ColumnRows>(std::move(opened));
}

}  // namespace etude
