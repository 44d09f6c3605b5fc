#pragma once

#include <optional>
#include <string>

#include "bench/streams/load.h"

namespace CLI {
class App;
}

namespace etude {

/// The options that say how recordings are read: --format, --rate, --body, --level, --reflect.
struct StreamArguments {
  std::string format;  ///< "" = told by content
  std::string level = "auto";
  bool reflect = false;
  std::optional<double> rate_hz;
  std::optional<int> body;

  StreamReading Reading() const;
  StreamOptions Options() const;
};

/// Adds these options to a command.
void AddStreamReading(CLI::App& command, StreamArguments& reading);

}  // namespace etude
