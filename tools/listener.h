#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "io/drawing/film.h"

namespace etude {

/// Receives the messages and progress of a tool. Tools never print; the caller decides where text goes. The defaults
/// are silent.
struct Listener {
  /// Receives text for people; every line ends with '\n'.
  std::function<void(const std::string& text)> print = [](const std::string&) {};
  /// Returns a callback for the progress of one piece of work; `what` names the counted things ("frames of left.mp4").
  std::function<OnProgress(std::string what)> progress = [](const std::string&) {
    return [](std::size_t, std::size_t) {};
  };
  /// Runs `write`, a function that writes one film, with a FilmWatch that shows the progress of `write` and can stop
  /// the film. Returns the result of `write`; false means that the film was stopped.
  std::function<Result<bool>(const std::function<Result<bool>(const FilmWatch& watch)>& write)> film =
      [](const auto& write) { return write(FilmWatch{}); };
};

/// Prints a message that a file was written.
void TellWritten(const Listener& listener, const std::string& path);

/// Prints lines, and keeps these lines for the tool's page and JSON.
struct MessageLog {
  std::function<void(const std::string& text)> print;
  std::vector<std::string> lines = {};

  /// Prints a line and keeps it.
  void Tell(const std::string& line);
};

}  // namespace etude
