#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/npy_head.h"
#include "io/files/files.h"

namespace etude {

/// NumPy's names for the number types that columns contain.
template <typename Number>
constexpr std::string_view kNpyType = {};
template <>
inline constexpr std::string_view kNpyType<double> = "<f8";
template <>
inline constexpr std::string_view kNpyType<float> = "<f4";
template <>
inline constexpr std::string_view kNpyType<std::uint64_t> = "<u8";
template <>
inline constexpr std::string_view kNpyType<std::uint32_t> = "<u4";
template <>
inline constexpr std::string_view kNpyType<std::uint8_t> = "|u1";

/// Writes a .npy file (NumPy format, version 1.0) number by number.
class NpyWriter {
 public:
  static Result<NpyWriter> Begin(const FilePath& path, std::string_view type);

  template <typename Number>
  Result<void> Add(Number number) {
    ++count_;
    return file_.Write({reinterpret_cast<const char*>(&number), sizeof number});
  }
  std::size_t count() const { return count_; }
  /// Ends the file as an array of this shape. The lengths in the shape must multiply to count(); an empty shape = one
  /// dimension.
  Result<void> Finish(std::vector<std::size_t> shape = {});

 private:
  NpyWriter(AtomicFile file, std::string_view type) : file_(std::move(file)), type_(type) {}

  AtomicFile file_;
  std::string type_;
  std::size_t count_ = 0;
};

/// Installs a handler of SIGBUS for the process. If another program truncates a mapped file, reading the missing part
/// then ends the process with a sentence on standard error and exit code 3, instead of a crash.
void ExitOnTruncatedMapping();

/// An .npy file mapped into memory: the system reads only the parts that are used. If another program may truncate the
/// file, call `ExitOnTruncatedMapping` first.
class NpyFile {
 public:
  /// Opens a file that NpyWriter wrote with numbers of this type. Fails, naming the path, on any other file.
  static Result<NpyFile> Open(const FilePath& path, std::string_view type);
  NpyFile(NpyFile&& other) noexcept;
  NpyFile& operator=(NpyFile&& other) noexcept;
  ~NpyFile();

  /// Returns true if the header of the file declares this type and shape.
  bool HasShape(std::string_view type, std::span<const std::size_t> shape) const;

  template <typename Number>
  std::span<const Number> Numbers() const {
    return {reinterpret_cast<const Number*>(data_ + kNpyHead), (size_ - kNpyHead) / sizeof(Number)};
  }

 private:
  NpyFile(const char* data, std::size_t size) : data_(data), size_(size) {}

  const char* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace etude
