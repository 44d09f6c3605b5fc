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

class RecordedFigure;  // defined in sim/character

/// A motion from which worlds can be made, at 30 Hz, in metres, with Y up and the feet on the floor.
struct LibraryClip {
  std::string name;    ///< name: "builtin:clap", "01_01" (the file's name without folder and extension), "dance#Jump"
  std::string source;  ///< the reference that opens the clip again: "builtin:clap", a path, or "path.glb#Jump"
  BodyMotion motion;
  std::optional<Move> move;  ///< the authored move, with its key poses; absent unless the clip is a built-in move
  RestBody body = {};        ///< the performer's body at rest; without joints if the body was not measured
  std::shared_ptr<const RecordedFigure> figure = {};  ///< the file's figure; null if the file has no meshes
  std::vector<std::string> changes = {};  ///< findings about the file, and every change that was made to its content
};

/// The clips of one scenario, in order. Trial t uses clip t modulo the number of clips.
struct ClipLibrary {
  std::vector<LibraryClip> clips;

  const LibraryClip& InTurn(int trial) const { return clips[static_cast<std::size_t>(trial) % clips.size()]; }
};

/// Returns the collection that a clip belongs to: the folder of its file, or "builtin".
std::string CollectionOf(const LibraryClip& clip);

/// Expands every reference (ExpandReference) and loads the reference's clips, in order; every animation of a glTF file
/// becomes a clip of its own. Fails with the name of a reference that cannot be found, read or understood. Error
/// messages name `place`, the position of the references. `on_progress` gets the number of references done.
Result<ClipLibrary> LoadClips(const std::vector<std::string>& references, const Place& place,
                              const OpenOptions& options = {}, const OnProgress& on_progress = {});

}  // namespace etude
