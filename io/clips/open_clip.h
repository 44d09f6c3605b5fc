#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
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

/// The content of a motion file.
struct ClipFile {
  ClipFormat format = ClipFormat::kBvh;
  Character figure;         ///< a skeleton, and meshes if the file has any
  std::vector<Clip> clips;  ///< on that skeleton; a glTF file may have none, and one of markers several people
  std::vector<std::string> notes = {};    ///< of clips that are bodies already: how they were made of markers
  std::vector<std::string> remarks = {};  ///< what reading had to repair
  std::optional<JointMapOverrides> roles = {};  ///< what a VRM file's own table of bones tells
};

/// The largest size of a file, or of a .gltf with its buffers, bytes; more is refused before memory is taken.
constexpr std::uintmax_t kLargestClipFile = 500'000'000;

/// Reads a BVH or glTF file, a motion of DeepMimic, an Acclaim motion (AMC), one of AMASS (.npz), an .npz or .mot of
/// our own, an array of joints (.npy, in `layout`: JointsOfArray), or markers of C3D, TRC, Motive's CSV or joint CSV
/// (FindMarkerBodies), told by its content, whatever it is called. The buffers of a .gltf are read
/// from its own folder and below only, links leading out of it are refused. An AMC's skeleton is the ASF beside it:
/// "01.asf" of "01_01.amc", else the only one of its folder. A run's recording is read by `recorded`; without it, it is
/// refused as no motion.
Result<ClipFile> ReadClipFile(const std::string& path, const std::optional<std::string>& layout = std::nullopt,
                              const RecordedMotions* recorded = nullptr);

/// The options with which a clip is opened.
struct OpenOptions {
  std::optional<JointMapOverrides> roles;  ///< of --joint-map
  BodyOptions body;
  const RecordedMotions* recorded = nullptr;  ///< reads "RUN#CELL@NAME"; null = such references are files like others
};

/// A clip as its file has it.
struct SourceClip {
  std::string name;    ///< "01_01", "Med_General#Dance": the file's name without folder and extension, and the
                       ///< animation; "builtin:clap"
  std::string source;  ///< what opens it again: "mocap/01_01.bvh", "path.glb#Dance", "builtin:clap"
  ClipFormat format = ClipFormat::kBvh;
  Clip clip;
  /// The file's own figure, when it has meshes; its skeleton is the clip's. Shared by all clips of the file.
  std::shared_ptr<const Character> character;
  std::optional<Ground> ground = {};  ///< of all clips of the file, where there are several
  std::string note = {};  ///< of a body that was made of markers: it is in metres already, and stands on the floor
  std::vector<std::string> remarks = {};  ///< what reading the file had to repair: they end the body's note
  std::optional<JointMapOverrides> roles = {};  ///< ClipFile::roles; those of OpenOptions come first
};

/// Reads the clips of one file or built-in name (as ExpandReference gives them): one of a BVH, all animations of a
/// glTF, or the one behind '#', which may leave out what exporters put before it ("Jump" of "Armature|Jump"). Fails
/// when there is none, saying what there is instead. `options` tell the rate of files, and help to find the ground.
Result<std::vector<SourceClip>> ReadClips(const std::string& reference, const OpenOptions& options = {});

/// A clip with its roles found and its body's motion.
struct OpenedClip {
  SourceClip source;
  JointMap map;
  BodyConversion body;
};

/// Finds the roles and the body's motion of a clip. Built-in clips are bodies already: metres, standing where they
/// stand.
Result<OpenedClip> UnderstandClip(SourceClip source, const OpenOptions& options);

}  // namespace etude
