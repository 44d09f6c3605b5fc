#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <exception>
#include <numbers>

#include "bench/clips/fbx.h"

namespace etude {
namespace {

/// Returns the axis of the file that points up (0 = X, 1 = Y, 2 = Z) and whether it does so downwards.
std::pair<int, int> UpOf(const aiScene& scene) {
  std::int32_t axis = 1, sign = 1;
  if (scene.mMetaData != nullptr) {
    scene.mMetaData->Get("UpAxis", axis);
    scene.mMetaData->Get("UpAxisSign", sign);
  }
  return {axis, sign};
}

/// Takes meshes out of the nodes: the step that removes them from the scene leaves their numbers, on which the writer
/// falls.
void ForgetMeshes(aiNode& node) {
  delete[] node.mMeshes;
  node.mMeshes = nullptr;
  node.mNumMeshes = 0;
  for (unsigned i = 0; i < node.mNumChildren; ++i) ForgetMeshes(*node.mChildren[i]);
}

bool GlbOfFbxByAssimp(std::string_view bytes, std::string& said) {
  try {
    Assimp::Importer importer;
    // A joint is one node, its pivots folded in, which other formats do not know.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, aiComponent_MESHES | aiComponent_MATERIALS |
                                                            aiComponent_TEXTURES | aiComponent_CAMERAS |
                                                            aiComponent_LIGHTS);
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(),
                                                       aiProcess_RemoveComponent | aiProcess_GlobalScale, "fbx");
    if (scene == nullptr || scene->mRootNode == nullptr) {
      said = std::string("a damaged FBX file: ") + importer.GetErrorString();
      return false;
    }
    ForgetMeshes(*scene->mRootNode);
    if (const auto [axis, sign] = UpOf(*scene); axis == 2) {
      aiMatrix4x4 turn;
      aiMatrix4x4::RotationX(static_cast<ai_real>(-sign * std::numbers::pi / 2), turn);
      scene->mRootNode->mTransformation = turn * scene->mRootNode->mTransformation;
    }
    Assimp::Exporter exporter;
    const aiExportDataBlob* blob = exporter.ExportToBlob(scene, "glb2");
    if (blob == nullptr) {
      said = std::string("an FBX file without a motion that can be told: ") + exporter.GetErrorString();
      return false;
    }
    said.assign(static_cast<const char*>(blob->data), blob->size);
    return true;
  } catch (const std::exception& error) {
    said = std::string("an FBX file that cannot be read: ") + error.what();
    return false;
  }
}

}  // namespace
}  // namespace etude

extern "C" __attribute__((visibility("default"))) etude::GlbOfFbxBytes* const etude_clips_assimp =
    &etude::GlbOfFbxByAssimp;
