#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/trc.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/to_body.h"
#include "io/clips/recorded_motions.h"

namespace etude {

enum class ClipFormat {
  kBvh,
  kGltf,
  kGlb,
  kFbx,
  kDeepMimic,
  kAcclaim,
  kAmass,
  kC3d,
  kTrc,
  kCsv,
  kNpz,
  kNpy,
  kMotive,
  kMot,
  kRecording,
  kBuiltin
};
/// Returns the name of a format: "BVH", "glTF", "GLB", "FBX", "DeepMimic", "Acclaim", "AMASS", "C3D", "TRC", "CSV",
/// "NPZ", "NPY", "Motive", "MOT", "recording" or "built-in".
std::string_view FormatName(ClipFormat format);

/// How a clip that is a body already was made.
struct MadeBody {
  std::vector<std::string> changes;  ///< what it was made of, and every change of what the file holds, for people
  UpFinding up = {};                 ///< the axis of the file that became Y
  double floor_m = 0;                ///< the height that became 0
};

/// The content of a motion file.
struct ClipFile {
  ClipFormat format = ClipFormat::kBvh;
  Character figure;         ///< a skeleton, and meshes if the file has any
  std::vector<Clip> clips;  ///< on that skeleton; glTF may hold none, and a marker file one clip for each of several
                            ///< people
  std::vector<MadeBody> bodies = {};      ///< one for each clip, if they are bodies already
  std::vector<std::string> remarks = {};  ///< repairs that were made while reading
  std::optional<JointMapOverrides> roles = {};  ///< roles that the bone table of a VRM file assigns
  std::vector<MarkerMotion> shown = {};  ///< for clips that were made of markers: MarkerBody::shown of each
  bool has_rate = true;  ///< false: the file tells no rate, and the judged one was assumed
};

/// The options with which a clip is opened.
struct OpenOptions {
  std::optional<JointMapOverrides> roles;  ///< the user's joint map (--joint-map)
  BodyOptions body;
  std::string marker_set = "";  ///< of marker files: the set to use (MarkerSetKeys); "" = the best
  const RecordedMotions* recorded = nullptr;  ///< reads "RUN#CELL@NAME"; null = such a reference is treated as a file
};

/// The maximum size of a file, or of a .gltf with its buffers, bytes. A larger file is refused before memory is taken.
constexpr std::uintmax_t kMaxClipFileBytes = 500'000'000;

/// Reads a motion file; the content decides the format, not the name. Known are BVH, glTF, GLB, FBX, DeepMimic's
/// motions, Acclaim's AMC, AMASS's .npz, our own .npz and .mot, arrays of joints (.npy, arranged as `layout` says:
/// JointsOfArray), and markers in C3D, TRC, Motive's CSV or joint CSV (FindMarkerBodies). The buffers of a .gltf are
/// read only from its own folder and below; links that lead out of it are refused. The skeleton of an AMC is the ASF
/// file beside it: "01.asf" for "01_01.amc", else the only ASF of the folder. `options` tells what
/// files of markers leave open; its `recorded` reads a run's recording, which else is refused as one without motion.
Result<ClipFile> ReadClipFile(const std::string& path, const std::optional<std::string>& layout = std::nullopt,
                              const OpenOptions& options = {});

/// A clip as its file stores it.
struct SourceClip {
  std::string name;    ///< "01_01", "Med_General#Dance": the file's name without folder and extension, and the
                       ///< animation; "builtin:clap"
  std::string source;  ///< the reference that opens it again: "mocap/01_01.bvh", "path.glb#Dance", "builtin:clap"
  ClipFormat format = ClipFormat::kBvh;
  Clip clip;
  /// The file's own figure if it has meshes; its skeleton is the clip's. All clips of the file share it.
  std::shared_ptr<const Character> character;
  std::optional<Ground> ground = {};  ///< the ground shared by all clips of the file; only if the file holds several
  std::optional<MadeBody> made = {};  ///< set if the clip is a body already: it is in metres, with Y up
  std::vector<std::string> remarks = {};  ///< repairs made while reading the file; UnderstandClip appends them to the
                                          ///< body's note
  std::optional<JointMapOverrides> roles = {};  ///< as in ClipFile::roles; those of OpenOptions have priority
  std::shared_ptr<const MarkerMotion> shown = {};  ///< as in ClipFile::shown; null for other clips
};

/// Reads the clips of one file or built-in name (as ExpandReference returns them): the one clip of a BVH, all
/// animations of a glTF, or the animation named behind '#'. That name may leave out the prefix that exporters write
/// ("Jump" for "Armature|Jump"). Fails if no such animation exists, and lists those that do. `options` may override the
/// frame rate of files, and help to find the ground.
Result<std::vector<SourceClip>> ReadClips(const std::string& reference, const OpenOptions& options = {});
/// Does the same for a reference that stands for one clip; else fails and lists those that there are.
Result<SourceClip> ReadOneClip(const std::string& reference, const OpenOptions& options);

/// A clip with its roles found and its body's motion.
struct OpenedClip {
  SourceClip source;
  JointMap map;
  BodyConversion body;
};

/// Finds the roles and the body motion of a clip. Built-in clips are bodies already: they are in metres and keep their
/// position.
Result<OpenedClip> UnderstandClip(SourceClip source, const OpenOptions& options);

}  // namespace etude
