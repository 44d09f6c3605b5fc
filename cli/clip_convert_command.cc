#include <fmt/core.h>

#include "bench/clips/convert.h"
#include "bench/files/files.h"
#include "cli/clip_commands.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"

namespace etude {
namespace {

Performer PerformerNamed(const std::string& name) {
  if (name == "bear") return Performer::kBear;
  if (name == "mannequin") return Performer::kMannequin;
  return name == "none" ? Performer::kNone : Performer::kFile;
}

Result<std::string> Convert(const ClipConvertOptions& given) {
  if (auto free = CheckOutput(given.output, given.overwrite); !free) return tl::unexpected(free.error());
  const auto format = FormatOfName(given.output);
  if (!format) return tl::unexpected(format.error());
  auto reading = ReadOptions(given.reading);
  if (!reading) return tl::unexpected(reading.error());
  const auto trim = ReadTrim(given.trim);
  if (!trim) return tl::unexpected(trim.error());
  const auto references = ExpandAll({given.input});
  if (!references) return tl::unexpected(references.error());
  if (references->size() > 1) {
    return Fail({}, "'{}' stands for {} clips; one file is converted at a time", given.input, references->size());
  }
  auto clips = ReadClips(references->front());
  if (!clips) return tl::unexpected(clips.error());

  ConvertOptions options{.trim = *trim,
                         .rate_hz = std::nullopt,
                         .mirror = given.mirror,
                         .ground = given.ground,
                         .retarget = given.retarget,
                         .performer = PerformerNamed(given.character),
                         .open = std::move(*reading)};
  if (given.rate_hz > 0) options.rate_hz = given.rate_hz;
  const auto converted = ConvertClips(std::move(*clips), *format, options);
  if (!converted) return tl::unexpected(converted.error());
  if (auto written = WriteFileAtomically(given.output, converted->bytes); !written) {
    return tl::unexpected(written.error());
  }
  return converted->note;
}

}  // namespace

int ClipConvertCommand(const ClipConvertOptions& options) {
  const auto note = Convert(options);
  if (!note) return Complain(note.error());
  fmt::print("{} ({})\n", options.output, *note);
  return kSuccess;
}

}  // namespace etude
