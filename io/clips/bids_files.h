#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// Finds the files that describe a file of a BIDS data set, by the inheritance principle: `path` is the described file,
/// such as ".../sub-01_task-walk_tracksys-omc_motion.tsv", and `suffix` ends the names of the files that are searched,
/// such as "motion.json". A file applies if it lies in the folder of `path` or in a folder above, and if all entities
/// of its name ("task-walk") are also in the name of `path`. Returns at most one file per folder, the one with the most
/// entities, from the highest folder to the folder of `path`. The highest folder is the one that contains
/// dataset_description.json, at most four above.
std::vector<std::string> FindBidsFiles(const std::string& path, std::string_view suffix);

}  // namespace etude
