#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "bench/model/payload.h"
#include "engine/base/result.h"

namespace etude {

/// A folder that contains attachments. The destructor deletes the folder with its contents.
class AttachmentFolder {
 public:
  static constexpr std::size_t kNameLength = 6;  ///< length of the folder's name in `attachment_root`

  AttachmentFolder() = default;
  /// Makes a folder in `attachment_root` and writes the files into it. Makes no folder if there are no files.
  static Result<AttachmentFolder> Write(const std::filesystem::path& attachment_root,
                                        std::span<const Attachment> files);
  AttachmentFolder(AttachmentFolder&& other) noexcept;
  AttachmentFolder& operator=(AttachmentFolder&& other) noexcept;
  ~AttachmentFolder();

  /// Returns the folder's path; "" if there is no folder.
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace etude
