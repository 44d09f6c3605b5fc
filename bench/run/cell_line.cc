#include "bench/run/cell_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/recording.h"
#include "bench/results/row_json.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

constexpr std::string_view kSumBegin = R"(,"sum":")", kSumEnd = R"("})";
constexpr std::size_t kSumSize = kSumBegin.size() + 16 + kSumEnd.size();

std::optional<std::size_t> IndexInCatalogue(const std::string& id) {
  if (AddedMetrics().contains(id)) return std::nullopt;  // a scenario's own metric has no index in the catalogue
  return static_cast<std::size_t>(FindMetric(id) - AllMetrics().data());
}

void Append(Json& line, const char* member, std::initializer_list<Json> items) {
  for (const Json& item : items) line[member].push_back(item);
}

/// Encodes a finished cell without its checksum. Fails with the reason if JSON cannot represent a value.
Result<std::string> TextOf(std::size_t cell, const FinishedCell& finished) {
  const CellResult& result = finished.row.result;
  const CellUsage& usage = finished.usage;
  // Encode the cell's number, the status and the usage of time and memory.
  Json line{{finished.is_measured ? "cell" : "answered", cell}, {"status", StatusName(result.status)}};
  if (!result.reason.empty()) line["reason"] = result.reason;
  line["usage"] = {usage.wall_s, usage.cpu_s, usage.peak_mb};
  if (usage.world_wall_s > 0) Append(line, "usage", {usage.world_wall_s, usage.world_cpu_s});
  // Encode the values of the metrics, then the reasons for the missing values, in the same order.
  for (const MetricValue& metric : result.metrics) {
    if (FindMetric(metric.id) == nullptr) return Fail({}, "the metric '{}' is not in the catalogue", metric.id);
    if (metric.value && !std::isfinite(*metric.value)) {
      return Fail({}, "the metric '{}' is not a finite number", metric.id);
    }
    const auto index = IndexInCatalogue(metric.id);
    Append(line, "values", {index ? Json(*index) : Json(metric.id), metric.value ? Json(*metric.value) : Json()});
  }
  for (const MetricValue& metric : result.metrics) {
    if (!metric.value) Append(line, "why", {metric.null_reason});
  }
  for (const auto& [stage, digest] : result.digests) Append(line, "digests", {stage, digest});
  if (Json judged = EncodeJudged(result.judged); !judged.empty()) line["judged"] = std::move(judged);
  // Encode the curves and the recording.
  for (const Series& series : result.series) {
    if (!std::ranges::all_of(series.values, [](double value) { return std::isfinite(value); })) {
      return Fail({}, "the series '{}' holds a value that is not finite", series.name);
    }
    Json curve = {series.name, series.axis, series.values};
    for (const std::string& name : series.names) curve.push_back(name);
    line["series"].push_back(std::move(curve));
  }
  if (result.recording) {
    ASSIGN_OR_RETURN(line["recording"], EncodeRecording(*result.recording));
  }
  auto text = WriteJson(line);
  if (!text) return Fail({}, "the recording holds a value that is not finite");
  return text;
}

std::optional<CellLineHead> HeadOf(const Json& line) {
  if (!line.is_object()) return std::nullopt;
  const bool is_measured = line.contains("cell");
  const Json cell = line.value(is_measured ? "cell" : "answered", Json()), status = line.value("status", Json());
  const auto known = status.is_string() ? FindStatus(status.get<std::string>()) : std::nullopt;
  if (!cell.is_number_unsigned() || !known) return std::nullopt;
  return CellLineHead{cell.get<std::size_t>(), *known, is_measured};
}

/// Returns the id of a metric. A line names the metric by an index in the catalogue, or by the id if it is a scenario's
/// own metric.
std::optional<std::string> MetricNamed(const Json& name) {
  if (name.is_string()) {
    auto id = name.get<std::string>();
    return AddedMetrics().contains(id) ? std::optional(std::move(id)) : std::nullopt;
  }
  if (!name.is_number_unsigned() || name.get<std::size_t>() >= AllMetrics().size()) return std::nullopt;
  return AllMetrics()[name.get<std::size_t>()].id;
}

}  // namespace

std::string WithSum(std::string json) {
  json.pop_back();  // removes the closing brace
  return fmt::format("{}{}{:016x}{}", json, kSumBegin, Fingerprint(json), kSumEnd);
}

