#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/motion_bids.h"
#include "engine/motion/clip.h"
#include "io/clips/open_clip.h"

namespace etude {

/// A part of a clip, in seconds from its first frame.
struct TimeSpan {
  double from_s = 0;
  double to_s = 0;
};
/// Parses a span such as "1.5:4"; the start may be left out (then it is 0), and the end may be left out (then it is
/// infinity). Fails on any other text, and if the end lies before the start.
Result<TimeSpan> ParseTimeSpan(const std::string& text);

/// Returns the part `span` of a clip, or the whole clip if there is no span. Times count from the first frame of the
/// file, also if the clip begins later (HiddenStart). If `span.to_s` is infinity, the part ends with the clip.
Result<Clip> TrimTo(const SourceClip& source, const std::optional<TimeSpan>& span);

/// The formats that can be written. kBids (Motion-BIDS) is a folder of files; every other format is one file.
enum class MotionFormat { kBvh, kGlb, kTrc, kCsv, kC3d, kNpz, kMot, kBids };
/// Returns the format of a file by the extension of its name, never kBids. Fails on an unknown extension.
Result<MotionFormat> FormatOfName(const std::string& path);

/// The figure that performs a converted motion.
enum class Performer { kFile, kNone, kBear, kMannequin };

struct ConvertOptions {
  std::optional<TimeSpan> trim;
  std::optional<double> rate_hz;  ///< frames per second; empty: the clip's own rate, or 30 Hz for bodies
  bool mirror = false;
  bool ground = false;    ///< write a body: twenty joints, metres, Y up, feet on the floor
  bool retarget = false;  ///< write a body with the canonical proportions
  Performer performer = Performer::kFile;
  OpenOptions open;
  std::string version = "";  ///< the version of Etude, for formats that store it
};

/// A converted file, and a description of the conversion for users.
struct Converted {
  std::string bytes;
  BidsFiles files = {};  ///< the result for kBids, instead of `bytes`
  std::string note;      ///< what was written: "own skeleton", "as a body: Plug-in Gait", …
  /// Every change that was made to the file's content. A change that concerns several clips is listed once.
  std::vector<std::string> changes;
};

/// Converts the clips of one file: exactly one clip, or any number of clips if the result is GLB. A clip keeps its own
/// skeleton (and its meshes, from glTF to GLB) unless the result must be a body: with `ground`, `retarget`, a
/// performer, or a format that holds only joints. A BVH file becomes GLB in metres and Y up, so the file's unit must be
/// known: the unit is found from the roles or given in `options`. Fails if a format other than GLB is to hold several
/// clips or a performer, and if trimming, resampling or UnderstandClip fails.
Result<Converted> ConvertClips(std::vector<SourceClip> clips, MotionFormat format, const ConvertOptions& options);

}  // namespace etude
