#include "bench/run/cell_line.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/model/recording.h"
#include "bench/results/row_json.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

constexpr std::string_view kCellBegin = R"({"cell":)";
constexpr std::string_view kSumBegin = R"(,"sum":")", kSumEnd = R"("})";
constexpr std::size_t kSumSize = kSumBegin.size() + 16 + kSumEnd.size();

std::optional<std::size_t> IndexInCatalogue(const std::string& id) {
  if (AddedMetrics().contains(id)) return std::nullopt;  // metrics of a scenario have no index
  return static_cast<std::size_t>(FindMetric(id) - AllMetrics().data());
}

/// Returns the reason why a result cannot be written as JSON, or "".
std::string FindBadValue(const CellResult& result) {
  for (const MetricValue& metric : result.metrics) {
    if (FindMetric(metric.id) == nullptr) return "the metric '" + metric.id + "' is not in the catalogue";
    if (metric.value && !std::isfinite(*metric.value)) return "the metric '" + metric.id + "' is not a finite number";
  }
  for (const Series& series : result.series) {
    for (double value : series.values) {
      if (!std::isfinite(value)) return "the series '" + series.name + "' holds a value that is not finite";
    }
  }
  return "";
}

class LineWriter {
 public:
  template <typename... Args>
  void Add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }
  void AddText(std::string_view text) { text_ += text; }
  void AddString(const std::string& text) {
    const bool plain = std::ranges::all_of(text, [](char c) { return c >= ' ' && c < 0x7f && c != '"' && c != '\\'; });
    text_ += plain ? "\"" + text + "\"" : Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  /// Adds `,"key":[…]` with one value per item; adds nothing if the list is empty.
  template <typename List, typename AddOne>
  void AddList(std::string_view key, const List& list, const AddOne& add_one) {
    if (list.empty()) return;
    Add(",\"{}\":[", key);
    for (const auto& item : list) {
      add_one(item);
      text_ += ',';
    }
    text_.back() = ']';
  }
  std::string Take() { return std::move(text_); }

 private:
  std::string text_;
};

/// Reads the parts of a line in order. After the first unexpected part, all further reads fail.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

  bool is_good() const { return good_; }
  bool IsNext(std::string_view text) const { return good_ && Rest().starts_with(text); }
  /// Skips `text` if it comes next. Returns true if it was skipped.
  bool Skip(std::string_view text) {
    if (!IsNext(text)) return false;
    at_ += text.size();
    return true;
  }
  void Expect(std::string_view text) { good_ = Skip(text); }
  void Refuse() { good_ = false; }
  template <typename Number>
  Number ReadNumber() {
    Number number{};
    if (!good_) return number;
    const auto [stop, status] = std::from_chars(at_, end_, number);
    good_ = status == std::errc();
    at_ = stop;
    return number;
  }
  std::string ReadString() {
    Expect("\"");
    const char* const begin = at_;
    bool plain = true;
    for (; good_ && at_ != end_ && *at_ != '"'; ++at_) {
      if (*at_ != '\\') continue;
      plain = false;
      if (++at_ == end_) break;
    }
    const std::string_view inside(begin, static_cast<std::size_t>(at_ - begin));
    Expect("\"");
    if (!good_) return "";
    if (plain) return std::string(inside);
    const Json text = Json::parse("\"" + std::string(inside) + "\"", nullptr, false);
    if (!text.is_string()) Refuse();
    return good_ ? text.get<std::string>() : "";
  }
  /// Reads a list that LineWriter::AddList wrote.
  template <typename ReadOne>
  void ReadList(std::string_view key, const ReadOne& read_one) {
    if (!Skip(key)) return;
    do read_one();
    while (Skip(","));
    Expect("]");
  }
  /// Returns the part of the line that has not been read yet, without the checksum.
  std::string_view Rest() const { return {at_, static_cast<std::size_t>(end_ - at_)}; }

 private:
  const char* at_;
  const char* end_;
  bool good_ = true;
};

CellLineHead ReadHead(LineReader& reader) {
  CellLineHead head;
  head.is_measured = !reader.Skip(kAnsweredBegin);
  if (head.is_measured) reader.Expect(kCellBegin);
  head.cell = reader.ReadNumber<std::size_t>();
  reader.Expect(R"(,"status":)");
  const auto status = FindStatus(reader.ReadString());
  if (!status) reader.Refuse();
  head.status = status.value_or(Status::kFailed);
  return head;
}

