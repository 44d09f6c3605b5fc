#include "cli/stream_reading.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "cli/arguments.h"
#include "engine/teaching/equal_streams.h"

namespace etude {

void AddStreamReading(CLI::App& command, StreamArguments& reading) {
  command.add_option("--format", reading.format, "Format of the recordings (default: detected from the content)")
      ->check(OneOf(StreamFormatNames()));
  command
      .add_option(
          "--rate", reading.rate_hz,
          "Frame rate, in Hz: of recordings without times (default: 30), or of clips (default: the rate of the clip)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command
      .add_option("--body", reading.body,
                  "Which body to read if a recording contains several: 0 is the body that appears first")
      ->check(CLI::Range(0, 1000));
  command
      .add_option("--level", reading.level,
                  "Up axis and floor: auto (estimated from the body) or none (as in the file)")
      ->check(OneOf({"auto", "none"}));
  command.add_flag("--reflect", reading.reflect, "Negate X, because the recording is mirrored");
  AddClipReading(command, reading.clips, "");
}

Result<std::vector<LabelledPart>> LoadParts(const std::string& labels, std::vector<NamedStream>& streams) {
  std::vector<LabelledPart> parts;
  if (labels.empty()) {
    parts = WholeStreams(streams);
  } else {
    ASSIGN_OR_RETURN(const auto loaded, LoadLabels(labels));
    ASSIGN_OR_RETURN(parts, MatchLabels(loaded, labels, streams));
    for (const std::string& line : DescribeLabels(loaded, labels, streams)) fmt::print(stderr, "{}\n", line);
  }
  ASSIGN_OR_RETURN(const auto copies, LeaveOutCopies(streams, parts));
  for (const Error& copy : copies) fmt::print(stderr, "left out: {}\n", ToString(copy));
  return parts;
}

StreamReading StreamArguments::Reading() const {
  StreamReading reading{.rate_hz = rate_hz, .body = body};
  if (!format.empty()) reading.format = FindStreamFormat(format);
  return reading;
}

Result<LoadedStreams> StreamArguments::Load(const std::vector<std::string>& files) const {
  ClipReading of_clips = clips;
  of_clips.rate_hz = rate_hz;
  ASSIGN_OR_RETURN(const auto opening, ReadOptions(of_clips));
  return LoadStreams(files, Reading(), Options(), opening);
}

StreamOptions StreamArguments::Options() const {
  return {.levels = level == "auto", .reflects = reflect, .up = UpAxisOf(clips.up)};
}

}  // namespace etude
