#pragma once

#include <span>
#include <string>

#include "bench/tasks/base/task.h"

namespace etude {

/// A private folder below the system's temporary one that holds attachments; removed with all that is in it by the
/// destructor.
class AttachmentFolder {
 public:
  AttachmentFolder() = default;  ///< none
  AttachmentFolder(AttachmentFolder&& other) noexcept;
  AttachmentFolder& operator=(AttachmentFolder&& other) noexcept;
  ~AttachmentFolder();

  /// No folder when there are no files.
  static Result<AttachmentFolder> Write(std::span<const Attachment> files);

  /// "" when there is none.
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace etude
