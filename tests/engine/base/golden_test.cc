#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "engine/base/angles.h"
#include "engine/base/base64.h"
#include "engine/base/cyclic_lookup.h"
#include "engine/base/digest.h"
#include "engine/base/directions.h"
#include "engine/base/euler.h"
#include "engine/base/image.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/result.h"
#include "engine/base/smoothstep.h"
#include "engine/base/utf8.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

TEST(BaseGolden, OfTurns) {
  testing::Dice dice(1);
  std::vector<glm::dvec3> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < 6; ++i) directions.push_back(glm::normalize(dice.Vector()));
  directions.push_back(-directions.back());
  testing::Fingerprint print;
  const auto add = [&](const glm::dmat3& turn) { print.Add(turn[0]).Add(turn[1]).Add(turn[2]); };
  for (const glm::dvec3& from : directions) {
    for (const glm::dvec3& to : directions) {
      add(SmallestRotation(from, to));
      print.Add(AngleBetween(from, 3.0 * to)).Add(UnitOr(from - to, {1, 2, 3}));
      if (std::abs(glm::dot(from, to)) < 0.99) print.Add(UnitNormalPart(from, to));
    }
    add(AxisRotation(from, 2.0 + from.x));
    for (const double y : {-kPi / 2, -1.0, 0.3, kPi / 2 - 1e-7, kPi / 2}) {
      const glm::dvec3 angles(3 * from.x, y, 3 * from.z);
      add(RotationXyz(angles));
      print.Add(AnglesXyz(RotationXyz(angles)));
    }
  }
  for (const double length : {0.0, 0.9e-9, 1e-9, 1.1e-9}) print.Add(UnitOr({0, length, 0}, {1, 0, 0}));
  EXPECT_TRUE(print.Is(3550, 20.9812391479));
}

TEST(BaseGolden, OfNumbersInOrderStepsAndLight) {
  testing::Dice dice(2);
  testing::Fingerprint print;
  std::vector<double> values;
  for (int count = 1; count <= 12; ++count) {
    values.push_back(dice.Signed());
    print.Add(UpperMedian(values));
    for (const double share : {0.0, 0.05, 0.1, 0.25, 0.5, 0.95, 0.999, 1.0}) print.Add(LowerPercentile(values, share));
  }
  for (double t = -0.5; t <= 1.5; t += 0.093) print.Add(Smoothstep(0.1, 0.9, t)).Add(Smootherstep(t));
  for (int value = 0; value < 256; ++value) {
    const double light = LinearOfSrgb(static_cast<std::uint8_t>(value));
    EXPECT_EQ(SrgbOfLinear(light), value);
    print.Add(light).Add(SrgbOfLinear(value / 200.0 - 0.1));
  }
  ColourImage image(3, 2, {1, 2, 3});
  for (const auto& [x, y] : {std::pair{0, 0}, {2, 1}, {3, 1}, {2, 2}, {-1, 0}, {0, -1}})
    print.Add(image.Contains(x, y));
  image.At(2, 1).g = 9;
  EXPECT_TRUE(print.Add(image.pixels[5].g).Is(671, 3371.65403046));
}

TEST(BaseGolden, OfNames) {
  const std::vector<std::string> known = {"ccd", "ccd-hinges", "dls", "fabrik", "a", "left_shoulder", "right_shoulder"};
  testing::Fingerprint print;
  for (const char* name : {"cdc",
                           "ccdd",
                           "cc",
                           "x",
                           "",
                           "CCD",
                           "fabirk",
                           "fbrik",
                           "fabrikk",
                           "fabri",
                           "fribak",
                           "hinges",
                           "ccd-hinge",
                           "ccd_hinges",
                           "left_sholder",
                           "leftshoulder",
                           "lef_shoulde",
                           "shoulder",
                           "b",
                           "dsl",
                           "dl",
                           "right_shuolder",
                           "rihgt_shuolder",
                           "rigt_shuolder"}) {
    print.Add(NearestName(name, known)).Add(UnknownName("solver", name, known));
  }
  print.Add(NearestName("a", {})).Add(UnknownName("thing", "a", {})).Add(Join(known, "; ")).Add(Join({}));
  for (const std::size_t length : {1u, 39u, 40u, 41u, 59u, 60u, 61u, 79u, 80u, 81u, 100u, 200u}) {
    print.Add(Quote(std::string(length, 'w')));
    print.Add(Quote(std::string(length, 'w') + "\xc3\xa9\xc3\xa9"));
  }
  for (const char* text : {"", "a'b", "\n", "\x7f", "\xc3\xa9", "\xff", "\t\x1b[0m"}) print.Add(Quote(text));
  for (const int line : {0, 3}) {
    for (const int column : {0, 7}) {
      for (const char* file : {"", "f.txt"}) {
        const Place place{file, line, column};
        print.Add(ToString(place)).Add(ToString(Error{place, "it\nis\t\x01wrong\x7f"}));
      }
    }
  }
  EXPECT_TRUE(print.Is(4381, 3105.39825333));
}

TEST(BaseGolden, OfBytes) {
  testing::Dice dice(3);
  testing::Fingerprint print;
  std::string bytes;
  for (int i = 0; i < 50; ++i) {
    print.Add(Base64(bytes)).Add(Digest().Add(bytes).Hex());
    bytes += static_cast<char>(dice.Below(256));
  }
  for (const char* hard : {"a\nb\xc3\xa9z",
                           "\xc0\x80",
                           "\xc1\xbf",
                           "\xc2\x80",
                           "\xdf\xbf",
                           "\xe0\x9f\xbf",
                           "\xe0\xa0\x80",
                           "\xed\x9f\xbf",
                           "\xed\xa0\x80",
                           "\xee\x80\x80",
                           "\xef\xbf\xbf",
                           "\xf0\x8f\xbf\xbf",
                           "\xf0\x90\x80\x80",
                           "\xf4\x8f\xbf\xbf",
                           "\xf4\x90\x80\x80",
                           "\xf5\x80\x80\x80",
                           "\x80",
                           "\xbf",
                           "\xc3",
                           "\xe2\x82",
                           "\xe2\x28\xa1",
                           "\xf0\x9f\x90",
                           "\xf0\x9f\x28\xbb",
                           "ok\n\n \xff",
                           "\xc3\x28"}) {
    for (const std::string& text : {std::string(hard), "ab\r\nc" + std::string(hard) + "d"}) {
      const Result<void> checked = CheckUtf8(text, "f");
      print.Add(checked.has_value());
      if (!checked) print.Add(ToString(checked.error()));
    }
  }
  const Result<void> zero = CheckUtf8(std::string("a\nb\0c", 5), "f");
  print.Add(zero ? "" : ToString(zero.error()));
  Digest digest;
  digest.Add(2.5).Add(std::int64_t{-7}).Add(std::vector<double>{1, 2}).Add(std::vector<std::uint8_t>{3, 4});
  print.Add(digest.Hex()).Add(Fingerprint("text") % 1000003);
  CyclicLookup<int> lookup;
  for (int i = 0; i < 4; ++i) lookup.Add(std::string(1, static_cast<char>('a' + i)), 10 * i);
  for (const char* name : {"b", "c", "a", "a", "d", "x", "b"}) print.Add(lookup.Find(name) ? *lookup.Find(name) : -1);
  for (const auto& [name, item] : lookup) print.Add(name).Add(item);
  EXPECT_TRUE(print.Is(4403, 208745.46322));
}

}  // namespace
}  // namespace etude
