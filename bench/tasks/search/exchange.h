#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/search/run.h"

namespace etude {

/// Describes a library to search to outside methods.
///
/// Setting; the library is in the file `library.f64` beside it: `frames` times 24 numbers, frame by frame in time
/// order. They are the grades of paper A's terms in the order of `terms`, as little-endian IEEE 754 numbers of 64 bits:
///
///     {"frames": 10000, "terms": [{"feature": "RH", "term": "down", "weight": 1}, …],
///      "query": "nearest", "threshold": 0.4, "file": "library.f64"}
///
/// The distance of two frames is √(Σ weight · (difference of the grades)²) over the terms (paper A, equation 1).
Payload LibraryPayload(const SearchProblem& problem, SearchQuestion question);

/// Encodes the problem: the grades of the query frames.
///
///     {"queries": [[twenty-four numbers], …]}
///
/// Each query asks for a list of frames of the library, numbered from 0. `first`: the earliest frame whose distance is
/// below the threshold, or none. `within`: all such frames, in order. `nearest` and `nearest-10`: the one or ten frames
/// of smallest distance, sorted by distance, then by frame number.
Payload DescribeQueries(std::span<const Grades> queries);

/// Encodes the truth, which is also a perfect answer; outside methods answer in the same form:
///
///     {"found": [[4711], …]}
Payload DescribeFound(const std::vector<FoundFrames>& found);

/// Reads an answer. Another number of lists, unknown frames, and frames that a list repeats are errors.
Result<SearchAnswer> ReadSearchAnswer(const Json& answer, const SearchProblem& problem, std::size_t queries,
                                      SearchQuestion question);

}  // namespace etude
