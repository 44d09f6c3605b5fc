#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/streams/load.h"

namespace etude {

/// How recordings are read: --format, --rate, --body, --level, --reflect.
struct StreamArguments {
  std::string format;  ///< "" = told by content
  std::string level = "auto";
  bool reflect = false;
  std::optional<double> rate_hz;
  std::optional<int> body;

  StreamReading Reading() const;
  StreamOptions Options() const;
};

struct TeachCommandOptions {
  std::vector<std::string> streams;
  std::string labels;  ///< "" = one file is one move
  std::string output;
  bool overwrite = false;
  StreamArguments reading;
};
/// `etude teach`: a moves file.
int TeachCommand(const TeachCommandOptions& options);

struct RecogniseCommandOptions {
  std::vector<std::string> streams;  ///< one "-" = standard input, live
  std::string moves;
  std::string labels;
  std::string recogniser;  ///< "" = key-pose
  std::string filter = "none", weights = "fixed";
  std::optional<double> threshold;
  std::vector<std::string> settings;  ///< "tolerance_scale=1.2"
  bool leave_one_person_out = false;
  bool as_json = false;
  StreamArguments reading;
};
/// `etude recognise`: events as JSON Lines; with labels the scores.
int RecogniseCommand(const RecogniseCommandOptions& options);

}  // namespace etude
