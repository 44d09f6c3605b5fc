#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/streams/labels.h"
#include "engine/streams/stream_maker.h"

namespace etude {

/// A recording of one person.
struct NamedStream {
  std::string name;    ///< the file's name without folder and extension, or the clip's name
  std::string source;  ///< the name under which it can be opened again
  std::string person;  ///< the person in the file's name, for known data sets (PersonInName); otherwise empty
  SkeletonStream stream;
  double start_s = 0;                     ///< time of the first frame by the file's own clock
  std::string description;                ///< one line for users: format, length, tracking states, StreamLevel, remarks
  std::optional<BodyMotion> motion = {};  ///< the true motion; known for clips only
  bool takes_up = false;                  ///< true for a recording whose format states the up axis (StreamOptions::up)
};

/// Returns the person that a file name states, for known data sets: NTU's "P003" in "S001C002P003R002A013", MSRC-12's
/// "p06" in "P1_1_1_p06", UTKinect's "s01" in "joints_s01_e02". Returns "" for other names.
std::string PersonInName(std::string_view name);

/// A performance, as a range of frames in a recording.
struct LabelledPart {
  std::size_t stream = 0;  ///< index of the recording
  std::string move, fault, person;
  int begin = 0, end = 0;        ///< frames [begin, end)
  bool is_action_point = false;  ///< the part is one frame, that of an action point
  int line = 0;

  bool IsRight() const { return fault.empty(); }
};

/// Returns true if two labels of one motion name one performance: they state the same move, and more than half of the
/// longer one's frames belong to both.
bool IsSamePerformance(const LabelledPart& a, const LabelledPart& b);

/// Finds the frames of `streams` to which the labels refer, sorted by stream and then by time. Labels of other
/// recordings are left out. Fails, with the label's line, if a performance or an action point begins more than half
/// a second before the recording or after its last frame, or if a performance ends before the recording or more than
/// half a second after it. Also fails if two labels name one performance, if one label can belong to two recordings of
/// other motions, and if no label belongs to any of the recordings.
Result<std::vector<LabelledPart>> MatchLabels(const std::vector<Label>& labels, const std::string& file,
                                              const std::vector<NamedStream>& streams);

/// Describes what `MatchLabels` passes over, one line each: labels of recordings that were not given, with the nearest
/// name of a recording without a label; recordings without a label; recordings whose labels may be times of the
/// recording's own clock; and, if a performance is wrong, how often each value of `truth` occurs. Empty if there is
/// nothing to tell.
std::vector<std::string> DescribeLabels(const std::vector<Label>& labels, const std::string& file,
                                        const std::vector<NamedStream>& streams);

/// For streams without labels: returns one right performance for each stream, which spans the whole stream. The move
/// has the file's name; for NTU's files it is the action ("A013").
std::vector<LabelledPart> WholeStreams(const std::vector<NamedStream>& streams);

/// Returns only the frames [begin, end).
SkeletonStream PartOf(const SkeletonStream& stream, int begin, int end);

/// A person of a data set, with all recordings of this person.
struct RecordedPerson {
  std::string name;
  std::vector<std::size_t> streams;  ///< indices of this person's recordings
};

/// A data set: recordings, performances in the recordings, people, and names of moves.
struct LabelledStreams {
  std::string file;  ///< the labels' file, for error messages; without labels, the first recording's file
  std::vector<NamedStream> streams;
  std::vector<LabelledPart> parts;     ///< sorted by stream, then by time
  std::vector<RecordedPerson> people;  ///< sorted by name
  std::vector<std::string> moves;      ///< all moves that labels name, sorted
  std::string nobody;                  ///< a recording whose person is not known; "" if there is none
  std::vector<Error> copies = {};      ///< recordings that were left out (LeaveOutCopies)
};

/// The texts of label files, by path.
using LabelTexts = std::map<std::string, std::string>;

/// Combines labels and recordings. Without any labels, each recording is one performance (WholeStreams); otherwise a
/// recording without a label contains no move. The person of a recording is named by its labels, otherwise by its
/// file's name; otherwise each recording counts as a person of its own. Of recordings that show the same motion, only
/// one remains (LeaveOutCopies). Fails if `ReadLabels`, `MatchLabels` or `LeaveOutCopies` fails, and if the labels of a
/// recording name two people. Names of people are compared by `ComparedName`.
Result<LabelledStreams> LabelStreams(std::vector<NamedStream> streams, const LabelTexts& labels);

}  // namespace etude
