#include "cli/capture_command.h"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "bench/files/files.h"
#include "cli/capture_views.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "engine/formats/trc.h"

namespace etude {
namespace {

/// False when it was interrupted.
Result<bool> Capture(const CaptureCommandOptions& options) {
  for (const std::string* path : {&options.output, &options.points, &options.film, &options.distances}) {
    if (!path->empty()) RETURN_IF_ERROR(CheckOutput(*path, options.overwrite));
  }
  RETURN_IF_ERROR(FormatOfName(options.output));
  if (options.keypoints.empty() && options.marks.empty() && !options.silhouettes) {
    return Fail({}, "what shall tell where the person is? allowed: --keypoints DIR, --marks DIR or --silhouettes");
  }
  std::optional<MarkerMotion> reference;
  if (!options.reference.empty()) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(options.reference));
    ASSIGN_OR_RETURN(reference, ReadTrc(text, options.reference));
  }
  ASSIGN_OR_RETURN(const auto views, OpenFilms(options));
  const FilmFacts& facts = views.front().facts;
  if (reference && std::abs(reference->rate_hz - facts.rate_hz) > 0.01) {
    return Fail({options.reference}, "{:g} frames a second, the films {:g}", reference->rate_hz, facts.rate_hz);
  }
  fmt::print("{} films, {} frames at {:g} Hz\n", views.size(), facts.frames, facts.rate_hz);
  return options.silhouettes ? CaptureUnmarked(options, views, reference) : CaptureKeypoints(options, views, reference);
}

}  // namespace

int CaptureCommand(const CaptureCommandOptions& options) {
  const auto is_whole = Capture(options);
  if (!is_whole) return Complain(is_whole.error());
  return *is_whole ? kSuccess : TellStopped({{options.film}, "stopped; there is no film"});
}

}  // namespace etude
