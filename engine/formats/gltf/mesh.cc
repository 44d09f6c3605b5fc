#include "engine/formats/gltf/mesh.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <string>

#include "engine/base/image.h"
#include "engine/formats/gltf/file.h"
#include "engine/formats/gltf/gltf.h"
#include "engine/formats/gltf/skin.h"

namespace etude {
namespace {

/// The base colour textures of a file's materials; each picture is decoded once.
class GltfTextures {
 public:
  /// Decodes pictures of `file`; both arguments must outlive this object.
  GltfTextures(const GltfFile& file, const DecodePicture& decode) : file_(file), decode_(decode) {}

  /// Returns the material's texture multiplied by `colour` (linear RGB); null if the material has no texture in PNG or
  /// JPEG. Returns an error for invalid indices, damaged pictures, or more than 64 million pixels in one file.
  Result<SharedTexture> Read(const tinygltf::Material& material, const glm::dvec3& colour, const std::string& where);

 private:
  Result<SharedTexture> ReadPlain(int texture, const std::string& where);
  Result<std::string_view> BytesOf(const tinygltf::Image& image, const std::string& where) const;
  Result<void> Take(std::size_t pixels, const std::string& where);

  const GltfFile& file_;
  const DecodePicture& decode_;
  std::map<int, SharedTexture> plain_;  ///< decoded pictures by texture index, not yet multiplied by a colour
  std::size_t pixels_left_ = 64'000'000;
};

Texture::Beyond BeyondOf(int wrap) {
  if (wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Texture::Beyond::kMirrors;
  if (wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Beyond::kStays;
  return Texture::Beyond::kRepeats;
}

bool IsUnderstood(std::string_view bytes) { return bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8\xff"); }

SharedTexture Tinted(const Texture& plain, const glm::dvec3& colour) {
  std::array<std::array<std::uint8_t, 256>, 3> of_byte;
  for (int k = 0; k < 3; ++k) {
    for (int byte = 0; byte < 256; ++byte) {
      of_byte[k][byte] = SrgbOfLinear(colour[k] * LinearOfSrgb(static_cast<std::uint8_t>(byte)));
    }
  }
  auto tinted = std::make_shared<Texture>(plain);
  for (Rgb8& pixel : tinted->picture.pixels) {
    pixel = {of_byte[0][pixel.r], of_byte[1][pixel.g], of_byte[2][pixel.b]};
  }
  return tinted;
}

Result<SharedTexture> GltfTextures::Read(const tinygltf::Material& material, const glm::dvec3& colour,
                                         const std::string& where) {
  const int index = material.pbrMetallicRoughness.baseColorTexture.index;
  if (index == kNoIndex || !decode_) return SharedTexture();
  ASSIGN_OR_RETURN(auto plain, ReadPlain(index, where + ".pbrMetallicRoughness.baseColorTexture.index"));
  if (!plain || colour == glm::dvec3(1)) return plain;
  RETURN_IF_ERROR(Take(plain->picture.pixels.size(), where));
  return Tinted(*plain, colour);
}

Result<SharedTexture> GltfTextures::ReadPlain(int index, const std::string& where) {
  // Reuse a texture that was decoded before.
  const tinygltf::Model& model = file_.model();
  RETURN_IF_ERROR(file_.CheckIndex(index, model.textures.size(), where));
  if (const auto known = plain_.find(index); known != plain_.end()) return known->second;
  const tinygltf::Texture& source = model.textures[static_cast<std::size_t>(index)];
  SharedTexture& kept = plain_[index];
  const std::string name = fmt::format("textures[{}]", index);
  if (source.source == kNoIndex) return kept;  // an extension defines the picture's format; such pictures are not read
  RETURN_IF_ERROR(file_.CheckIndex(source.source, model.images.size(), name + ".source"));
  const std::string image_name = fmt::format("images[{}]", source.source);
  ASSIGN_OR_RETURN(const auto bytes, BytesOf(model.images[static_cast<std::size_t>(source.source)], image_name));
  if (!IsUnderstood(bytes)) return kept;

  // Decode the picture and set the texture's wrapping.
  auto picture = decode_(bytes, pixels_left_);
  if (!picture) return file_.Refuse(image_name, "{}", picture.error().message);
  RETURN_IF_ERROR(Take(picture->pixels.size(), image_name));
  auto texture = std::make_shared<Texture>(Texture{.picture = std::move(*picture)});
  if (source.sampler != kNoIndex) {
    RETURN_IF_ERROR(file_.CheckIndex(source.sampler, model.samplers.size(), name + ".sampler"));
    const tinygltf::Sampler& sampler = model.samplers[static_cast<std::size_t>(source.sampler)];
    texture->beyond_u = BeyondOf(sampler.wrapS);
    texture->beyond_v = BeyondOf(sampler.wrapT);
  }
  kept = std::move(texture);
  return kept;
}

Result<std::string_view> GltfTextures::BytesOf(const tinygltf::Image& image, const std::string& where) const {
  if (image.bufferView != kNoIndex) return file_.ReadView(image.bufferView, where + ".bufferView");
  return std::string_view(reinterpret_cast<const char*>(image.image.data()), image.image.size());
}

Result<void> GltfTextures::Take(std::size_t pixels, const std::string& where) {
  if (pixels > pixels_left_) {
    return file_.Refuse(where,
                        "found {} pixels; allowed: {} more, because all textures together may have 64 million pixels",
                        pixels, pixels_left_);
  }
  pixels_left_ -= pixels;
  return {};
}

constexpr std::size_t kMaxTriangles = 2'000'000;
constexpr std::size_t kMaxVertices = 2'000'000;
constexpr std::size_t kMaxBindings = 500'000;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Reads a material of the file; the default one is white.
Material ReadMaterial(const tinygltf::Material& source) {
  Material material{.name = source.name};
  const std::vector<double>& factor = source.pbrMetallicRoughness.baseColorFactor;
  for (int k = 0; k < 3; ++k) {
    const double value = static_cast<std::size_t>(k) < factor.size() ? factor[static_cast<std::size_t>(k)] : 1.0;
    material.colour[k] = std::clamp(value, 0.0, 1.0);
  }
  return material;
}

Triangles Assemble(const std::vector<std::uint32_t>& corners, int mode) {
  Triangles triangles;
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    }
  }
  for (std::size_t i = 0; mode == TINYGLTF_MODE_TRIANGLE_STRIP && i + 2 < corners.size(); ++i) {
    triangles.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
  }
  for (std::size_t i = 0; mode == TINYGLTF_MODE_TRIANGLE_FAN && i + 2 < corners.size(); ++i) {
    triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
  }
  return triangles;
}

/// Gives every triangle its own vertices.
void Unweld(SkinnedMesh& mesh) {
  std::vector<SkinnedMesh::Vertex> vertices;
  vertices.reserve(3 * mesh.triangles.size());
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& corner : triangle) {
      vertices.push_back(mesh.vertices[corner]);
      corner = static_cast<std::uint32_t>(vertices.size()) - 1;
    }
  }
  mesh.vertices = std::move(vertices);
}

/// Normalises the normals; a normal of length 0 becomes the area-weighted mean normal of the vertex's triangles.
void FinishNormals(SkinnedMesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.vertices.size(), glm::dvec3(0));
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 origin = mesh.vertices[a].position;
    const glm::dvec3 area = glm::cross(mesh.vertices[b].position - origin, mesh.vertices[c].position - origin);
    for (const std::uint32_t corner : {a, b, c}) sums[corner] += area;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    glm::dvec3& normal = mesh.vertices[i].normal;
    if (IsUnit(glm::dot(normal, normal))) continue;
    if (glm::length(normal) < 1e-9) normal = sums[i];
    const double length = glm::length(normal);
    normal = length > 0 ? normal / length : glm::dvec3(0, 1, 0);
  }
}

