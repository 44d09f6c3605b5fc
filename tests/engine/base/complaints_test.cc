#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/result.h"
#include "engine/base/utf8.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

TEST(Complaints, OfNamesPlacesAndBytesAreAsTheyWere) {
  const std::vector<std::string> known = {"ccd", "ccd-hinges", "dls", "fabrik", "a", "left_shoulder", "right_shoulder"};
  std::vector<std::string> lines;
  for (const std::string& name : testing::Parts(
           "cdc^ccdd^cc^x^^CCD^fabirk^fbrik^fabrikk^fribak^hinges^ccd-hinge^ccd_hinges^left_sholder^leftshoulder^"
           "lef_shoulde^shoulder^b^dsl^dl^right_shuolder^rihgt_shuolder^rigt_shuolder")) {
    lines.push_back(UnknownName("solver", name, known));
  }
  lines.push_back(UnknownName("thing", "a", {}));
  for (const std::size_t length : {39u, 40u, 41u, 80u, 200u}) {
    lines.push_back(Quote(std::string(length, 'w')));
    lines.push_back(Quote(std::string(length, 'w') + "\xc3\xa9\xc3\xa9"));
  }
  for (const char* text : {"", "a'b", "\n", "\x7f", "\xc3\xa9", "\xff", "\t\x1b[0m"}) lines.push_back(Quote(text));
  for (const int line : {0, 3}) {
    for (const int column : {0, 7}) {
      for (const char* file : {"", "f.txt"})
        lines.push_back(ToString(Error{{file, line, column}, "it\nis\t\x01no\x7f"}));
    }
  }
  for (const std::string& hard : testing::Parts(
           "a\nb\xc3\xa9z^\xc0\x80^\xc1\xbf^\xc2\x80^\xdf\xbf^\xe0\x9f\xbf^\xe0\xa0\x80^\xed\x9f\xbf^\xed\xa0\x80^"
           "\xee\x80\x80^\xef\xbf\xbf^\xf0\x8f\xbf\xbf^\xf0\x90\x80\x80^\xf4\x8f\xbf\xbf^\xf4\x90\x80\x80^"
           "\xf5\x80\x80\x80^\x80^\xbf^\xc3^\xe2\x82^\xe2\x28\xa1^\xf0\x9f\x90^\xf0\x9f\x28\xbb^ok\n\n "
           "\xff^\xc3\x28")) {
    const Result<void> checked = CheckUtf8("ab\r\nc" + hard + "d", "f");
    lines.push_back(Quote(hard) + ": " + (checked ? "is read" : ToString(checked.error())));
  }
  EXPECT_TRUE(testing::AreKept(lines, "tests/engine/base/complaints.txt"));
}

}  // namespace
}  // namespace etude
