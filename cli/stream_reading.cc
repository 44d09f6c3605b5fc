#include "cli/stream_reading.h"

#include <CLI/CLI.hpp>

#include "cli/arguments.h"

namespace etude {

void AddStreamReading(CLI::App& command, StreamArguments& reading) {
  command.add_option("--format", reading.format, "Of the recordings (default: told by content)")
      ->check(CLI::IsMember(StreamFormatNames()));
  command
      .add_option("--rate", reading.rate_hz,
                  "Of recordings without a clock, Hz (default: 30); of clips in the place of their own")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command.add_option("--body", reading.body, "Which of several bodies, by first appearance, from 0")
      ->check(CLI::Range(0, 1000));
  command
      .add_option("--level", reading.level,
                  "Where up and the floor are: estimated from the body, or as the file has it")
      ->check(CLI::IsMember({"auto", "none"}))
      ->capture_default_str();
  command.add_flag("--reflect", reading.reflect, "Negate X: the recording is mirrored");
  AddClipReading(command, reading.clips, "");
}

StreamReading StreamArguments::Reading() const {
  StreamReading reading{.rate_hz = rate_hz, .body = body};
  if (!format.empty()) reading.format = FindStreamFormat(format);
  return reading;
}

Result<OpenOptions> StreamArguments::ClipOptions() const {
  ClipReading all = clips;
  all.rate_hz = rate_hz;
  return ReadOptions(all);
}

StreamOptions StreamArguments::Options() const { return {.levels = level == "auto", .reflects = reflect}; }

}  // namespace etude
