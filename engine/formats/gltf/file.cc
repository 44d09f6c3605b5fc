#include "engine/formats/gltf/file.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

namespace etude {
namespace {

/// The elements of an accessor in a buffer, with checked bounds.
struct Elements {
  std::span<const unsigned char> bytes;  ///< the bytes from the first element on
  std::size_t stride = 0;
};

std::size_t ComponentBytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

bool IsUnsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

bool IsAllowed(const tinygltf::Accessor& accessor, GltfComponents allowed) {
  const int type = accessor.componentType;
  if (ComponentBytes(type) == 0) return false;
  if (allowed == GltfComponents::kUnsigned) return IsUnsigned(type) && !accessor.normalized;
  if (type == TINYGLTF_COMPONENT_TYPE_FLOAT) return true;
  if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT || allowed == GltfComponents::kFloat) return false;
  return accessor.normalized || allowed == GltfComponents::kAny;
}

const char* Name(GltfComponents allowed) {
  switch (allowed) {
    case GltfComponents::kFloat:
      return "5126 (float)";
    case GltfComponents::kFloatOrNormalized:
      return "5126 (float), or 5120 to 5123 (normalized bytes and shorts)";
    case GltfComponents::kAny:
      return "5126 (float), 5120 to 5123 (bytes, shorts)";
    case GltfComponents::kUnsigned:
      return "5121, 5123 or 5125 (unsigned integers), not normalized";
  }
  return "";
}

/// Returns the numbers per element; 0 for unsupported types.
std::size_t Width(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    case TINYGLTF_TYPE_MAT4:
      return 16;
    default:
      return 0;
  }
}

template <typename T>
double Component(const unsigned char* bytes, bool normalized) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  if constexpr (std::is_integral_v<T>) {
    if (normalized) return std::max(static_cast<double>(value) / std::numeric_limits<T>::max(), -1.0);
  }
  return static_cast<double>(value);
}

double Component(const unsigned char* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return Component<std::int8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return Component<std::uint8_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return Component<std::int16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return Component<std::uint16_t>(bytes, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return Component<std::uint32_t>(bytes, normalized);
    default:
      return Component<float>(bytes, normalized);
  }
}

Result<std::span<const unsigned char>> ViewBytes(const GltfFile& file, int view_index, const std::string& where) {
  const tinygltf::Model& model = file.model();
  RETURN_IF_ERROR(file.CheckIndex(view_index, model.bufferViews.size(), where));
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(view_index)];
  const std::string view_name = fmt::format("bufferViews[{}]", view_index);
  RETURN_IF_ERROR(file.CheckIndex(view.buffer, model.buffers.size(), view_name + ".buffer"));
  const std::vector<unsigned char>& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    return file.Refuse(view_name, "found {} bytes from byte {} on, but buffer {} contains only {} bytes",
                       view.byteLength, view.byteOffset, view.buffer, data.size());
  }
  return std::span(data).subspan(view.byteOffset, view.byteLength);
}

/// Locates `count` elements of `size` bytes each at `offset` of a buffer view, and checks their bounds.
Result<Elements> Locate(const GltfFile& file, int view_index, std::size_t offset, std::size_t count, std::size_t size,
                        const std::string& where) {
  ASSIGN_OR_RETURN(const auto bytes, ViewBytes(file, view_index, where + ".bufferView"));
  const tinygltf::BufferView& view = file.model().bufferViews[static_cast<std::size_t>(view_index)];
  const std::string view_name = fmt::format("bufferViews[{}]", view_index);
  const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
  if (stride < size) {
    return file.Refuse(view_name + ".byteStride", "found {}; allowed: at least {}", stride, size);
  }
  // The comparisons are arranged so that no product or sum can overflow.
  const bool fits = offset <= view.byteLength && size <= view.byteLength - offset &&
                    count - 1 <= (view.byteLength - offset - size) / stride;
  if (!fits) {
    return file.Refuse(
        where, "found {} elements of {} bytes with a stride of {} bytes from byte {} on, but {} contains only {} bytes",
        count, size, stride, offset, view_name, view.byteLength);
  }
  return Elements{bytes.subspan(offset), stride};
}

