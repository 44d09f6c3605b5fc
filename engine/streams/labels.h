#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// An observer's statement about what was performed in a recording.
struct Label {
  std::string clip;  ///< the recording: its file's name, or the end of its path, with or without extension
  /// The label's times, in seconds. If both times are given, the performance lasts from `from_s` to `to_s`. If only
  /// `from_s` is given, it is an action point: the moment at which observers can recognise the performance. If neither
  /// time is given, the whole recording is one performance.
  std::optional<double> from_s, to_s;
  std::string move;           ///< the intended move
  std::string fault;          ///< the fault of a wrong performance; empty if the performance was right
  std::string person;         ///< the performer; empty: unknown
  bool by_own_clock = false;  ///< true: times are of the recording's own clock; false: they count from its first frame
  int line = 0;

  bool IsRight() const { return fault.empty(); }
  bool IsActionPoint() const { return from_s && !to_s; }
};

/// A detection within this time of an action point counts as correct (Fothergill et al. 2012, MSRC-12): 333 ms.
constexpr double kActionPointTolerance = 0.333;

/// Reads labels; the format is recognised by its content:
///
///   Etude's CSV, one heading and one row per label; `person` may be missing; `truth` is `right` or the fault's name
///   (cells may be in quotes, and R's column of row names is left out):
///     clip,from_s,to_s,move,truth,person
///     seq-1,0.5,3.1,arms-open,right,anna
///   MSRC-12's tag stream, `XQPCTick;Tag` and one row per tag: action points of the recording `clip`, by its own clock
///   UTKinect's actionLabel.txt: `s01_e01`, then `walk: 252 390` in frames at 30 Hz by the recording's own clock;
///     labels whose frames are NaN are left out; a label belongs to any recording whose name contains `s01_e01`
///
/// Fails, with file, line and column, for unknown headings, a heading that is given twice, times that are not numbers,
/// performances that do not end after they begin, a file without labels, and more than 16 MiB.
Result<std::vector<Label>> ReadLabels(std::string_view text, const std::string& file, std::string_view clip = "");

/// Returns true if the label belongs to every recording that contains its name, as for UTKinect.
bool NamesManyRecordings(const Label& label);

/// Returns true if the label belongs to the recording with this name, which was read from the path `source`: its
/// `clip` is the name, or the end of the path with or without extension; for UTKinect, the name contains `clip`.
bool IsLabelOf(const Label& label, std::string_view recording, std::string_view source = "");

}  // namespace etude