bool HasRightSum(std::string_view line) {
  if (line.size() < kSumSize) return false;
  const std::string_view text = line.substr(0, line.size() - kSumSize), sum = line.substr(text.size());
  if (!sum.starts_with(kSumBegin) || !sum.ends_with(kSumEnd)) return false;
  std::array<char, 17> digits;
  fmt::format_to_n(digits.data(), 16, "{:016x}", Fingerprint(text));
  return sum.substr(kSumBegin.size(), 16) == std::string_view(digits.data(), 16);
}

std::string EncodeCellLine(std::size_t cell, FinishedCell finished) {
  auto text = TextOf(cell, finished);
  if (!text) {
    finished.row.result = CellResult::Ended(Status::kBadOutput, text.error().message);
    finished.is_measured = true;
    text = TextOf(cell, finished);
  }
  return WithSum(*std::move(text));
}

std::optional<CellLineHead> ReadCellLineHead(std::string_view line) {
  constexpr std::string_view kStatus = R"(,"status":")";
  if (!HasRightSum(line)) return std::nullopt;
  // No status contains a quotation mark, so the next one ends the status. The rest of the line is not read, because
  // recordings are long.
  const std::size_t status = line.find(kStatus);
  const std::size_t end = status == line.npos ? status : line.find('"', status + kStatus.size());
  if (end == line.npos) return std::nullopt;
  return HeadOf(Json::parse(std::string(line.substr(0, end + 1)) + "}", nullptr, false));
}

Result<FinishedCell> DecodeCellLine(std::string_view line, Row identity, const Place& place) {
  if (!HasRightSum(line)) return Fail(place, "was changed after it was written");
  ASSIGN_OR_RETURN(Json json, ReadJson(std::string(line), place.file, place.line));
  const auto head = HeadOf(json);
  if (!head) return Fail(place, "not a line of a cell");
  FinishedCell cell{std::move(identity), {}};
  CellResult& result = cell.row.result;
  result.status = head->status;
  cell.is_measured = head->is_measured;
  std::size_t known = 3;  // number of members that were read: two in the head of the line, and the checksum
  const auto take = [&](const char* name) {
    const auto found = json.find(name);
    if (found == json.end()) return Json();
    ++known;
    return std::move(*found);
  };
  try {
    const Json reason = take("reason");
    result.reason = reason.is_null() ? "" : reason.get<std::string>();
    const Json usage = take("usage");
    const std::array<double*, 5> fields = {&cell.usage.wall_s, &cell.usage.cpu_s, &cell.usage.peak_mb,
                                           &cell.usage.world_wall_s, &cell.usage.world_cpu_s};
    for (std::size_t i = 0; i < std::min(usage.size(), fields.size()); ++i) *fields[i] = usage.at(i).get<double>();
    // Read the metrics: an index or an id, and a value. The reasons for the missing values come in the same order.
    const Json values = take("values"), why = take("why");
    for (std::size_t i = 0, missing = 0; i < values.size(); i += 2) {
      const auto id = MetricNamed(values[i]);
      if (!id) return Fail(place, "not a line of a cell");
      if (const Json& value = values.at(i + 1); value.is_null()) {
        result.Missing(*id, why.at(missing++).get<std::string>());
      } else {
        result.Measure(*id, value.get<double>());
      }
    }
    const Json digests = take("digests");
    for (std::size_t i = 0; i < digests.size(); i += 2) {
      result.digests.emplace_back(digests.at(i).get<std::string>(), digests.at(i + 1).get<std::string>());
    }
    if (const Json judged = take("judged"); !judged.is_null()) result.judged = DecodeJudged(judged);
    // Read each curve: its name, axis, values, and the names of categories.
    for (const Json& curve : take("series")) {
      Series& series = result.series.emplace_back();
      series.name = curve.at(0).get<std::string>();
      series.axis = curve.at(1).get<std::string>();
      series.values = curve.at(2).get<std::vector<double>>();
      for (std::size_t i = 3; i < curve.size(); ++i) series.names.push_back(curve[i].get<std::string>());
    }
    if (const Json recording = take("recording"); !recording.is_null()) {
      ASSIGN_OR_RETURN(result.recording, DecodeRecording(recording, place));
    }
  } catch (const Json::exception& error) {
    return Fail(place, "not a line of a cell: {}", error.what());
  }
  if (known != json.size()) return Fail(place, "not a line of a cell");
  return cell;
}

}  // namespace etude
