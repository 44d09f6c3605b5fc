#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "bench/model/payload.h"
#include "engine/base/result.h"

namespace etude {

/// A folder that holds attachments, and goes away with all that is in it.
class AttachmentFolder {
 public:
  static constexpr std::size_t kNameLength = 6;  ///< of its name below `attachment_root`

  /// Holds no folder yet.
  AttachmentFolder() = default;
  /// Makes a folder in `attachment_root` that holds the files; none when there are no files.
  static Result<AttachmentFolder> Write(const std::filesystem::path& attachment_root,
                                        std::span<const Attachment> files);
  AttachmentFolder(AttachmentFolder&& other) noexcept;
  AttachmentFolder& operator=(AttachmentFolder&& other) noexcept;
  ~AttachmentFolder();

  /// The folder's path; "" when there is none.
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace etude
