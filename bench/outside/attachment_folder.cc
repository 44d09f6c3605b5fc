#include "bench/outside/attachment_folder.h"

#include "bench/files/files.h"

namespace etude {

Result<AttachmentFolder> AttachmentFolder::Write(std::span<const Attachment> files) {
  AttachmentFolder result;
  if (files.empty()) return result;
  auto folder = TemporaryFolder::Make("files");
  if (!folder) return tl::unexpected(folder.error());
  result.folder_.emplace(std::move(*folder));
  for (const Attachment& file : files) {
    auto written = WriteFileAtomically(result.folder_->path() / file.name, file.bytes);
    if (!written) return tl::unexpected(written.error());
  }
  return result;
}

}  // namespace etude
