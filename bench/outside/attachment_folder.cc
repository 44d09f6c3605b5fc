#include "bench/outside/attachment_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <utility>

#include "engine/base/machine.h"
#include "io/files/files.h"

namespace etude {

namespace fs = std::filesystem;

Result<AttachmentFolder> AttachmentFolder::Write(const fs::path& attachment_root, std::span<const Attachment> files) {
  AttachmentFolder folder;
  if (files.empty()) return folder;
  std::string name = (attachment_root / std::string(kNameLength, 'X')).string();
  if (::mkdtemp(name.data()) == nullptr) return CannotWrite(name, "cannot be made", errno);
  folder.path_ = name;
  for (const Attachment& file : files) {
    RETURN_IF_ERROR(WriteFileAtomically(folder.path_ / file.name, file.bytes, OnDisk::kLater));
  }
  return folder;
}

AttachmentFolder::AttachmentFolder(AttachmentFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

AttachmentFolder& AttachmentFolder::operator=(AttachmentFolder&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

AttachmentFolder::~AttachmentFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace etude