class MeshReader {
 public:
  MeshReader(GltfFile& file, const GltfNodes& nodes, const DecodePicture& decode, Character& character)
      : file_(file), model_(file.model()), nodes_(nodes), decode_(decode), character_(character) {}

  Result<void> Read() {
    GltfTextures textures(file_, decode_);
    for (std::size_t i = 0; i < model_.materials.size(); ++i) {
      Material material = ReadMaterial(model_.materials[i]);
      ASSIGN_OR_RETURN(material.texture,
                       textures.Read(model_.materials[i], material.colour, fmt::format("materials[{}]", i)));
      character_.materials.push_back(std::move(material));
    }
    // Read meshes in the order of the file, regardless of the nodes' order.
    std::vector<int> nodes = nodes_.mesh_nodes;
    std::ranges::stable_sort(nodes, {}, [&](int node) { return Node(node).mesh; });
    for (const int node : nodes) {
      RETURN_IF_ERROR(ReadNode(node));
    }
    return {};
  }

 private:
  const tinygltf::Node& Node(int node) const { return model_.nodes[static_cast<std::size_t>(node)]; }

  Result<void> ReadNode(int node) {
    // Find the mesh and its joints.
    const std::string where = fmt::format("nodes[{}]", node);
    const int index = Node(node).mesh;
    RETURN_IF_ERROR(file_.CheckIndex(index, model_.meshes.size(), where + ".mesh"));
    const bool has_skin = Node(node).skin != kNoIndex;
    ASSIGN_OR_RETURN(auto bindings, ReadGltfBindings(file_, nodes_, node));
    const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(index)];
    if (mesh.primitives.empty()) {
      return file_.Refuse(fmt::format("meshes[{}].primitives", index), "found none; allowed: at least one");
    }
    bindings_ += bindings.size() * mesh.primitives.size();  // every surface gets a copy of the bindings
    if (bindings_ > kMaxBindings) {
      return file_.Refuse(where,
                          "up to this mesh, the numbers of joints of all surfaces add up to {}; allowed: at most {}",
                          bindings_, kMaxBindings);
    }
    // Read each primitive as a mesh.
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const std::string place = fmt::format("meshes[{}].primitives[{}]", index, i);
      SkinnedMesh read;
      read.name = mesh.name.empty() ? NodeName(node) : mesh.name;
      read.bindings = bindings;
      RETURN_IF_ERROR(ReadPrimitive(mesh.primitives[i], has_skin, place, read));
      if (read.triangles.empty()) continue;
      if (!has_skin && IsMirrored(nodes_.skeleton, nodes_.joint_of[node])) FlipTriangles(read);
      character_.meshes.push_back(std::move(read));
    }
    return {};
  }

  std::string NodeName(int node) const {
    const int joint = nodes_.joint_of[node];
    return joint < 0 ? Node(node).name : nodes_.skeleton.joints[joint].name;
  }

  Result<void> ReadPrimitive(const tinygltf::Primitive& primitive, bool has_skin, const std::string& where,
                             SkinnedMesh& mesh) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
      return file_.Refuse(where + ".mode", "found {}; allowed: 0 to 6", primitive.mode);
    }
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES || !primitive.attributes.contains("POSITION")) return {};
    RETURN_IF_ERROR(ReadVertices(primitive, where, mesh));
    RETURN_IF_ERROR(ReadTextureCoordinates(primitive, where, mesh));
    RETURN_IF_ERROR(ReadTriangles(primitive, where, mesh));
    if (has_skin) {
      RETURN_IF_ERROR(ReadGltfWeights(file_, primitive, where, mesh));
    }
    const bool is_flat = !primitive.attributes.contains("NORMAL");
    triangles_ += mesh.triangles.size();
    vertices_ += is_flat ? 3 * mesh.triangles.size() : mesh.vertices.size();
    if (vertices_ > kMaxVertices || triangles_ > kMaxTriangles) {
      return file_.Refuse(where,
                          "the file has {} vertices and {} triangles up to this primitive; allowed: at most {} "
                          "vertices and {} triangles",
                          vertices_, triangles_, kMaxVertices, kMaxTriangles);
    }
    if (is_flat) Unweld(mesh);
    FinishNormals(mesh);
    return ReadMaterialIndex(primitive, where, mesh);
  }

  Result<void> ReadMaterialIndex(const tinygltf::Primitive& primitive, const std::string& where, SkinnedMesh& mesh) {
    mesh.material = primitive.material;
    if (primitive.material != kNoIndex) {
      return file_.CheckIndex(primitive.material, model_.materials.size(), where + ".material");
    }
    if (character_.materials.size() == model_.materials.size()) {
      character_.materials.push_back(ReadMaterial(tinygltf::Material()));
    }
    mesh.material = static_cast<int>(character_.materials.size()) - 1;
    return {};
  }

  Result<void> ReadVertices(const tinygltf::Primitive& primitive, const std::string& where, SkinnedMesh& mesh) {
    ASSIGN_OR_RETURN(auto positions,
                     file_.Read(primitive.attributes.at("POSITION"), 3, GltfComponents::kAny, where + ".POSITION"));
    if (positions.Count() > kMaxVertices) {
      return file_.Refuse(where, "found {} vertices; allowed: at most {}", positions.Count(), kMaxVertices);
    }
    mesh.vertices.resize(positions.Count());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const double* p = positions[i];
      mesh.vertices[i].position = {p[0], p[1], p[2]};
    }
    const auto normal = primitive.attributes.find("NORMAL");
    if (normal == primitive.attributes.end()) return {};
    auto normals =
        ReadGltfAttribute(file_, normal->second, 3, GltfComponents::kFloatOrNormalized, where + ".NORMAL", mesh);
    if (!normals) return tl::unexpected(normals.error());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      const double* n = (*normals)[i];
      mesh.vertices[i].normal = {n[0], n[1], n[2]};
    }
    return {};
  }

  /// Reads the texture coordinates that the material refers to. If the mesh has none, all vertices keep the coordinates
  /// (0, 0) of the picture's corner.
  Result<void> ReadTextureCoordinates(const tinygltf::Primitive& primitive, const std::string& where,
                                      SkinnedMesh& mesh) {
    const auto material = static_cast<std::size_t>(primitive.material);
    if (primitive.material < 0 || material >= model_.materials.size() || !character_.materials[material].texture) {
      return {};
    }
    const int set = model_.materials[material].pbrMetallicRoughness.baseColorTexture.texCoord;
    const std::string name = fmt::format("TEXCOORD_{}", set);
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return {};
    ASSIGN_OR_RETURN(const auto places,
                     ReadGltfAttribute(file_, found->second, 2, GltfComponents::kAny, where + "." + name, mesh));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) mesh.vertices[i].on_texture = {places[i][0], places[i][1]};
    return {};
  }

  Result<void> ReadTriangles(const tinygltf::Primitive& primitive, const std::string& where, SkinnedMesh& mesh) {
    // Read the vertex indices; without them the vertices are used in order.
    std::vector<std::uint32_t> corners;
    if (primitive.indices == kNoIndex) {
      corners.resize(mesh.vertices.size());
      for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    } else {
      ASSIGN_OR_RETURN(auto indices, file_.Read(primitive.indices, 1, GltfComponents::kUnsigned, where + ".indices"));
      for (std::size_t i = 0; i < indices.values.size(); ++i) {
        const double index = indices.values[i];
        if (index >= static_cast<double>(mesh.vertices.size())) {
          return file_.Refuse(where + ".indices", "found vertex {} in element {}; allowed: 0 to {}", index, i,
                              mesh.vertices.size() - 1);
        }
        corners.push_back(static_cast<std::uint32_t>(index));
      }
    }
    // Assemble the triangles.
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    if (corners.size() < 3 || (is_list && corners.size() % 3 != 0)) {
      return file_.Refuse(where, "found {} corners; allowed: {}", corners.size(),
                          is_list ? "multiples of 3" : "at least 3");
    }
    mesh.triangles = Assemble(corners, primitive.mode);
    return {};
  }

  GltfFile& file_;
  const tinygltf::Model& model_;
  const GltfNodes& nodes_;
  const DecodePicture& decode_;
  Character& character_;
  std::size_t bindings_ = 0;
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
};

}  // namespace

Result<void> ReadGltfMeshes(GltfFile& file, const GltfNodes& nodes, const DecodePicture& decode, Character& character) {
  return MeshReader(file, nodes, decode, character).Read();
}

bool IsMirrored(const Skeleton& skeleton, int joint) {
  bool mirrored = false;
  for (; joint >= 0; joint = skeleton.joints[joint].parent) {
    const glm::dvec3& scale = skeleton.joints[joint].rest.scale;
    if (scale.x * scale.y * scale.z < 0) mirrored = !mirrored;
  }
  return mirrored;
}

void FlipTriangles(SkinnedMesh& mesh) {
  for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
}

}  // namespace etude
