#include "engine/teaching/labelled_streams.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "engine/base/names.h"
#include "engine/base/text.h"
#include "engine/recognition/recognise.h"
#include "engine/teaching/equal_streams.h"

namespace etude {
namespace {

/// Returns, for each stream, the person that the stream's labels name; "" if no label names a person. Fails if the
/// labels of a stream name two people.
Result<std::vector<std::string>> NamedByLabels(const LabelledStreams& all) {
  std::vector<std::string> names(all.streams.size());
  for (const LabelledPart& part : all.parts) {
    std::string& name = names[part.stream];
    if (!name.empty() && !part.person.empty() && ComparedName(name) != ComparedName(part.person)) {
      return Fail({all.file, part.line},
                  "{} shows the person {} by this label, but the person {} by an earlier label; allowed: one person "
                  "for each recording",
                  all.streams[part.stream].name, part.person, name);
    }
    if (name.empty()) name = part.person;
  }
  return names;
}

/// Fails if two labels name one performance (IsSamePerformance). `parts` must be sorted by stream and then by begin.
Result<void> RefuseTwice(const std::vector<LabelledPart>& parts, const std::string& file,
                         const std::vector<NamedStream>& streams) {
  for (auto a = parts.begin(); a != parts.end(); ++a) {
    for (auto b = a + 1; b != parts.end() && b->stream == a->stream && b->begin < a->end; ++b) {
      if (!IsSamePerformance(*a, *b)) continue;
      const double second = b->begin / streams[b->stream].stream.rate_hz;
      return Fail(
          {file, std::max(a->line, b->line)},
          "line {} already labels this performance of {} ({}, at {:.3f} s); allowed: one label for each performance",
          std::min(a->line, b->line), b->move, streams[b->stream].name, second);
    }
  }
  return {};
}

/// Fails if one label belongs to two recordings of other motions, unless its format means that (`NamesManyRecordings`).
Result<void> RefuseTwoRecordings(const std::vector<Label>& labels, const std::string& file,
                                 const std::vector<NamedStream>& streams) {
  const auto by_name = [](const NamedStream& stream) { return stream.source.empty() ? stream.name : stream.source; };
  for (const Label& label : labels) {
    const auto is_own = [&](const NamedStream& stream) { return IsLabelOf(label, stream.name, stream.source); };
    const auto first = std::ranges::find_if(streams, is_own);
    if (NamesManyRecordings(label) || first == streams.end()) continue;
    const auto second = std::find_if(first + 1, streams.end(), [&](const NamedStream& stream) {
      return is_own(stream) && !ShowSameMotion(first->stream, stream.stream);
    });
    if (second == streams.end()) continue;
    return Fail({file, label.line},
                "the clip {} can be {} or {}; allowed: a clip that names one recording, also by the end of its path",
                label.clip, by_name(*first), by_name(*second));
  }
  return {};
}

/// Returns true if authors of labels use this word for `right`, or if it seems to be a typing error for it.
bool MayMeanRight(const std::string& truth) {
  static const std::set<std::string> kWords = {"1", "correct", "good", "ok", "okay", "pass", "true", "y", "yes"};
  const std::vector<std::string> right{"right"};
  return kWords.contains(ComparedName(truth)) || !NearestName(truth, right).empty();
}

/// Describes the first two names that Etude compares as equal, because they are then one person; "" if none are.
std::string DescribePeople(const std::vector<Label>& labels, const std::string& file) {
  std::map<std::string, std::string> names;  // each name of a person, by its compared form
  for (const Label& label : labels) {
    const std::string& known = names.try_emplace(ComparedName(label.person), label.person).first->second;
    if (known == label.person) continue;
    return ToString(Error{{file, label.line}, fmt::format("Etude reads {} and {} as one person", known, label.person)});
  }
  return "";
}

/// Returns the first frame that shows a body, in which a performance can begin; 0 if none does.
int FirstSeen(const SkeletonStream& stream) {
  const auto first = std::ranges::find_if(stream.frames, &SensedFrame::body_seen);
  return first == stream.frames.end() ? 0 : static_cast<int>(first - stream.frames.begin());
}

/// Describes labels that may be mistakes: two right performances of different moves that overlap by more than half of
/// the longer one, and names of moves that differ only in case.
std::vector<std::string> DoubtMoves(const std::vector<Label>& labels, const std::string& file) {
  std::vector<std::string> doubts;
  std::map<std::string, std::string> names;  // each name of a move, by its lower-case form
  const auto is_whole = [](const Label& label) { return label.IsRight() && label.from_s && label.to_s; };
  for (auto a = labels.begin(); a != labels.end(); ++a) {
    const std::string& known = names.try_emplace(InLowerCase(a->move), a->move).first->second;
    if (known != a->move && doubts.empty()) {
      doubts.push_back(ToString(Error{{file, a->line},
                                      fmt::format("doubtful: the names of the moves {} and {} differ only in capital "
                                                  "letters; Etude reads them as two moves",
                                                  known, a->move)}));
    }
  }
  for (auto a = labels.begin(); a != labels.end(); ++a) {
    const auto is_same = [&](const Label& b) {
      if (!is_whole(*a) || !is_whole(b) || a->clip != b.clip || a->move == b.move) return false;
      const double common = std::min(*a->to_s, *b.to_s) - std::max(*a->from_s, *b.from_s);
      return 2 * common > std::max(*a->to_s - *a->from_s, *b.to_s - *b.from_s);
    };
    const auto b = std::find_if(labels.begin(), a, is_same);
    if (b == a) continue;
    doubts.push_back(ToString(Error{{file, a->line},
                                    fmt::format("doubtful: line {} labels the same time of {} as the move {}, but this "
                                                "line labels it as {}; Etude uses both as right performances",
                                                b->line, a->clip, b->move, a->move)}));
    break;
  }
  return doubts;
}

/// Warns of a recording whose own clock begins late if all its labels may be times of that clock; otherwise returns "".
std::string DoubtClock(const std::vector<Label>& labels, const std::string& file, const NamedStream& stream) {
  constexpr double kNoticeable = 0.1;
  double first = stream.start_s + static_cast<double>(stream.stream.frames.size()) / stream.stream.rate_hz;
  for (const Label& label : labels) {
    if (label.from_s && !label.by_own_clock && IsLabelOf(label, stream.name, stream.source))
      first = std::min(first, *label.from_s);
  }
  const double end = static_cast<double>(stream.stream.frames.size()) / stream.stream.rate_hz;
  if (stream.start_s < kNoticeable || first < stream.start_s || first >= end) return "";
  return fmt::format(
      "{}: doubtful: the clock of {} begins at {:.3f} s, and no label begins before this time. Etude counts from_s and "
      "to_s from the first frame; if your labels use the recording's clock, subtract {:.3f} s",
      file, stream.name, stream.start_s, stream.start_s);
}

}  // namespace

std::string PersonInName(std::string_view name) {
  static const std::regex kKnown[] = {std::regex("^S\\d{3}C\\d{3}(P\\d{3})R\\d{3}A\\d{3}"),
                                      std::regex("^P\\d_\\d_\\w*_(p\\d+)$"), std::regex("(?:^|_)(s\\d\\d)_e\\d\\d")};
  for (const std::regex& known : kKnown) {
    std::match_results<std::string_view::const_iterator> match;
    if (std::regex_search(name.begin(), name.end(), match, known)) return match[1].str();
  }
  return "";
}

bool IsSamePerformance(const LabelledPart& a, const LabelledPart& b) {
  const int common = std::min(a.end, b.end) - std::max(a.begin, b.begin);
  return a.move == b.move && 2 * common > std::max(a.end - a.begin, b.end - b.begin);
}

Result<std::vector<LabelledPart>> MatchLabels(const std::vector<Label>& labels, const std::string& file,
                                              const std::vector<NamedStream>& streams) {
  constexpr double kOutside = 0.5;
  RETURN_IF_ERROR(RefuseTwoRecordings(labels, file, streams));
  std::vector<LabelledPart> parts;
  std::map<std::string, std::string> spellings;  // the first spelling of each person's name, by its compared form
  for (std::size_t s = 0; s < streams.size(); ++s) {
    const NamedStream& stream = streams[s];
    const auto count = static_cast<int>(stream.stream.frames.size());
    const double length = count / stream.stream.rate_hz;
    for (const Label& label : labels) {
      if (!IsLabelOf(label, stream.name, stream.source)) continue;
      const double shift = label.by_own_clock ? stream.start_s : 0;
      const double from = label.from_s ? *label.from_s - shift : 0, to = label.to_s ? *label.to_s - shift : length;
      if (from < -kOutside || from >= length || to <= 0 || to > length + kOutside) {
        return Fail(
            {file, label.line}, "found a label {} of {}; allowed: labels within the recording, which lasts {:.3f} s",
            label.IsActionPoint() ? fmt::format("at {:.3f} s", from) : fmt::format("from {:.3f} to {:.3f} s", from, to),
            stream.name, length);
      }
      LabelledPart& part = parts.emplace_back();
      part.stream = s;
      part.move = label.move;
      part.fault = label.fault;
      const std::string& person = label.person.empty() ? stream.person : label.person;
      part.person = spellings.try_emplace(ComparedName(person), person).first->second;
      part.is_action_point = label.IsActionPoint();
      part.line = label.line;
      const FrameInterval frames = FramesBetween(from, part.is_action_point ? from : to, stream.stream);
      part.begin = std::min(label.from_s ? frames.begin : FirstSeen(stream.stream), count - 1);
      part.end = std::max(part.begin + 1, frames.end);
    }
  }
  if (parts.empty())
    return Fail({file}, "no label belongs to any of the given recordings, such as {}", streams.front().name);
  std::ranges::stable_sort(parts, [](const LabelledPart& a, const LabelledPart& b) {
    return a.stream != b.stream ? a.stream < b.stream : a.begin < b.begin;
  });
  RETURN_IF_ERROR(RefuseTwice(parts, file, streams));
  return parts;
}

std::vector<std::string> DescribeLabels(const std::vector<Label>& labels, const std::string& file,
                                        const std::vector<NamedStream>& streams) {
  // Find the recordings without a label and the labels without a recording; count the values of `truth`.
  std::vector<std::string> bare;
  for (const NamedStream& stream : streams) {
    if (std::ranges::none_of(labels,
                             [&](const Label& label) { return IsLabelOf(label, stream.name, stream.source); })) {
      bare.push_back(stream.name);
    }
  }
  std::map<std::string, int> faults;
  int right = 0;
  std::vector<const Label*> lost;
  for (const Label& label : labels) {
    const bool is_given = std::ranges::any_of(
        streams, [&](const NamedStream& stream) { return IsLabelOf(label, stream.name, stream.source); });
    if (!is_given) lost.push_back(&label);
    if (is_given) ++(label.IsRight() ? right : faults[label.fault]);
  }
  // Write one line for each kind; of the lost labels, show the first that seems to be a typing error.
  std::vector<std::string> lines;
  if (!lost.empty()) {
    const auto nearest = [&](const Label* label) { return NearestName(label->clip, bare); };
    const auto typo = std::ranges::find_if(lost, [&](const Label* label) { return !nearest(label).empty(); });
    const Label* shown = typo == lost.end() ? lost.front() : *typo;
    std::string line = ToString(Error{{file, shown->line}, fmt::format("no recording {} is given", shown->clip)});
    if (typo != lost.end()) line += fmt::format("; did you mean {}?", nearest(shown));
    if (lost.size() > 1) line += fmt::format("; Etude leaves out {} labels without a recording", lost.size());
    lines.push_back(std::move(line));
  }
  if (!bare.empty()) {
    constexpr std::size_t kShown = 3;
    const std::size_t shown = std::min(kShown, bare.size());
    lines.push_back(fmt::format("{}: no label for {}{}; each move recognised there counts as a false alarm", file,
                                Join(std::span(bare).first(shown)),
                                bare.size() > shown ? fmt::format(" and {} more", bare.size() - shown) : ""));
  }
  for (const NamedStream& stream : streams) {
    if (std::string doubt = DoubtClock(labels, file, stream); !doubt.empty()) lines.push_back(std::move(doubt));
  }
  std::ranges::move(DoubtMoves(labels, file), std::back_inserter(lines));
  if (std::string people = DescribePeople(labels, file); !people.empty()) lines.push_back(std::move(people));
  if (!faults.empty()) {
    std::vector<std::string> truths{fmt::format("right {}", right)};
    for (const auto& [fault, count] : faults) {
      truths.push_back(fmt::format("{} {}{}", fault, count,
                                   MayMeanRight(fault) ? " (Etude reads this as a fault; did you mean right?)" : ""));
    }
    lines.push_back(fmt::format("{}: truth: {}", file, Join(truths)));
  }
  return lines;
}

std::vector<LabelledPart> WholeStreams(const std::vector<NamedStream>& streams) {
  static const std::regex kNtuAction("^S\\d{3}C\\d{3}P\\d{3}R\\d{3}(A\\d{3})");
  std::vector<LabelledPart> parts;
  for (std::size_t s = 0; s < streams.size(); ++s) {
    const NamedStream& stream = streams[s];
    std::smatch match;
    const bool is_ntu = std::regex_search(stream.name, match, kNtuAction);
    LabelledPart& part = parts.emplace_back();
    part.stream = s;
    part.move = is_ntu ? match[1].str() : stream.name;
    part.person = stream.person;
    part.begin = FirstSeen(stream.stream);
    part.end = static_cast<int>(stream.stream.frames.size());
  }
  return parts;
}

SkeletonStream PartOf(const SkeletonStream& stream, int begin, int end) {
  const auto first = stream.frames.begin();
  return {.rate_hz = stream.rate_hz, .frames = {first + begin, first + end}};
}

Result<LabelledStreams> LabelStreams(std::vector<NamedStream> streams, const LabelTexts& labels) {
  LabelledStreams all;
  all.streams = std::move(streams);
  // Find the performances: the parts that labels name or, without labels, each whole stream.
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
  ASSIGN_OR_RETURN(all.copies, LeaveOutCopies(all.streams, all.parts));
  // Assign a person to every stream.
  ASSIGN_OR_RETURN(const auto named, NamedByLabels(all));
  std::map<std::string, std::vector<std::size_t>> streams_of;
  std::map<std::string, std::string> spellings;  // the first spelling of each person's name, by its compared form
  for (std::size_t s = 0; s < all.streams.size(); ++s) {
    NamedStream& stream = all.streams[s];
    if (!named[s].empty()) stream.person = named[s];
    if (stream.person.empty()) {
      stream.person = stream.name;
      if (all.nobody.empty()) all.nobody = stream.name;
    } else {
      stream.person = spellings.try_emplace(ComparedName(stream.person), stream.person).first->second;
    }
    streams_of[stream.person].push_back(s);
  }
  // Collect people and moves.
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
