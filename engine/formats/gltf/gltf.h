#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"

namespace etude {

/// The contents of a glTF file: a figure (its skeleton is all nodes of the default scene; meshes may be none) and
/// clips, one per animation, on that same skeleton.
struct GltfContent {
  Character character;
  std::vector<Clip> clips;  ///< named as in the file, in one line; unnamed or doubled names are numbered
  /// The joints that a VRM file (0.x, 1.0) or VRM animation calls bones, by their names there: "leftUpperArm".
  std::map<std::string, int> bones = {};
  std::vector<std::string> remarks = {};  ///< what was left out, in plain words
};

/// Gives the bytes of a file that a .gltf names, relative to the .gltf's own folder. `uri` has been checked: relative,
/// percent-decoded, without "..", scheme or absolute path. A picture that it cannot give leaves its material plain.
using FetchFile = std::function<Result<std::string>(const std::string& uri)>;

/// Makes a picture of the bytes of a PNG or JPEG file, of at most so many pixels; an error says what is wrong with it,
/// and nothing of where it stands.
using DecodePicture = std::function<Result<ColourImage>(std::string_view bytes, std::size_t most_pixels)>;

/// Reads glTF 2.0, text (.gltf) or binary (.glb). Metres, Y up, as the format says. Without `fetch` a file must hold
/// all its data itself.
///
/// Nodes become joints in the file's order, but parents first: those of the default scene, and from outside it those
/// that are animated or bones of a skin. Matrices are taken apart into translation, rotation and scale.
///
/// Animations become frames at a fixed rate, from their earliest key to their latest. The rate is that of the keys
/// where what moves is LINEAR on evenly spaced keys (a whole number within 0.01 %, else thousandths), for such frames
/// lose nothing; else 60 Hz. LINEAR (slerp for rotations), STEP and CUBICSPLINE are evaluated as the specification
/// says; joints without channels stay at rest; sparse accessors and normalised integers are understood. Animations of
/// morph targets alone are left out, as are morph targets.
///
/// Surfaces are triangle lists, strips and fans; lines and points are passed over. Of several sets of joints the four
/// greatest weights of a vertex count. Surfaces without normals get flat ones. Colours are base colour factors, times
/// base colour textures where `decode` is given (PNG, JPEG; others leave the plain colour); transparency is not read.
///
/// Refused with one complaint that names the place in the JSON: what is not glTF 2.x, required extensions but those of
/// looks, quantised meshes and Draco's (a file that needs it is read without its meshes), indices out of range, accessors outside their buffers, cycles or nodes with two parents,
/// huge counts (caps as for BVH: 1,024 joints, 128 levels, 200 MB of frames; 2 million triangles; 256 MB of files; 64
/// million pixels of textures; 500 bytes a name), pictures that are damaged,
/// times that do not ascend, numbers that are not finite or beyond ±10⁹, URIs that leave the file's folder.
Result<GltfContent> ReadGltf(std::string_view bytes, const std::string& file, const FetchFile& fetch,
                             const DecodePicture& decode = {});

/// Writes a figure with its clips as one GLB: nodes, skins, materials without textures, and LINEAR animations at the
/// clips' rates.
/// Numbers of surfaces and clips are rounded to floats; reading gives the same skeleton, surfaces and clips, and
/// writing those the same bytes. Properties that stay at rest are not written, still ones as one key. Neighbouring
/// meshes of one name on the same joints become one mesh of several primitives. Bytes of names that are no UTF-8 and
/// control characters become '?'.
///
/// Needs finite numbers, clips of the character's skeleton, valid indices; the joints that one mesh hangs on have a
/// common root. A character without meshes is written too. Valid by Khronos' glTF validator.
std::string WriteGlb(const Character& character, std::span<const Clip> clips);

}  // namespace etude
