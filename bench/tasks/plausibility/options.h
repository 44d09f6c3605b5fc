#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/keys/field_table.h"

namespace etude {

/// A condition of task plausibility.
struct PlausibilityOptions {
  std::optional<double> floor_m;  ///< height of the floor; if absent, see FindMotionFaults
  std::string people;             ///< a pattern for names, such as "{person}_*"; "" = each clip is a unit of its own
  std::map<std::string, double> limits;  ///< the largest allowed value of metrics, by id
};

const FieldTable<PlausibilityOptions>& PlausibilityConditionFields();

/// A method of task plausibility: motions from elsewhere.
struct PlausibilityMethod {
  std::string name;
  std::vector<std::string> answers;  ///< files, patterns or folders
};

const FieldTable<PlausibilityMethod>& PlausibilityMethodFields();

/// Reads limits: a mapping from metrics of this task to their largest allowed values. An unknown metric is an error in
/// `fields`.
std::map<std::string, double> ReadLimits(Fields& fields);

}  // namespace etude
