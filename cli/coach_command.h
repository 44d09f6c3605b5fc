#pragma once

#include <optional>
#include <string>

#include "cli/arguments.h"

namespace etude {

struct CoachCommandOptions {
  std::string song;               ///< a built-in song's name, or a song file
  std::string stream;             ///< a file of skeleton rows; "-": standard input
  std::string moves;              ///< a moves file: what recognisers are taught of the song's moves, "" = built in
  std::string beats;              ///< a file of the music's beats, "" = even ones at the song's tempo
  std::string click;              ///< a WAV to write, "" = none
  std::string format;             ///< of the stream, "" = told by content
  std::optional<double> rate_hz;  ///< of streams without a clock
  std::string recogniser = "key-pose";  ///< RecogniserNames()
  std::optional<double> right_from;     ///< of the evidence; else the recogniser's own
  std::string policy = "at-first-mistake";
  std::string choice = "played";
  std::string join = "planted-feet";
  std::string filter = "none";
  bool mirror = false;   ///< players dance as in a mirror
  bool reflect = false;  ///< the stream's X runs the other way
  bool now = false;      ///< begins dancing without a clap
  bool brief = false;    ///< frames in which nothing was decided are left out
  bool timing = false;   ///< tells at the end how long frames took
  bool overwrite = false;
};

/// `etude coach`: a song coached live from a skeleton stream.
int CoachCommand(const CoachCommandOptions& options);

/// Defines `etude coach`.
void DefineCoach(CLI::App& app, Action& action);

}  // namespace etude
