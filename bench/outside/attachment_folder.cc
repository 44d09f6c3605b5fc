#include "bench/outside/attachment_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "bench/files/files.h"

namespace etude {

AttachmentFolder::AttachmentFolder(AttachmentFolder&& other) noexcept : path_(std::exchange(other.path_, "")) {}

AttachmentFolder& AttachmentFolder::operator=(AttachmentFolder&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

AttachmentFolder::~AttachmentFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

Result<AttachmentFolder> AttachmentFolder::Write(std::span<const Attachment> files) {
  AttachmentFolder folder;
  if (files.empty()) return folder;
  std::error_code error;
  const std::filesystem::path temporary = std::filesystem::temp_directory_path(error);
  std::string path = (temporary / "etude-XXXXXX").string();
  if (error || ::mkdtemp(path.data()) == nullptr) {
    return Fail({path, 0, 0}, "no temporary folder can be made: {}", error ? error.message() : std::strerror(errno));
  }
  folder.path_ = path;
  for (const Attachment& file : files) {
    const std::filesystem::path place = std::filesystem::path(path) / file.name;
    if (auto written = WriteFileAtomically(place, file.bytes); !written) return tl::unexpected(written.error());
  }
  return folder;
}

}  // namespace etude
