#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/streams/load.h"

namespace etude {

/// One person of a set, with all that was recorded of them.
struct RecordedPerson {
  std::string name;
  std::vector<std::size_t> streams;  ///< indices
};

/// Recordings, who is in them, and what was done there.
struct LabelledStreams {
  std::string file;  ///< of the labels, for complaints; the recordings' where there are none
  std::vector<NamedStream> streams;
  std::vector<LabelledPart> parts;     ///< in the order of the streams, then of time
  std::vector<RecordedPerson> people;  ///< by name
  std::vector<std::string> moves;      ///< all that labels name, sorted
  std::string nobody;                  ///< a recording of which nothing says who is in it; "" = there is none
};

/// Texts of label files, by path.
using LabelTexts = std::map<std::string, std::string>;

/// Puts labels and recordings together; without labels one recording is one performance (WholeStreams). A recording
/// without a label shows nothing that was asked for. Who is in it: its labels say, else its file's name, else it is
/// somebody of its own. Refused as ReadLabels and MatchLabels do; a recording whose labels name two people.
Result<LabelledStreams> LabelStreams(std::vector<NamedStream> streams, const LabelTexts& labels);

}  // namespace etude
