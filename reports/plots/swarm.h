#pragma once

#include <vector>

namespace etude {

/// How far each mark of a row is moved aside, so that marks at neighbouring places can be told apart: `places` along
/// the row, in the panel's units; at most `most` to either side. The same places give the same swarm.
std::vector<double> SwarmOffsets(const std::vector<double>& places, double most);

/// Every how manyeth of `count` marks is drawn, so that no more than `most` are.
std::size_t StrideFor(std::size_t count, std::size_t most);

}  // namespace etude
