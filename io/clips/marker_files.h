#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/trc.h"
#include "engine/motion/raw_motion.h"
#include "engine/retargeting/joint_arrays.h"
#include "engine/retargeting/markers.h"
#include "io/clips/clip_file.h"

namespace etude {

/// Return the user's choices, from an option or a joint map: the up axis, the metres per unit, and whether the floor is
/// kept.
std::optional<UpAxis> ToldUp(const OpenOptions& options);
std::optional<double> ToldUnit(const OpenOptions& options);
bool KeepsFloor(const OpenOptions& options);
/// Returns the user's options for arrays of positions: rate, unit and up axis.
ArrayOptions ToldOfArrays(const OpenOptions& options);

/// Returns the rule for the up axis that the format of a clip with a skeleton defines; nullopt for BVH and Acclaim.
std::optional<UpRule> UpRuleOf(ClipFormat format);

/// Returns true for the formats of animations: glTF, GLB and FBX. They define a unit, and their clips have names.
bool IsOfAnimations(ClipFormat format);

/// Returns true for the formats of markers, and for files of joint positions that are read like markers.
bool IsOfMarkers(ClipFormat format);

/// Returns the user's options for markers; `rule` determines the up axis if the user gives none.
MarkerOptions ToldOfMarkers(const OpenOptions& options, UpRule rule);

/// Finds every body that the markers show, and makes a clip of each.
Result<ClipFile> FileOfMarkers(ClipFormat format, MarkerMotion markers, const std::string& path,
                               const MarkerOptions& options);

/// Makes a clip of the body in a motion whose joints may have any names. The positions are in metres with Y up and keep
/// the motion's own floor, except if they were rotated from a camera's frame. The options for unit and up axis are
/// ignored here, because the reader of arrays has already applied them. The notes of `motion` are added to the clip's
/// changes.
Result<ClipFile> FileOfJoints(ClipFormat format, const RawMotion& motion, const std::string& path, OpenOptions options);

/// The markers of a file, before any body is searched.
struct MarkerFile {
  ClipFormat format = ClipFormat::kTrc;
  MarkerMotion markers;
  UpRule rule;
  bool has_rate = true;
  std::string layout = "";  ///< as in MarkerOptions
};
/// Reads a file of markers (C3D, TRC, Motive's CSV, joint CSV, a table of points); returns nullopt if the file is of
/// another kind.
std::optional<Result<MarkerFile>> ReadMarkers(std::string_view bytes, const std::string& path);

}  // namespace etude
