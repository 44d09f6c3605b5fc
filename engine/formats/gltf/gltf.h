#pragma once

#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"

namespace etude {

/// The contents of a glTF file: a character, whose skeleton holds all nodes of the default scene (it may have no
/// meshes), and one clip per animation on the same skeleton.
struct GltfContent {
  Character character;
  /// The animations. In names, control characters and invalid UTF-8 become '?'. Unnamed animations and animations
  /// with the same name are numbered.
  std::vector<Clip> clips;
  /// The joints that a VRM file (0.x, 1.0) or VRM animation declares as bones, by VRM's bone names, for example
  /// "leftUpperArm".
  std::map<std::string, int> bones = {};
  std::set<std::string> skinned = {};     ///< the names of the joints of skins
  std::vector<std::string> remarks = {};  ///< messages for the user about what was left out
};

/// Returns the bytes of a file that a .gltf file refers to, relative to the .gltf's folder. `uri` has been checked: it
/// is relative and percent-decoded, without "..", scheme or absolute path. If a picture cannot be returned, its
/// material has no texture.
using FetchFile = std::function<Result<std::string>(const std::string& uri)>;

/// Decodes a PNG or JPEG file with at most `max_pixels` pixels. The error describes what is wrong with the picture, not
/// where the picture is in the file.
using DecodePicture = std::function<Result<ColourImage>(std::string_view bytes, std::size_t max_pixels)>;

/// Reads glTF 2.0 as text (.gltf) or binary (.glb), in metres with Y up, as the format defines. Without `fetch`, the
/// file must contain all its data.
///
/// Nodes become joints in the file's order, with parents first: all nodes of the default scene, and others if they are
/// animated or bones of a skin. Matrices are decomposed into translation, rotation and scale.
///
/// Animations are sampled at a fixed rate from their first key to their last. If all moving properties are LINEAR, or
/// STEP at 24 Hz or more, with evenly spaced keys, the rate is that of the keys (rounded to a whole number within 0.01
/// %, else to thousandths), because sampling then loses nothing; else it is 60 Hz. LINEAR (slerp for rotations), STEP
/// and CUBICSPLINE are evaluated as specified; joints without channels stay at rest; sparse accessors and normalised
/// integers are supported. Morph targets, and animations that only move them, are left out.
///
/// Surfaces are triangle lists, strips and fans; lines and points are ignored. If a vertex has several sets of joints,
/// the four largest weights are used. Surfaces without normals get flat normals. Colours are base colour factors,
/// multiplied by base colour textures if `decode` is given (PNG, JPEG; others are ignored); transparency is not read.
///
/// Returns an error that names the position in the JSON for:
/// - anything that is not glTF 2.x;
/// - required extensions, except those for materials, textures, lights, quantised meshes and Draco's compressed meshes
///   (compressed meshes are left out);
/// - indices out of range, accessors outside their buffers, cycles, or nodes with two parents;
/// - excessive sizes (as for BVH 1,024 joints and 128 levels; 200 MB of frames, 2 million triangles, 256 MB of files,
///   64 million pixels of textures, 500 bytes per name);
/// - damaged pictures, times that descend, numbers that are not finite or beyond ±10⁹, and URIs that leave the file's
///   folder.
Result<GltfContent> ReadGltf(std::string_view bytes, const std::string& file, const FetchFile& fetch,
                             const DecodePicture& decode = {});

/// Writes a character with its clips as one GLB: nodes, skins, materials without textures, and LINEAR animations at the
/// clips' rates. All numeric values of surfaces and clips are rounded to floats. Reading the file returns the same
/// skeleton, surfaces and clips, and writing these again gives the same bytes. A property that has its rest value in
/// all frames is not written; a property with another constant value has one key. Neighbouring meshes with the same
/// name and joints become one mesh with several primitives. Invalid UTF-8 and control characters in names become '?'.
///
/// Numbers must be finite, clips must have the character's skeleton, indices must be valid, and the joints of one mesh
/// must have a common root. A character without meshes is allowed. The output is valid by Khronos' glTF validator.
std::string WriteGlb(const Character& character, std::span<const Clip> clips);

}  // namespace etude
