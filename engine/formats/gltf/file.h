#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/result.h"

namespace tinygltf {
class Model;
}

namespace etude {

/// The parser's value of an index that is not given.
constexpr int kNoIndex = -1;
/// The largest number that is read: larger ones are refused, so that sums and products of what was read stay finite.
constexpr double kLargestGltfNumber = 1e9;

/// The numbers of an accessor, element by element.
struct GltfNumbers {
  std::size_t width = 1;  ///< numbers per element
  std::vector<double> values;

  std::size_t Count() const { return values.size() / width; }
  const double* operator[](std::size_t element) const { return values.data() + element * width; }
};

/// The component types that may stand in an accessor.
enum class GltfComponents {
  kFloat,
  kFloatOrNormalized,  ///< integers only when they stand for −1…1
  kAny,                ///< also integers taken as they are (KHR_mesh_quantization)
  kUnsigned,           ///< indices
};

/// A parsed file, read with suspicion: every index and size is checked here.
class GltfFile {
 public:
  /// Reads `model`; both arguments must outlive it.
  GltfFile(const tinygltf::Model& model, const std::string& name) : model_(model), name_(name) {}

  const tinygltf::Model& model() const { return model_; }

  /// Makes the error "file: where: what was found; what is allowed".
  template <typename... Args>
  tl::unexpected<Error> Refuse(const std::string& where, fmt::format_string<Args...> format, Args&&... args) const {
    return Fail({name_}, "{}: {}", where, fmt::format(format, std::forward<Args>(args)...));
  }

  /// Refuses an index that names none of `count` things.
  Result<void> CheckIndex(int index, std::size_t count, const std::string& where) const;

  /// The bytes of a buffer view, which may not reach beyond its buffer.
  Result<std::string_view> ReadView(int view, const std::string& where) const;

  /// Reads an accessor of elements of `width` numbers (1 to 4, or 16 for a matrix) into doubles: normalised integers
  /// become −1…1 or 0…1, sparse elements replace others, no buffer view means zeros. Refused: another shape or
  /// component type, no elements, what lies outside its buffer view or buffer, numbers that are not finite or beyond
  /// ±10⁹, and more than 20 million numbers read from one file.
  Result<GltfNumbers> Read(int accessor, std::size_t width, GltfComponents allowed, const std::string& where);

 private:
  const tinygltf::Model& model_;
  const std::string& name_;
  std::size_t numbers_left_ = 20'000'000;
};

/// A name in one line of UTF-8, which is what JSON holds: other bytes and control characters become '?'. Names from
/// other formats may be anything; those of glTF files reach terminals and tables.
std::string GltfText(std::string_view name);

}  // namespace etude
