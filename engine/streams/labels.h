#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A statement of somebody who watched a recording about what was done in it.
struct Label {
  std::string clip;  ///< the recording: its file's name without folder and ending
  /// The label's times, seconds. Both: a performance from its beginning to its end. The first alone: an action point,
  /// the moment at which the performance is clear to those who watch. Neither: the whole recording is one performance.
  std::optional<double> from_s, to_s;
  std::string move;           ///< what was to be done
  std::string fault;          ///< what was wrong with it; empty: it was right
  std::string person;         ///< who did it; empty: not told
  bool by_own_clock = false;  ///< times are by the recording's own clock, not from its first frame
  int line = 0;

  bool IsRight() const { return fault.empty(); }
  bool IsActionPoint() const { return from_s && !to_s; }
};

/// The half width within which a detection counts for an action point (Fothergill et al. 2012, MSRC-12): 333 ms.
constexpr double kActionPointTolerance = 0.333;

/// Reads labels, told by content:
///
///   Etude's CSV, one heading and a row a label; `person` may be missing, and `truth` is `right` or the fault's name:
///     clip,from_s,to_s,move,truth,person
///     seq-1,0.5,3.1,arms-open,right,anna
///   MSRC-12's tag stream, `XQPCTick;Tag` and a row a tag: action points of the recording `clip`, by its own clock
///   UTKinect's actionLabel.txt: `s01_e01`, then `walk: 252 390` in frames at 30 Hz by the recordings' own clock;
///     labels of NaN are left out; a recording goes by whatever name holds `s01_e01`
///
/// Refused with file, line and column: unknown headings, words for times, ends before beginnings, no labels at all,
/// more than 16 MiB.
Result<std::vector<Label>> ReadLabels(std::string_view text, const std::string& file, std::string_view clip = "");

/// Says whether the label is of the recording of that name: the same name, or, of UTKinect's, part of it.
bool IsLabelOf(const Label& label, std::string_view recording);

}  // namespace etude
