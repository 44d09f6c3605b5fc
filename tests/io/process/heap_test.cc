#include "io/process/heap.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace etude {
namespace {

// The flag "hg" of a mapping: the kernel may provide it in large pages (man 5 proc).
bool HeapMayHaveLargePages() {
  std::ifstream mappings("/proc/self/smaps");
  bool is_heap = false;
  for (std::string line; std::getline(mappings, line);) {
    if (line.find('-') < line.find(' ')) is_heap = line.ends_with("[heap]");  // the first line of a mapping
    if (is_heap && line.starts_with("VmFlags:") && line.find(" hg") != std::string::npos) return true;
  }
  return false;
}

TEST(Heap, MayHaveLargePagesIfTheKernelHasThem) {
  if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) GTEST_SKIP() << "this kernel has none";
  if (mallinfo2().arena == 0) GTEST_SKIP() << "a sanitizer's allocator is used instead of the C library's";
  EXPECT_TRUE(HeapMayHaveLargePages()) << "the test programs' main prepares the heap";
  PrepareHeap();
  EXPECT_TRUE(HeapMayHaveLargePages());
}

}  // namespace
}  // namespace etude
