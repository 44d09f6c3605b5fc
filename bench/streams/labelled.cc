#include "bench/streams/labelled.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace etude {
namespace {

/// Whom the labels of each stream name; "" where they name nobody.
Result<std::vector<std::string>> NamedByLabels(const LabelledStreams& all) {
  std::vector<std::string> names(all.streams.size());
  for (const LabelledPart& part : all.parts) {
    std::string& name = names[part.stream];
    if (!name.empty() && !part.person.empty() && name != part.person) {
      return Fail({all.file, part.line}, "{} shows {}, and {} before; a recording shows one person",
                  all.streams[part.stream].name, part.person, name);
    }
    if (name.empty()) name = part.person;
  }
  return names;
}

}  // namespace

Result<LabelledStreams> LabelStreams(std::vector<NamedStream> streams, const LabelTexts& labels) {
  LabelledStreams all;
  all.streams = std::move(streams);
  all.file = all.streams.front().source;
  if (labels.empty()) {
    all.parts = WholeStreams(all.streams);
  } else {
    all.file = labels.begin()->first;
    std::vector<Label> read;
    for (const auto& [file, text] : labels) {
      ASSIGN_OR_RETURN(const auto some, ReadLabels(text, file, std::filesystem::path(file).stem().string()));
      read.insert(read.end(), some.begin(), some.end());
    }
    ASSIGN_OR_RETURN(all.parts, MatchLabels(read, all.file, all.streams));
  }
  ASSIGN_OR_RETURN(const auto named, NamedByLabels(all));
  std::map<std::string, std::vector<std::size_t>> streams_of;
  for (std::size_t s = 0; s < all.streams.size(); ++s) {
    NamedStream& stream = all.streams[s];
    if (!named[s].empty()) stream.person = named[s];
    if (stream.person.empty()) {
      stream.person = stream.name;
      if (all.nobody.empty()) all.nobody = stream.name;
    }
    streams_of[stream.person].push_back(s);
  }
  for (auto& [name, own] : streams_of) all.people.push_back({name, std::move(own)});
  std::set<std::string> moves;
  for (LabelledPart& part : all.parts) {
    part.person = all.streams[part.stream].person;
    moves.insert(part.move);
  }
  all.moves.assign(moves.begin(), moves.end());
  return all;
}

}  // namespace etude
