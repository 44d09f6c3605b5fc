#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/clip_reading.h"
#include "io/streams/load.h"

namespace CLI {
class App;
}

namespace etude {

/// The options for reading recordings (--format, --rate, --body, --level, --reflect) and clips (--joint-map, --unit,
/// --up, and also --rate).
struct StreamArguments {
  std::string format;  ///< name of the format; "" = recognised by content
  std::string level = "auto";
  bool reflect = false;
  std::optional<double> rate_hz;
  std::optional<int> body;
  ClipReading clips;

  StreamReading Reading() const;
  StreamOptions Options() const;
  /// Loads recordings and clips (LoadStreams).
  Result<LoadedStreams> Load(const std::vector<std::string>& files) const;
};

/// Loads the labels and finds the labelled performances in the recordings (MatchLabels). Prints on standard error
/// which labels have no recording and which recordings have no label (DescribeLabels). If `labels` is "", each
/// recording is one performance (WholeStreams). Leaves out recordings of the same motion (LeaveOutCopies), and prints
/// which.
Result<std::vector<LabelledPart>> LoadParts(const std::string& labels, std::vector<NamedStream>& streams);

/// Adds the options of StreamArguments to a command.
void AddStreamReading(CLI::App& command, StreamArguments& reading);

}  // namespace etude