Result<void> ReadSparse(const GltfFile& file, const tinygltf::Accessor& accessor, GltfNumbers& numbers,
                        const std::string& where) {
  // Check counts and types.
  const auto& sparse = accessor.sparse;
  const std::size_t total = numbers.Count();
  if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > total) {
    return file.Refuse(where + ".count", "found {}; allowed: 1 to {}", sparse.count, total);
  }
  if (!IsUnsigned(sparse.indices.componentType)) {
    return file.Refuse(where + ".indices.componentType", "found {}; allowed: 5121, 5123, 5125",
                       sparse.indices.componentType);
  }
  // The offsets are of type int, or unsigned since tinygltf 2.9.
  if (static_cast<std::int64_t>(sparse.indices.byteOffset) < 0 ||
      static_cast<std::int64_t>(sparse.values.byteOffset) < 0) {
    return file.Refuse(where, "found a negative byteOffset");
  }
  // Locate indices and values, and replace the elements.
  const std::size_t count = static_cast<std::size_t>(sparse.count);
  const std::size_t component_bytes = ComponentBytes(accessor.componentType);
  ASSIGN_OR_RETURN(auto indices,
                   Locate(file, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset), count,
                          ComponentBytes(sparse.indices.componentType), where + ".indices"));
  ASSIGN_OR_RETURN(auto values,
                   Locate(file, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset), count,
                          component_bytes * numbers.width, where + ".values"));
  for (std::size_t i = 0; i < count; ++i) {
    const double index = Component(&indices.bytes[i * indices.stride], sparse.indices.componentType, false);
    if (index >= static_cast<double>(total)) {
      return file.Refuse(where + ".indices", "found {}; allowed: 0 to {}", index, total - 1);
    }
    for (std::size_t k = 0; k < numbers.width; ++k) {
      numbers.values[static_cast<std::size_t>(index) * numbers.width + k] = Component(
          &values.bytes[i * values.stride + k * component_bytes], accessor.componentType, accessor.normalized);
    }
  }
  return {};
}

/// Returns the number of bytes of the UTF-8 character at the start of `text`; 0 if it is invalid (RFC 3629) or a
/// control character, which could break a line or affect a terminal.
std::size_t CharacterBytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned first = byte(0);
  const bool is_control = first < 0x20 || first == 0x7F || (first == 0xC2 && byte(1) < 0xA0);
  if (is_control) return 0;
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xC2 && first < 0xE0 ? 2 : (first >= 0xE0 && first < 0xF0 ? 3 : 4);
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  }
  const unsigned second = byte(1);
  const bool is_overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool is_beyond = (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F);
  return is_overlong || is_beyond ? 0 : length;
}

}  // namespace

Result<std::string_view> GltfFile::ReadView(int view, const std::string& where) const {
  ASSIGN_OR_RETURN(const auto bytes, ViewBytes(*this, view, where));
  return std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Result<void> GltfFile::CheckIndex(int index, std::size_t count, const std::string& where) const {
  if (index >= 0 && static_cast<std::size_t>(index) < count) return {};
  if (count == 0) return Refuse(where, "found {}; there are none", index);
  return Refuse(where, "found {}; allowed: 0 to {}", index, count - 1);
}

Result<GltfNumbers> GltfFile::Read(int index, std::size_t width, GltfComponents allowed, const std::string& where) {
  // Check shape, component type and count.
  RETURN_IF_ERROR(CheckIndex(index, model_.accessors.size(), where));
  const tinygltf::Accessor& accessor = model_.accessors[static_cast<std::size_t>(index)];
  const std::string name = fmt::format("{} (accessors[{}])", where, index);
  if (Width(accessor.type) != width) {
    return Refuse(name, "found another type; allowed: {}",
                  width == 1 ? "SCALAR" : (width == 16 ? "MAT4" : fmt::format("VEC{}", width)));
  }
  if (!IsAllowed(accessor, allowed)) {
    return Refuse(name, "found component type {}; allowed: {}", accessor.componentType, Name(allowed));
  }
  if (accessor.count < 1 || accessor.count > numbers_left_ / width) {
    return Refuse(name, "found {} elements; allowed: 1 to {}", accessor.count, numbers_left_ / width);
  }
  numbers_left_ -= accessor.count * width;

  // Read the elements; an accessor without a buffer view is all zeros.
  GltfNumbers numbers{.width = width, .values = {}};
  const std::size_t component_bytes = ComponentBytes(accessor.componentType);
  if (accessor.bufferView < 0) {
    numbers.values.assign(accessor.count * width, 0.0);
  } else {
    auto elements =
        Locate(*this, accessor.bufferView, accessor.byteOffset, accessor.count, component_bytes * width, name);
    if (!elements) return tl::unexpected(elements.error());
    numbers.values.reserve(accessor.count * width);
    for (std::size_t i = 0; i < accessor.count; ++i) {
      const unsigned char* element = &elements->bytes[i * elements->stride];
      for (std::size_t k = 0; k < width; ++k) {
        numbers.values.push_back(Component(element + k * component_bytes, accessor.componentType, accessor.normalized));
      }
    }
  }
  if (accessor.sparse.isSparse) {
    RETURN_IF_ERROR(ReadSparse(*this, accessor, numbers, name + ".sparse"));
  }
  const bool is_index = allowed == GltfComponents::kUnsigned;  // callers check the range of indices
  for (std::size_t i = 0; !is_index && i < numbers.values.size(); ++i) {
    if (!(std::abs(numbers.values[i]) <= kMaxGltfNumber)) {
      return Refuse(name, "found {} in element {}; allowed: numbers within ±{:g}", numbers.values[i], i / width,
                    kMaxGltfNumber);
    }
  }
  return numbers;
}

std::string GltfText(std::string_view name) {
  std::string text;
  while (!name.empty()) {
    const std::size_t length = CharacterBytes(name);
    text += length == 0 ? "?" : name.substr(0, length);
    name.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return text;
}

}  // namespace etude