CellUsage ReadUsage(LineReader& reader) {
  CellUsage usage;
  const std::array<double*, 5> fields = {&usage.wall_s, &usage.cpu_s, &usage.peak_mb, &usage.world_wall_s,
                                         &usage.world_cpu_s};
  std::size_t read = 0;
  reader.ReadList(R"(,"usage":[)", [&] {
    const double value = reader.ReadNumber<double>();
    if (read < fields.size()) *fields[read] = value;
    ++read;
  });
  return usage;
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
  CellResult& result = finished.row.result;
  // A result that JSON cannot represent becomes bad_output.
  std::string recording, bad = FindBadValue(result);
  if (bad.empty() && result.recording) {
    const auto encoded = EncodeRecording(*result.recording);
    const auto text = encoded ? WriteJson(*encoded) : tl::unexpected(encoded.error());
    if (text) {
      recording = *text;
    } else {
      bad = "the recording holds a value that is not finite";
    }
  }
  if (!bad.empty()) result = CellResult::Ended(Status::kBadOutput, bad);

  // Write the identity, status and usage.
  LineWriter line;
  line.AddText(finished.is_measured || !bad.empty() ? kCellBegin : kAnsweredBegin);
  line.Add(R"({},"status":"{}")", cell, StatusName(result.status));
  if (!result.reason.empty()) {
    line.AddText(R"(,"reason":)");
    line.AddString(result.reason);
  }
  const CellUsage& usage = finished.usage;
  line.Add(R"(,"usage":[{},{},{})", usage.wall_s, usage.cpu_s, usage.peak_mb);
  if (usage.world_wall_s > 0) line.Add(",{},{}", usage.world_wall_s, usage.world_cpu_s);
  line.AddText("]");
  // Write the values of the metrics, and then the reasons of the missing values, in the same order.
  std::vector<const std::string*> why;
  line.AddList("values", result.metrics, [&](const MetricValue& metric) {
    const auto index = IndexInCatalogue(metric.id);
    index ? line.Add("{},", *index) : line.Add("\"{}\",", metric.id);
    if (metric.value) return line.Add("{}", *metric.value);
    line.AddText("null");
    why.push_back(&metric.null_reason);
  });
  line.AddList("why", why, [&](const std::string* reason) { line.AddString(*reason); });
  line.AddList("digests", result.digests, [&](const auto& digest) {
    line.AddString(digest.first);
    line.AddText(",");
    line.AddString(digest.second);
  });
  // Write the curves and the recording.
  line.AddList("series", result.series, [&](const Series& series) {
    line.AddText("[");
    line.AddString(series.name);
    line.AddText(",");
    line.AddString(series.axis);
    line.AddText(",[");
    line.Add("{}]", fmt::join(series.values, ","));
    for (const std::string& name : series.names) {
      line.AddText(",");
      line.AddString(name);
    }
    line.AddText("]");
  });
  if (!recording.empty()) line.Add(R"(,"recording":{})", recording);
  line.AddText("}");
  return WithSum(line.Take());
}

std::optional<CellLineHead> ReadCellLineHead(std::string_view line) {
  if (!HasRightSum(line)) return std::nullopt;
  LineReader reader(line);
  const CellLineHead head = ReadHead(reader);
  return reader.is_good() ? std::optional(head) : std::nullopt;
}

Result<FinishedCell> DecodeCellLine(std::string_view line, Row identity, const Place& place) {
  if (!HasRightSum(line)) return Fail(place, "was changed after it was written");
  FinishedCell cell{std::move(identity), {}};
  CellResult& result = cell.row.result;
  LineReader reader(line.substr(0, line.size() - kSumSize));
  try {
    // Read the head and the usage.
    const CellLineHead head = ReadHead(reader);
    result.status = head.status;
    cell.is_measured = head.is_measured;
    result.reason = reader.Skip(R"(,"reason":)") ? reader.ReadString() : "";
    cell.usage = ReadUsage(reader);
    // Read the metrics. A number is an index in the catalogue, a text is the id of a scenario's own metric.
    std::vector<std::size_t> missing;
    reader.ReadList(R"(,"values":[)", [&] {
      std::string id;
      if (reader.IsNext("\"")) {
        id = reader.ReadString();
        if (!AddedMetrics().contains(id)) reader.Refuse();
      } else {
        const auto index_in_catalogue = reader.ReadNumber<std::size_t>();
        if (index_in_catalogue >= AllMetrics().size()) reader.Refuse();
        if (reader.is_good()) id = AllMetrics()[index_in_catalogue].id;
      }
      reader.Expect(",");
      if (!reader.is_good()) return;
      if (reader.Skip("null")) {
        missing.push_back(result.metrics.size());
        result.Missing(id, "");
      } else {
        result.Measure(id, reader.ReadNumber<double>());
      }
    });
    // Read the reasons of the missing values, in order.
    std::size_t told = 0;
    reader.ReadList(R"(,"why":[)", [&] {
      std::string reason = reader.ReadString();
      if (told < missing.size()) result.metrics[missing[told++]].null_reason = std::move(reason);
    });
    reader.ReadList(R"(,"digests":[)", [&] {
      std::string stage = reader.ReadString();
      reader.Expect(",");
      result.digests.emplace_back(std::move(stage), reader.ReadString());
    });
    // Read each curve: name, axis, values, names of categories.
    reader.ReadList(R"(,"series":[)", [&] {
      Series& series = result.series.emplace_back();
      reader.Expect("[");
      series.name = reader.ReadString();
      reader.Expect(",");
      series.axis = reader.ReadString();
      reader.Expect(",[");
      if (!reader.Skip("]")) {
        do series.values.push_back(reader.ReadNumber<double>());
        while (reader.Skip(","));
        reader.Expect("]");
      }
      while (reader.Skip(",")) series.names.push_back(reader.ReadString());
      reader.Expect("]");
    });
    if (reader.Skip(R"(,"recording":)")) {
      ASSIGN_OR_RETURN(const auto json, ReadJson(std::string(reader.Rest()), place.file, place.line));
      ASSIGN_OR_RETURN(auto recording, DecodeRecording(json, place));
      result.recording = std::move(recording);
    } else if (!reader.Rest().empty()) {
      reader.Refuse();
    }
  } catch (const Json::exception& error) {
    return Fail(place, "not a line of a cell: {}", error.what());
  }
  if (!reader.is_good()) return Fail(place, "not a line of a cell");
  return cell;
}

}  // namespace etude
