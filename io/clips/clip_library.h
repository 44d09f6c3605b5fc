#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/rest_body.h"
#include "io/clips/open_clip.h"
#include "sim/choreography/move.h"

namespace etude {

class RecordedFigure;  // sim/character

/// A motion that worlds can be made of: at 30 Hz, metres, Y up, feet on the floor.
struct LibraryClip {
  std::string name;    ///< "builtin:clap", "01_01" (the file's name without folder and extension), "dance#Jump"
  std::string source;  ///< what opens it again: "builtin:clap", a path, or "path.glb#Jump"
  BodyMotion motion;
  std::optional<Move> move;  ///< the authored move, with its key poses; only built-in moves have one
  std::string note;          ///< what loading had to repair ("dropped a leading T-pose", "1 unit = 5.65 cm")
  RestBody body = {};        ///< of who moves, at rest; without joints where nobody has measured it
  std::shared_ptr<const RecordedFigure> figure = {};  ///< of a file with meshes
};

/// The clips of one scenario, in order; trials go round-robin over them.
struct ClipLibrary {
  std::vector<LibraryClip> clips;

  const LibraryClip& InTurn(int trial) const { return clips[static_cast<std::size_t>(trial) % clips.size()]; }
};

/// Returns the collection that a clip belongs to: the folder of its file, or "builtin".
std::string CollectionOf(const LibraryClip& clip);

/// Loads every reference, in order: what ExpandReference knows; every animation of a glTF file is a clip of its own.
/// Fails with the name of what cannot be found, read or understood. `place` is where the reference stands, for
/// complaints. `on_progress` is told of references.
Result<ClipLibrary> LoadClips(const std::vector<std::string>& references, const Place& place,
                              const OpenOptions& options = {}, const OnProgress& on_progress = {});

}  // namespace etude
