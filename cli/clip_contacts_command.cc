#include "bench/clips/clip_library.h"
#include "bench/files/files.h"
#include "cli/clip_commands.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "reports/clips/contact_index.h"

namespace etude {
namespace {

Result<void> WriteContacts(const ClipContactsOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  ASSIGN_OR_RETURN(const auto reading, ReadOptions(options.reading));
  ASSIGN_OR_RETURN(const auto clips, LoadClips({options.clip}, {}, reading));
  if (clips.clips.size() != 1) {
    return Fail({}, "'{}' stands for {} clips; the contacts of one are drawn at a time", options.clip,
                clips.clips.size());
  }
  return WriteFileAtomically(options.output, ContactIndexSvg(clips.clips[0].name, clips.clips[0].motion));
}

}  // namespace

int ClipContactsCommand(const ClipContactsOptions& options) {
  const auto written = WriteContacts(options);
  if (!written) return Complain(written.error());
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace etude
