#include "io/process/heap.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <memory>

namespace etude {
namespace {

/// Under a limit, addresses that the heap reserves could be missing elsewhere, for instance for a library.
bool HasLimitedAddresses() {
  constexpr std::array kLimits = {RLIMIT_AS, RLIMIT_DATA};
  return std::ranges::any_of(kLimits, [](auto resource) {
    rlimit limit{};
    return ::getrlimit(resource, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
  });
}

}  // namespace

void PrepareHeap() {
  constexpr std::size_t kLargePage = 2 << 20, kBlock = 31 << 20;
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // smaller blocks, hence those below, belong to the heap
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  if (HasLimitedAddresses()) return;
  const std::array blocks = {std::malloc(kBlock), std::malloc(kBlock)};
  for (void* block : blocks) {
    void* start = block;
    std::size_t size = kBlock;
    if (std::align(kLargePage, kLargePage, start, size) != nullptr) ::madvise(start, size, MADV_HUGEPAGE);
  }
  for (void* block : blocks) std::free(block);
}

}  // namespace etude
