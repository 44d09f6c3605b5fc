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
  std::string name;    ///< the file's, without folder and ending; a clip's
  std::string source;  ///< what opens it again
  std::string person;  ///< as the file's name tells in sets that are known (PersonInName), else ""
  SkeletonStream stream;
  double start_s = 0;                     ///< of its first frame, by the file's own clock
  std::string description;                ///< one line, for people: format, length, states, level, remarks
  std::optional<BodyMotion> motion = {};  ///< what was truly done; of clips alone
};

/// Returns who was recorded, as file names of known sets have it: NTU's "P003" of "S001C002P003R002A013", MSRC-12's
/// "p06" of "P1_1_1_p06", UTKinect's "s01" of "joints_s01_e02"; else "".
std::string PersonInName(std::string_view name);

/// A performance within its recording.
struct LabelledPart {
  std::size_t stream = 0;  ///< index
  std::string move, fault, person;
  int begin = 0, end = 0;        ///< frames [begin, end)
  bool is_action_point = false;  ///< `begin` is the frame; `end` one more
  int line = 0;

  bool IsRight() const { return fault.empty(); }
};

/// Finds what the labels mean in these streams, in the order of the streams, then of time. A label of another recording
/// is left out. Refused, with the label's line: times outside the recording by more than half a second; no label of any
/// recording.
Result<std::vector<LabelledPart>> MatchLabels(const std::vector<Label>& labels, const std::string& file,
                                              const std::vector<NamedStream>& streams);

/// Takes each stream without labels for one move, performed right and called by the file's name; of NTU's by its action
/// ("A013").
std::vector<LabelledPart> WholeStreams(const std::vector<NamedStream>& streams);

/// Returns the frames [begin, end) alone.
SkeletonStream PartOf(const SkeletonStream& stream, int begin, int end);

/// A person of a set, with all that was recorded of them.
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

/// The texts of label files, by path.
using LabelTexts = std::map<std::string, std::string>;

/// Puts labels and recordings together; without labels one recording is one performance (WholeStreams). A recording
/// without a label shows nothing that was asked for. Who is in it: its labels say, else its file's name, else it is
/// somebody of its own. Refused as ReadLabels and MatchLabels do; a recording whose labels name two people.
Result<LabelledStreams> LabelStreams(std::vector<NamedStream> streams, const LabelTexts& labels);

}  // namespace etude
