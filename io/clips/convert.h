#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/clip.h"
#include "io/clips/open_clip.h"

namespace etude {

/// A part of a clip, seconds from its first frame.
struct TimeSpan {
  double from_s = 0;
  double to_s = 0;
};
/// Reads a span such as "1.5:4", of which either end may be left out. Anything else and an end before its start are
/// refused.
Result<TimeSpan> ParseTimeSpan(const std::string& text);

/// Returns that part of a clip, or all of it without a span. An open end is the clip's.
Result<Clip> TrimTo(const Clip& clip, const std::optional<TimeSpan>& span);

enum class MotionFormat { kBvh, kGlb, kTrc, kCsv, kC3d, kNpz, kMot };
/// Returns the format of a file by the extension of its name.
Result<MotionFormat> FormatOfName(const std::string& path);

/// The figure that performs a converted motion.
enum class Performer { kFile, kNone, kBear, kMannequin };

struct ConvertOptions {
  std::optional<TimeSpan> trim;
  std::optional<double> rate_hz;  ///< the clip's own; of bodies 30 Hz
  bool mirror = false;
  bool ground = false;    ///< as a body: twenty joints, metres, Y up, feet on the floor
  bool retarget = false;  ///< as a body with the canonical proportions
  Performer performer = Performer::kFile;
  OpenOptions open;
};

/// The bytes of the converted file, and a note in plain words on what was done.
struct Converted {
  std::string bytes;
  std::string note;
};

/// Converts the clips of one file: one, or for GLB any number. A clip keeps its own skeleton (and meshes, from glTF to
/// GLB) unless a body is asked for: by `ground`, `retarget`, a performer, or a format that has nothing but joints.
/// BVH becomes GLB in metres and Y up, which needs a unit: found by the roles, or told.
Result<Converted> ConvertClips(std::vector<SourceClip> clips, MotionFormat format, const ConvertOptions& options);

}  // namespace etude
