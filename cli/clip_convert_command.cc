#include <fmt/core.h>

#include "bench/clips/convert.h"
#include "bench/files/files.h"
#include "cli/clip_commands.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/output_file.h"

namespace etude {
namespace {

Performer PerformerNamed(const std::string& name) {
  if (name == "bear") return Performer::kBear;
  if (name == "mannequin") return Performer::kMannequin;
  return name == "none" ? Performer::kNone : Performer::kFile;
}

Result<std::string> Convert(const ClipConvertOptions& given) {
  RETURN_IF_ERROR(CheckOutput(given.output, given.overwrite));
  ASSIGN_OR_RETURN(const auto format, FormatOfName(given.output));
  ASSIGN_OR_RETURN(auto reading, ReadOptions(given.reading));
  ASSIGN_OR_RETURN(const auto trim, ReadTrim(given.trim));
  ASSIGN_OR_RETURN(const auto references, ExpandAll({given.input}));
  if (references.size() > 1) {
    return Fail({}, "'{}' stands for {} clips; one file is converted at a time", given.input, references.size());
  }
  ASSIGN_OR_RETURN(auto clips, ReadClips(references.front(), reading));

  ConvertOptions options{.trim = trim,
                         .rate_hz = std::nullopt,
                         .mirror = given.mirror,
                         .ground = given.ground,
                         .retarget = given.retarget,
                         .performer = PerformerNamed(given.character),
                         .open = std::move(reading)};
  if (given.rate_hz > 0) options.rate_hz = given.rate_hz;
  ASSIGN_OR_RETURN(const auto converted, ConvertClips(std::move(clips), format, options));
  RETURN_IF_ERROR(WriteFileAtomically(given.output, converted.bytes));
  return converted.note;
}

}  // namespace

int ClipConvertCommand(const ClipConvertOptions& options) {
  const auto note = Convert(options);
  if (!note) return Complain(note.error());
  fmt::print("{}\n", *note);
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace etude
