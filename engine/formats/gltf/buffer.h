#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tinygltf {
class Model;
}

namespace etude {

/// Bytes of a buffer view in the making.
class GltfBytes {
 public:
  void Float(double value);  ///< rounded to a float
  void Byte(std::uint32_t value);
  void Short(std::uint32_t value);
  void Integer(std::uint32_t value);

  std::size_t size() const { return bytes_.size(); }
  const std::vector<unsigned char>& bytes() const { return bytes_; }

 private:
  template <typename T>
  void Append(T value);

  std::vector<unsigned char> bytes_;
};

/// What the bytes of a view are for.
enum class GltfTarget { kOther, kVertices, kIndices };

/// Where an accessor begins, and what it counts.
struct GltfSlice {
  int view = 0;
  std::size_t offset = 0;
  int component_type = 0;  ///< TINYGLTF_COMPONENT_TYPE_…
  int type = 0;            ///< TINYGLTF_TYPE_…
  std::size_t count = 0;
};

/// Puts bytes behind all others of the model's one buffer, 4-aligned, as a new view; returns its index. `stride` 0:
/// elements stand side by side.
int AddGltfView(tinygltf::Model& model, const GltfBytes& bytes, std::size_t stride, GltfTarget target);

/// Adds an accessor; returns its index. With `values`, the numbers it holds element by element, it tells their least
/// and greatest, as positions and times of keys must.
int AddGltfAccessor(tinygltf::Model& model, const GltfSlice& slice, std::span<const double> values = {});

}  // namespace etude
