#include <gtest/gtest.h>

#include <cstring>
#include <iostream>
#include <string>
#include <string_view>

#include "io/process/heap.h"

namespace {

constexpr std::string_view kHeavy = "HEAVY_";  // prefix of tests that only `scripts/test --full` runs

// Returns a filter for the tests in tests/`folder`, without its subfolders: for the heavy tests if `heavy` is true,
// else for the others; "" if there are none.
std::string TestsOf(const std::string& folder, bool heavy) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int s = 0; s < all.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *all.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      const std::string file = test.file();
      if (!file.substr(0, file.rfind('/')).ends_with("/tests/" + folder)) continue;
      if (std::string_view(test.name()).starts_with(kHeavy) != heavy) continue;
      filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

// GoogleTest's main with `--folder=bench/statistics`, which runs only this folder's tests: those that are not heavy, or
// with a second argument `--heavy` the heavy ones. A filter given on the command line replaces this selection.
int main(int argc, char** argv) {
  etude::PrepareHeap();
  testing::InitGoogleTest(&argc, argv);
  constexpr const char* kFolder = "--folder=";
  const bool heavy = argc == 3 && std::strcmp(argv[2], "--heavy") == 0;
  if (argc == 2 + heavy && std::strncmp(argv[1], kFolder, std::strlen(kFolder)) == 0) {
    const std::string tests = TestsOf(argv[1] + std::strlen(kFolder), heavy);
    if (tests.empty()) {
      std::cerr << argv[0] << ": no test stands in tests/" << argv[1] + std::strlen(kFolder) << "\n";
      return 2;
    }
    if (GTEST_FLAG_GET(filter) == "*") {
      GTEST_FLAG_SET(filter, tests);
    }
  } else if (argc > 1) {
    std::cerr << argv[0] << ": unknown argument '" << argv[1]
              << "'; allowed: --folder=FOLDER [--heavy], GoogleTest's own\n";
    return 2;
  }
  return RUN_ALL_TESTS();
}
