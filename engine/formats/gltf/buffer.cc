#include "engine/formats/gltf/buffer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace etude {

static_assert(std::endian::native == std::endian::little, "the format's bytes are little-endian");

template <typename T>
void GltfBytes::Append(T value) {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + sizeof value);
  std::memcpy(bytes_.data() + at, &value, sizeof value);
}

void GltfBytes::Float(double value) { Append(static_cast<float>(value)); }
void GltfBytes::Byte(std::uint32_t value) { Append(static_cast<std::uint8_t>(value)); }
void GltfBytes::Short(std::uint32_t value) { Append(static_cast<std::uint16_t>(value)); }
void GltfBytes::Integer(std::uint32_t value) { Append(value); }

int AddGltfView(tinygltf::Model& model, const GltfBytes& bytes, std::size_t stride, GltfTarget target) {
  if (model.buffers.empty()) model.buffers.emplace_back();
  std::vector<unsigned char>& data = model.buffers.front().data;
  data.resize((data.size() + 3) / 4 * 4);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = bytes.size();
  view.byteStride = stride;
  if (target == GltfTarget::kVertices) view.target = TINYGLTF_TARGET_ARRAY_BUFFER;
  if (target == GltfTarget::kIndices) view.target = TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER;
  data.insert(data.end(), bytes.bytes().begin(), bytes.bytes().end());
  model.bufferViews.push_back(std::move(view));
  return static_cast<int>(model.bufferViews.size()) - 1;
}

int AddGltfAccessor(tinygltf::Model& model, const GltfSlice& slice, std::span<const double> values) {
  tinygltf::Accessor accessor;
  accessor.bufferView = slice.view;
  accessor.byteOffset = slice.offset;
  accessor.componentType = slice.component_type;
  accessor.type = slice.type;
  accessor.count = slice.count;
  const std::size_t width = values.size() / std::max<std::size_t>(slice.count, 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = static_cast<float>(values[i]);
    if (i < width) {
      accessor.minValues.push_back(value);
      accessor.maxValues.push_back(value);
    }
    double& least = accessor.minValues[i % width];
    double& greatest = accessor.maxValues[i % width];
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  model.accessors.push_back(std::move(accessor));
  return static_cast<int>(model.accessors.size()) - 1;
}

}  // namespace etude
