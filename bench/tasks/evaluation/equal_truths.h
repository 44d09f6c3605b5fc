#pragma once

#include <vector>

#include "bench/tasks/base/task.h"

namespace etude {

/// Finds the worlds whose truths show the same motion: the same joints and frames, and positions that one rigid motion
/// of the whole take moves onto each other, to within a millimetre. Copies of a file and several cameras' views of one
/// take are such truths. Each world but the first gets the name of the first in `same_as`, and the first one's person
/// in `unit`. Reads every truth once, and both truths again for each pair that seems equal. Truths that cannot be
/// read equal no other.
void FindEqualTruths(std::vector<JudgedFiles>& worlds, const OpenOptions& opening);

}  // namespace etude
