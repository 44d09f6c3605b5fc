#include "bench/outside/attachment_folder.h"

#include "bench/files/files.h"

namespace etude {

Result<AttachmentFolder> AttachmentFolder::Write(std::span<const Attachment> files) {
  AttachmentFolder result;
  if (files.empty()) return result;
  ASSIGN_OR_RETURN(auto folder, TemporaryFolder::Make("files"));
  result.folder_.emplace(std::move(folder));
  for (const Attachment& file : files) {
    RETURN_IF_ERROR(WriteFileAtomically(result.folder_->path() / file.name, file.bytes));
  }
  return result;
}

}  // namespace etude
