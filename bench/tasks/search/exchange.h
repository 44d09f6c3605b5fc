#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/search/run.h"

namespace etude {

/// Describes a library to search to methods outside the program.
///
/// Setting; the library lies beside it as `library.f64`: `frames` times 24 numbers, frame by frame in time order, the
/// grades of paper A's terms in the order of `terms`, each a little-endian IEEE 754 number of 64 bits:
///
///     {"frames": 10000, "terms": [{"feature": "RH", "term": "down", "weight": 1}, …],
///      "query": "nearest", "threshold": 0.4, "file": "library.f64"}
///
/// The distance of two frames is √(Σ weight · (difference of the grades)²) over the terms (paper A, equation 1).
Payload LibraryPayload(const SearchProblem& problem, SearchQuestion question);

/// Makes the problem: the frames asked about, as their grades.
///
///     {"queries": [[twenty-four numbers], …]}
///
/// Each query asks for a list of frames of the library (their numbers, from 0): `first` for the one of smallest number
/// whose distance is below the threshold, or none; `within` for all of these, by number; `nearest` and `nearest-10` for
/// the one, or ten, of smallest distance, by distance, those of equal distance by number.
Payload DescribeQueries(std::span<const Grades> queries);

/// Makes the truth, itself a perfect answer; a method outside answers the same:
///
///     {"found": [[4711], …]}
Payload DescribeFound(const std::vector<FoundFrames>& found);

/// Reads an answer. Refuses what is not as told above: another number of lists, and frames that the library does not
/// have or that stand twice in a list.
Result<SearchAnswer> ReadSearchAnswer(const Json& answer, const SearchProblem& problem, std::size_t queries,
                                      SearchQuestion question);

}  // namespace etude
