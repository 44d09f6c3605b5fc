#include "bench/results/text_rows.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/results/row_json.h"

namespace etude {
namespace {

/// The position of a line in one of the files with rows, curves or times.
struct LinePlace {
  std::uint32_t file = 0, bytes = 0;
  off_t begin = 0;
};

class TextRows final : public RowSource {
 public:
  /// Finds the lines of the rows, then the lines of the rows' curves and times.
  Result<void> Index(const FilePath& folder, const std::vector<std::string>& scenarios) {
    std::map<std::string, std::size_t, std::less<>> places;  // index of each row, by Row::Id()
    RETURN_IF_ERROR(ForEachJson(folder / kCellsFile, "rows", [&](const Json& json, const Place& at, LinePlace line) {
      return DecodeRow(json, at).map([&](const Row& row) {
        places.emplace(row.Id(), rows_.size());
        rows_.push_back(line);
      });
    }));
    curves_.resize(rows_.size());
    cpu_seconds_.resize(rows_.size());
    const auto of_cell = [&](const Json& json) { return places.find(json.at("cell").get<std::string>()); };
    for (const std::string& scenario : scenarios) {
      const FilePath file = folder / kSeriesFolder / (scenario + ".jsonl");
      if (!Exists(file)) continue;
      RETURN_IF_ERROR(ForEachJson(file, "series", [&](const Json& json, const Place&, LinePlace line) -> Result<void> {
        DecodeSeries(json.at("series"));
        const auto row = of_cell(json);
        if (row != places.end() && !curves_[row->second]) curves_[row->second] = line;
        return {};
      }));
    }
    if (!Exists(folder / kTimingsFile)) return {};
    return ForEachJson(folder / kTimingsFile, "times", [&](const Json& json, const Place&, LinePlace) -> Result<void> {
      const double cpu_s = json.at("cpu_s").get<double>();
      if (const auto row = of_cell(json); row != places.end()) cpu_seconds_[row->second] = cpu_s;
      return {};
    });
  }

  std::size_t size() const override { return rows_.size(); }
  std::vector<std::size_t> SampleRowIndices(std::size_t /*rows*/) const override { return {}; }

  void Read(std::size_t place, Row& row) const override {
    const auto json = ReadJson(LineAt(rows_[place]), kCellsFile);
    auto read = json ? DecodeRow(*json, {}) : Result<Row>(Row{});
    row = read ? *std::move(read) : Row{};
  }

  std::vector<Series> SeriesOf(std::size_t place) const override {
    if (!curves_[place]) return {};
    const auto json = ReadJson(LineAt(*curves_[place]), "");
    try {
      return json ? DecodeSeries(json->at("series")) : std::vector<Series>{};
    } catch (const Json::exception&) {
      return {};
    }
  }

  std::optional<double> CpuSecondsOf(std::size_t place) const override { return cpu_seconds_[place]; }

 private:
  /// Calls `use(json, place, line)` for every line of a file; stops at the first error.
  template <typename Use>
  Result<void> ForEachJson(const FilePath& file, const char* what, Use use) {
    ASSIGN_OR_RETURN(auto opened, OpenFile(file, O_RDONLY));
    LinePlace line{.file = static_cast<std::uint32_t>(files_.size())};
    files_.push_back(std::move(opened));
    return ForEachLine(file, [&](std::string_view text, const Place& place) -> Result<void> {
      line.bytes = static_cast<std::uint32_t>(text.size());
      ASSIGN_OR_RETURN(const auto json, ReadJson(std::string(text), place.file, place.line));
      try {
        RETURN_IF_ERROR(use(json, place, line));
      } catch (const Json::exception& error) {
        return Fail(place, "not a line of {}: {}", what, error.what());
      }
      line.begin += static_cast<off_t>(text.size()) + 1;
      return {};
    });
  }

  std::string LineAt(const LinePlace& line) const {
    std::string text(line.bytes, '\0');
    std::size_t filled = 0;
    while (filled < text.size()) {
      const ssize_t count = ::pread(files_[line.file].number(), text.data() + filled, text.size() - filled,
                                    line.begin + static_cast<off_t>(filled));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) break;
      filled += static_cast<std::size_t>(count);
    }
    return text;
  }

  std::vector<Descriptor> files_;
  std::vector<LinePlace> rows_;
  std::vector<std::optional<LinePlace>> curves_;
  std::vector<std::optional<double>> cpu_seconds_;
};

}  // namespace

Result<std::shared_ptr<const RowSource>> OpenTextRows(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& scenarios) {
  auto rows = std::make_shared<TextRows>();
  RETURN_IF_ERROR(rows->Index(Inside(folder), scenarios));
  return rows;
}

}  // namespace etude
