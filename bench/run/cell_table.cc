#include "bench/run/cell_table.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

namespace etude {
namespace {

constexpr std::uint32_t kInMemory = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kMemory = std::size_t{64} << 20;  // for the parts of all files together
constexpr std::size_t kLargestPart = 1 << 20, kSmallestPart = 1 << 14;

}  // namespace

std::vector<bool> CellTable::Done() const {
  std::vector<bool> done;
  for (std::size_t cell = 0; cell < size(); ++cell) done.push_back(Has(cell));
  return done;
}

std::uint32_t CellTable::AddFile(const std::filesystem::path& file) {
  sources_.push_back({.file = file});
  return static_cast<std::uint32_t>(sources_.size() - 1);
}

void CellTable::Put(std::size_t cell, std::uint32_t file, std::uint64_t offset, std::size_t length) {
  places_[cell] = {offset, static_cast<std::uint32_t>(length), file};
}

void CellTable::Put(std::size_t cell, std::string line) {
  Put(cell, kInMemory, lines_.size(), line.size());
  lines_.push_back(std::move(line));
}

Result<FinishedCell> CellTable::Read(std::size_t cell, const Plan& plan) {
  const LinePlace& place = places_[cell];
  if (place.file == kInMemory) {
    return DecodeCellLine(lines_[place.offset], plan.IdentityOf(cell), {});
  }
  Source& source = sources_[place.file];
  const auto has_line = [&] {
    return place.offset >= source.begin && place.offset + place.length <= source.begin + source.part.size();
  };
  if (!has_line()) RETURN_IF_ERROR(ReadPart(source, place));
  const Place where{source.file.string()};
  if (!has_line()) return Fail(where, "was cut while it was read");
  const auto line = std::string_view(source.part).substr(place.offset - source.begin, place.length);
  return DecodeCellLine(line, plan.IdentityOf(cell), where);
}

Result<void> CellTable::ReadPart(Source& source, const LinePlace& place) const {
  const std::size_t size = std::clamp(kMemory / sources_.size(), kSmallestPart, kLargestPart);
  // Lines stand in order of completion: the next cell's may stand a little before this one's.
  source.begin = place.offset - std::min<std::uint64_t>(place.offset, size / 2);
  source.part.resize(std::max<std::size_t>(size, place.offset - source.begin + place.length));
  const int file = ::open(source.file.c_str(), O_RDONLY | O_CLOEXEC);
  std::size_t read = 0;
  while (file >= 0 && read < source.part.size()) {
    const ssize_t count =
        ::pread(file, source.part.data() + read, source.part.size() - read, static_cast<off_t>(source.begin + read));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    read += static_cast<std::size_t>(count);
  }
  if (file < 0) return Fail({source.file.string()}, "cannot be read: {}", std::strerror(errno));
  ::close(file);
  source.part.resize(read);
  return {};
}

}  // namespace etude
