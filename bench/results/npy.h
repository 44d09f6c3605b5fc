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

/// The kinds of number that columns hold, as NumPy names them.
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

/// A .npy file (NumPy's own format, version 1.0), written number by number: `numpy.load` and most else read it.
class NpyWriter {
 public:
  static Result<NpyWriter> Begin(const FilePath& path, std::string_view type);

  template <typename Number>
  Result<void> Add(Number number) {
    ++count_;
    return file_.Write({reinterpret_cast<const char*>(&number), sizeof number});
  }
  std::size_t count() const { return count_; }
  /// Ends the file, as an array of one dimension or of this shape, whose product is the count.
  Result<void> Finish(std::vector<std::size_t> shape = {});

 private:
  NpyWriter(AtomicFile file, std::string_view type) : file_(std::move(file)), type_(type) {}

  AtomicFile file_;
  std::string type_;
  std::size_t count_ = 0;
};

/// An .npy file mapped into memory: the system reads of it what is looked at. A file that somebody cuts short meanwhile
/// ends the process, with a complaint and the status of what the machine has stopped.
class NpyFile {
 public:
  /// Fails, naming the path, when it is none that NpyWriter wrote, or holds another number of numbers.
  static Result<NpyFile> Open(const FilePath& path, std::string_view type);
  NpyFile(NpyFile&& other) noexcept;
  NpyFile& operator=(NpyFile&& other) noexcept;
  ~NpyFile();

  /// True if the file says that it holds numbers of this type in an array of this shape.
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
