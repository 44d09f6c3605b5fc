#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/character.h"
#include "engine/motion/clip.h"
#include "engine/motion/raw_motion.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/map_file.h"
#include "engine/retargeting/markers.h"
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
  kBids,
  kRecording,
  kBuiltin
};
/// Returns the name of a format: "BVH", "glTF", "GLB", "FBX", "DeepMimic", "Acclaim", "AMASS", "C3D", "TRC", "CSV",
/// "NPZ", "NPY", "Motive", "MOT", "Motion-BIDS", "recording" or "built-in".
std::string_view FormatName(ClipFormat format);

/// Describes how the reader of a file made a clip's body, if the reader returns a body instead of a skeleton.
struct MadeBody {
  /// The source of the body, and every change that was made to the file's content, as sentences for users.
  std::vector<std::string> changes;
  UpFinding up = {};                   ///< the axis of the file that became Y
  double floor_m = 0;                  ///< the height in the file that became 0
  bool is_floor_known = true;          ///< MarkerBody::is_floor_known
  std::size_t first_frame = 0;         ///< the frame of the file that became the first frame
  std::optional<double> start_s = {};  ///< the first frame's time by the file's own clock, if the file states times
  std::vector<BodyStretch> others = {};  ///< MarkerBody::others
  std::array<std::vector<std::string>, kRoleCount> markers = {};  ///< MarkerBody::markers; all empty: not of markers
  std::vector<std::string> doubts = {};  ///< the entries of `changes` that state what looks wrong in the file
};

/// The content of a motion file.
struct ClipFile {
  ClipFormat format = ClipFormat::kBvh;
  Character figure;                       ///< a skeleton, and meshes if the file has any
  /// Clips of the skeleton in `figure`; some glTF files have no clip; a marker file has one clip per person.
  std::vector<Clip> clips;
  std::vector<MadeBody> bodies = {};      ///< one entry per clip if the clips are bodies already; else empty
  std::vector<std::string> remarks = {};  ///< repairs that were made while reading
  std::optional<JointMapOverrides> roles = {};  ///< roles that the bone table of a VRM file assigns
  std::set<std::string> skinned = {};           ///< the names of joints that the file declares as parts of a skeleton
  /// For each clip that was made from markers, the joints and markers in the file (MarkerBody::shown); empty unless
  /// OpenOptions::keeps_shown is set.
  std::vector<RawMotion> shown = {};
  bool has_rate = true;  ///< false: the file gives no rate, so a rate was assumed
};

/// The options with which a clip is opened.
struct OpenOptions {
  std::optional<JointMapOverrides> roles;  ///< the user's joint map (--joint-map)
  BodyOptions body;
  /// For marker files: the marker set to use (MarkerSetKeys); "" = the set that fits best.
  std::string marker_set = "";
  bool keeps_shown = false;   ///< if true, SourceClip::shown is also filled for marker files
  bool keeps_others = false;  ///< if true, MadeBody::others is also filled for marker files
  /// Reads "RUN#CELL@NAME"; null = a reference of this form is treated as a file.
  const RecordedMotions* recorded = nullptr;
  /// Receives each doubt about the body of a clip (BodyConversion::doubts); `clip` is SourceClip::source.
  std::function<void(const std::string& clip, const std::string& doubt)> on_doubt = {};
};

/// The maximum size of a file, or of a .gltf with its buffers, bytes. A larger file is refused before memory is
/// allocated.
constexpr std::uintmax_t kMaxClipFileBytes = 500'000'000;

/// Reads a motion file; the content decides the format, not the name. The known formats are BVH, glTF, GLB, FBX,
/// DeepMimic's motions, Acclaim's AMC, AMASS's .npz, our own .npz and .mot, arrays of joints (.npy; JointsOfArray
/// explains `layout`), and markers in C3D, TRC, Motive's CSV or joint CSV (FindMarkerBodies). The buffers of a .gltf
/// are read only from its own folder and below; links that lead out of that folder are refused. The skeleton of an AMC
/// is the ASF file beside it: "01.asf" for "01_01.amc", else the only ASF of the folder. `options` supplies facts that
/// marker files do not state. `options.recorded` reads the recordings of runs; if it is null, recordings are refused as
/// files without motion.
Result<ClipFile> ReadClipFile(const std::string& path, const std::optional<std::string>& layout = std::nullopt,
                              const OpenOptions& options = {});

}  // namespace etude
