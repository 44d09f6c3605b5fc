#pragma once

#include <optional>
#include <span>
#include <string>

#include "bench/files/temporary_folder.h"
#include "bench/model/payload.h"

namespace etude {

/// A private folder that holds attachments, and goes away with all that is in it.
class AttachmentFolder {
 public:
  /// No folder when there are no files.
  static Result<AttachmentFolder> Write(std::span<const Attachment> files);

  /// "" when there is none.
  std::string path() const { return folder_ ? folder_->path().string() : ""; }

 private:
  std::optional<TemporaryFolder> folder_;
};

}  // namespace etude
