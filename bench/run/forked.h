#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// What `work` returns for 0 … count − 1, in that order, each from one of `jobs` copies of this process, which see all
/// that it holds and change nothing of it. Fails with the first complaint, or when a copy dies.
Result<std::vector<std::string>> RunForked(std::size_t count, int jobs,
                                           const std::function<Result<std::string>(std::size_t)>& work);

}  // namespace etude
