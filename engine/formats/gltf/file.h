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

/// The parser's value for a missing index.
constexpr int kNoIndex = -1;
/// The largest number that is accepted; larger ones are refused, so that sums and products of input numbers stay
/// finite.
constexpr double kMaxGltfNumber = 1e9;

/// The numbers of an accessor, stored element by element.
struct GltfNumbers {
  std::size_t width = 1;  ///< numbers per element
  std::vector<double> values;

  std::size_t Count() const { return values.size() / width; }
  const double* operator[](std::size_t element) const { return values.data() + element * width; }
};

/// The component types that an accessor may have.
enum class GltfComponents {
  kFloat,
  kFloatOrNormalized,  ///< floats, and integers that are normalised to −1…1
  kAny,                ///< all numbers, also integers that are not normalised (KHR_mesh_quantization)
  kUnsigned,           ///< unsigned integers, for indices
};

/// A parsed but untrusted file: every index and size is checked here.
class GltfFile {
 public:
  /// Reads `model`; both arguments must outlive this object.
  GltfFile(const tinygltf::Model& model, const std::string& name) : model_(model), name_(name) {}

  const tinygltf::Model& model() const { return model_; }

  /// Returns the error "file: where: what was found; what is allowed".
  template <typename... Args>
  tl::unexpected<Error> Refuse(const std::string& where, fmt::format_string<Args...> format, Args&&... args) const {
    return Fail({name_}, "{}: {}", where, fmt::format(format, std::forward<Args>(args)...));
  }

  /// Returns an error unless 0 ≤ `index` < `count`.
  Result<void> CheckIndex(int index, std::size_t count, const std::string& where) const;

  /// Returns the bytes of a buffer view, or an error if the view extends beyond its buffer.
  Result<std::string_view> ReadView(int view, const std::string& where) const;

  /// Reads an accessor with elements of `width` numbers (1 to 4, or 16 for a matrix) as doubles. Normalised integers
  /// become −1…1 or 0…1, sparse values replace the elements at their indices, and an accessor without a buffer view
  /// holds zeros. Returns an error for another shape or component type, no elements, data outside the buffer view or
  /// buffer, numbers that are not finite or beyond ±10⁹, and more than 20 million numbers read from one file.
  Result<GltfNumbers> Read(int accessor, std::size_t width, GltfComponents allowed, const std::string& where);

 private:
  const tinygltf::Model& model_;
  const std::string& name_;
  std::size_t numbers_left_ = 20'000'000;
};

/// Returns a name as one line of UTF-8, as JSON needs it: invalid bytes and control characters become '?'. This is
/// needed because names from other formats may contain any bytes, and names from glTF files are shown in terminals and
/// tables.
std::string GltfText(std::string_view name);

}  // namespace etude
