#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "io/clips/convert.h"
#include "io/clips/open_clip.h"

namespace CLI {
class App;
}

namespace etude {

/// Options with facts that a motion file may lack; "" = the file decides.
struct ClipReading {
  std::string joint_map;  ///< the name of a joint-map file
  std::string unit;       ///< the unit: "m", "cm", …, or metres per unit as a number
  std::string up;         ///< the axis that points up: "y" or "z"
  std::optional<double> rate_hz = {};
  bool keep_floor = false;
  std::string marker_set = "";  ///< name of a marker set; "" = the set that fits the file best
};

/// Adds --joint-map, --unit, --up, --keep-floor and --marker-set, for every command that opens clips directly. Also
/// adds an option for the frame rate of files, with the name `rate` ("" = no such option).
void AddClipReading(CLI::App& command, ClipReading& reading, const std::string& rate = "--rate");

/// Converts `reading` to OpenOptions. Fails if a file or a value cannot be read.
Result<OpenOptions> ReadOptions(const ClipReading& reading);

/// Like ReadOptions, for commands that do not print the changes of clips: each doubt about a clip is printed once, on
/// standard error.
Result<OpenOptions> ReadOptionsTellingDoubts(const ClipReading& reading);

/// Returns the axis that "y" or "z" names; nullopt for "".
std::optional<UpAxis> UpAxisOf(const std::string& name);

/// Parses the value of --trim (ParseTimeSpan); returns nullopt for "".
Result<std::optional<TimeSpan>> ReadTrim(const std::string& text);

/// Reads --fuzzy: builtin:NAME or a file; "" means paper A's system.
Result<FuzzySystem> ReadFuzzy(const std::string& reference);

}  // namespace etude
