#include "bench/files/files.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

#include "bench/files/atomic_file.h"

namespace etude {
namespace {

Place InFile(const std::filesystem::path& path) { return Place{.file = path.string()}; }

Result<void> CheckReadable(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    const bool absent = status.type() == std::filesystem::file_type::not_found;
    return Fail(InFile(path), "{}", absent ? "no such file" : "cannot read this file: " + error.message());
  }
  if (!std::filesystem::is_regular_file(status)) return Fail(InFile(path), "is no file");
  return {};
}

}  // namespace

std::filesystem::path TemporaryName(const std::filesystem::path& path) {
  // The extension stays last: encoders choose the container by it.
  return path.parent_path() / (path.stem().string() + ".partial" + path.extension().string());
}

Result<void> MakeFolder(const std::filesystem::path& folder) {
  if (folder.empty()) return {};  // of a plain file name: the one we stand in
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Fail(InFile(folder), "cannot make this folder: {}", error.message());
  return {};
}

Result<void> RenameFinished(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (!error) return {};
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return Fail(InFile(path), "cannot write this file: {}", error.message());
}

Result<void> WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  ASSIGN_OR_RETURN(auto file, AtomicFile::Begin(path));
  RETURN_IF_ERROR(file.Write(bytes));
  return file.Finish();
}

Result<void> ReadInChunks(const std::filesystem::path& path, const std::function<void(std::string_view)>& use) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  std::vector<char> chunk(1 << 18);
  while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || in.gcount() > 0) {
    use({chunk.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  return {};
}

Result<void> ForEachLine(const std::filesystem::path& path,
                         const std::function<Result<void>(std::string_view, const Place&)>& use) {
  RETURN_IF_ERROR(CheckReadable(path));
  std::ifstream in(path, std::ios::binary);
  if (!in) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  Place place{.file = path.string(), .line = 1};
  for (std::string line; std::getline(in, line); ++place.line) RETURN_IF_ERROR(use(line, place));
  if (in.bad()) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  return {};
}

Result<std::string> ReadWholeFile(const std::filesystem::path& path) {
  RETURN_IF_ERROR(CheckReadable(path));
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > kLargestFile) {
    return Fail(InFile(path), "{} MiB; at most {} MiB are read", size >> 20, kLargestFile >> 20);
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  std::string bytes;
  bytes.reserve(error ? 0 : size);
  std::array<char, 1 << 16> chunk{};
  while (in.read(chunk.data(), chunk.size()) || in.gcount() > 0) {
    bytes.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kLargestFile) return Fail(InFile(path), "grows while it is read");
  }
  if (in.bad()) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  return bytes;
}

}  // namespace etude
