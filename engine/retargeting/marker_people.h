#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/formats/trc.h"
#include "engine/motion/body.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {

/// One person's markers in a file.
struct MarkerPerson {
  std::string name;  ///< the text that all of this person's markers share ("Ann" of "Ann:LANK" or "Ann_LANK"), or ""
  MarkerColumns columns;  ///< without this text; several markers of one name are represented by the first
  ChosenSet chosen;       ///< may be incomplete
  std::string remark;     ///< a text for users about markers that may be a further person's, or ""

  /// Returns true if the set determines every needed joint.
  bool IsComplete() const { return chosen.set() != nullptr && MissingFrom(*chosen.set(), columns).empty(); }
};

/// Assigns the markers of a file to people, by the markers' names. The text before the last ':' names a person. Markers
/// without it, or with the same text, are split into several people if each part is a complete set, the parts have the
/// same names of markers, and the people are apart from each other: by a text at the beginning that ends with '_', '.',
/// '-', '/' or a blank ("p1_LANK"), or by a text at the end that begins with one of these or consists of digits
/// ("LANK.1", "LANK2"). Markers that no frame shows count as absent. `set` and `roles` are those of ChooseSet.
std::vector<MarkerPerson> FindMarkerPeople(const MarkerMotion& markers, const std::string& set,
                                           const std::map<Role, std::string>& roles);

}  // namespace etude
