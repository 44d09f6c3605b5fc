#pragma once

#include <string>

namespace etude {

/// The name that the files of a run's scenario number `index` get, without an ending. A scenario's name comes from a
/// file of the user: only harmless characters reach a path, and no two scenarios of a run share a name.
std::string FileNameOf(const std::string& scenario, std::size_t index);

}  // namespace etude
