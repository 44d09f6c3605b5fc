#pragma once

#include <functional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "io/drawing/film.h"

namespace etude {

/// What a tool tells while it works. Tools never print: whoever calls one decides where its words go. The defaults are
/// silent.
struct Listener {
  /// Takes text for people; lines end with '\n'.
  std::function<void(const std::string& text)> print = [](const std::string&) {};
  /// Makes the callback that is told how far a piece of work is; `what` names what is counted ("frames of left.mp4").
  std::function<OnProgress(std::string what)> progress = [](const std::string&) {
    return [](std::size_t, std::size_t) {};
  };
  /// Writes one film: calls `write` with the watch that shows progress and can stop it. Returns what `write` returns,
  /// false if it was stopped.
  std::function<Result<bool>(const std::function<Result<bool>(const FilmWatch& watch)>& write)> film =
      [](const auto& write) { return write(FilmWatch{}); };
};

/// Tells that a file was written.
void TellWritten(const Listener& listener, const std::string& path);

/// The lines that a tool told, kept for its page and its facts.
struct ToldLines {
  std::function<void(const std::string& text)> print;
  std::vector<std::string> lines = {};

  /// Tells a line and keeps it.
  void Tell(const std::string& line);
};

}  // namespace etude
