#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/run/cell_line.h"
#include "bench/run/plan.h"

namespace etude {

/// The finished cells of a run or of a shard, by their number in the plan: of each, where its line stands. What the
/// lines say stays on the disk until it is asked for, so that a run of any size fits into memory.
class CellTable {
 public:
  explicit CellTable(std::size_t cells) : places_(cells) {}

  std::size_t size() const { return places_.size(); }
  bool Has(std::size_t cell) const { return places_[cell].length > 0; }
  std::vector<bool> Done() const;

  /// A file that holds lines of cells; what stands for it in Put.
  std::uint32_t AddFile(const std::filesystem::path& file);
  void Put(std::size_t cell, std::uint32_t file, std::uint64_t offset, std::size_t length);
  /// A line that stands in no file.
  void Put(std::size_t cell, std::string line);

  /// What is known of a cell that is there. Quick when cells are asked for in about the order in which they stand.
  Result<FinishedCell> Read(std::size_t cell, const Plan& plan);

 private:
  struct LinePlace {
    std::uint64_t offset = 0;  ///< in the file, or the place in `lines_`
    std::uint32_t length = 0;  ///< 0 = there is none
    std::uint32_t file = 0;
  };
  /// A file, and the part of it that was read last.
  struct Source {
    std::filesystem::path file;
    std::uint64_t begin = 0;
    std::string part = {};
  };

  Result<void> ReadPart(Source& source, const LinePlace& place) const;

  std::vector<LinePlace> places_;
  std::vector<Source> sources_;
  std::vector<std::string> lines_;
};

}  // namespace etude
