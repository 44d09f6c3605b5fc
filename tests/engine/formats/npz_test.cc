#include "engine/formats/npz.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <functional>

#include "engine/base/angles.h"
#include "engine/formats/amass.h"
#include "engine/formats/motive_csv.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Returns an .npy file of format version 1 or 2.
template <typename Number>
std::string NpyOf(const std::string& type, const std::string& shape, const std::vector<Number>& numbers,
                  int version = 1, const std::string& fortran = "False") {
  const std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + fortran + ", 'shape': (" + shape + "), }\n";
  std::string bytes = "\x93NUMPY";
  bytes += static_cast<char>(version);
  bytes += '\0';
  for (int i = 0; i < (version == 1 ? 2 : 4); ++i) bytes += static_cast<char>(header.size() >> (8 * i) & 255);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
  return bytes;
}

template <typename Number>
void ExpectRead(const std::string& type, const std::vector<Number>& numbers) {
  for (const int version : {1, 2}) {
    const auto read = ReadNpy(NpyOf(type, std::to_string(numbers.size()) + ",", numbers, version), "a.npy");
    ASSERT_TRUE(read) << type << ToString(read.error());
    EXPECT_THAT(read->shape, ElementsAre(numbers.size()));
    EXPECT_EQ(read->values, std::vector<double>(numbers.begin(), numbers.end())) << type;
  }
}

TEST(Npy, ReadsEveryKindOfNumber) {
  ExpectRead<double>("<f8", {1.5, -2e300, 0});
  ExpectRead<float>("<f4", {1.5f, -0.25f});
  ExpectRead<std::int64_t>("<i8", {1, -70000000000, 3});
  ExpectRead<std::int32_t>("<i4", {-5, 70000});
  ExpectRead<std::uint32_t>("<u4", {4000000000u, 1});
  ExpectRead<std::int16_t>("<i2", {-300, 7});
  ExpectRead<std::uint64_t>("<u8", {1u << 31, 5});
  ExpectRead<std::uint16_t>("<u2", {65535, 7});
  ExpectRead<std::int8_t>("|i1", {-3, 100});
  ExpectRead<std::uint8_t>("|u1", {200, 1});
  ExpectRead<std::uint8_t>("|b1", {1, 0, 1});
}

TEST(Npy, ReadsHalfPrecisionAndBigEndianNumbers) {
  // IEEE 754: 1, -2, the largest, the smallest normal and the smallest subnormal number, infinity.
  const auto half = ReadNpy(NpyOf<std::uint16_t>("<f2", "6,", {0x3c00, 0xc000, 0x7bff, 0x0400, 0x0001, 0xfc00}), "a.npy");
  EXPECT_THAT(half->values, ElementsAre(1, -2, 65504, std::ldexp(1, -14), std::ldexp(1, -24), -INFINITY));
  EXPECT_TRUE(std::isnan(ReadNpy(NpyOf<std::uint16_t>("<f2", "1,", {0x7e00}), "a.npy")->values[0]));
  // 1.0 and 258, most significant byte first.
  EXPECT_THAT(ReadNpy(NpyOf<std::uint8_t>(">f8", "1,", {0x3f, 0xf0, 0, 0, 0, 0, 0, 0}), "a.npy")->values, ElementsAre(1));
  EXPECT_THAT(ReadNpy(NpyOf<std::uint8_t>(">i2", "2,", {1, 2, 0xff, 0xff}), "a.npy")->values, ElementsAre(258, -1));
}

TEST(Npy, PutsFortransOrderRight) {
  // Element (i, j, k) of 2 × 3 × 2 is 100 i + 10 j + k; in Fortran order the first index varies fastest.
  std::vector<double> fortran, c;
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 2; ++i) fortran.push_back(100 * i + 10 * j + k);
    }
  }
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 2; ++k) c.push_back(100 * i + 10 * j + k);
    }
  }
  ASSERT_OK(read, ReadNpy(NpyOf<double>("<f8", "2, 3, 2", fortran, 1, "True"), "a.npy"));
  EXPECT_THAT(read->shape, ElementsAre(2, 3, 2));
  EXPECT_EQ(read->values, c);
  EXPECT_EQ(ReadNpy(NpyOf<double>("<f8", "2, 3, 2", c), "a.npy")->values, c);
  const auto one = ReadNpy(NpyOf<double>("<f8", "", {7}), "a.npy");
  EXPECT_TRUE(one->shape.empty()) << "one number";
  EXPECT_THAT(one->values, ElementsAre(7));
}

TEST(Npy, RefusesWhatIsDamagedOrNoNumbers) {
  const auto reason = [](const std::string& bytes) {
    const auto read = ReadNpy(bytes, "a.npy");
    return read ? std::string("(read)") : ToString(read.error());
  };
  const std::string good = NpyOf<double>("<f8", "2,", {1, 2});
  EXPECT_EQ(reason(good), "(read)");
  EXPECT_TRUE(IsNpy(good));
  EXPECT_FALSE(IsNpy(good.substr(1)));
  EXPECT_THAT(reason(good.substr(1)), HasSubstr("is not a .npy file"));
  EXPECT_THAT(reason(good.substr(0, 11)), HasSubstr("is not a .npy file"));
  EXPECT_THAT(reason(good.substr(0, 40)), HasSubstr("the array's header ends too early"));
  EXPECT_THAT(reason(good.substr(0, good.size() - 8)), HasSubstr("the array has 1 numbers, but its shape requires 2"));
  EXPECT_THAT(reason(NpyOf<double>("<f8", "two", {1, 2})), HasSubstr("its shape is 'two'"));
  EXPECT_THAT(reason(NpyOf<double>("<f8", "536870912, 2", {1, 2})), HasSubstr("the array has more numbers than Etude "
                                                                              "can read"));
  for (const char* type : {"|O", "<c8", "<U4"}) {
    EXPECT_THAT(reason(NpyOf<double>(type, "2,", {1, 2})), HasSubstr("the array contains other data than numbers"))
        << type;
  }
}

TEST(Npz, ReadsWhatItWroteAndPassesTextsOver) {
  const std::map<std::string, NumberArray> numbers = {{"a", {{2, 3}, {1, 2, 3, 4, 5, 6.5}}}, {"rate", {{}, {30}}}};
  const std::string bytes = WriteNpz(numbers, {{"names", {"hip", "shoulder"}}});
  EXPECT_TRUE(IsZip(bytes));
  ASSERT_OK(read, ReadNpz(bytes, "a.npz"));
  ASSERT_EQ(read->arrays.size(), 2u);
  for (const auto& [name, array] : numbers) {
    EXPECT_EQ(read->arrays.at(name).shape, array.shape);
    EXPECT_EQ(read->arrays.at(name).values, array.values);
  }
  EXPECT_THAT(read->skipped, ElementsAre("names"));
  std::string damaged = bytes;
  const double value = 6.5;
  damaged[damaged.find(std::string(reinterpret_cast<const char*>(&value), sizeof value)) + 6] ^= 1;
  EXPECT_THAT(ToString(ReadNpz(damaged, "a.npz").error()), HasSubstr("is damaged")) << "the sum tells";
  EXPECT_THAT(ToString(ReadNpz(bytes.substr(0, bytes.size() / 2), "a.npz").error()), HasSubstr("not a readable ZIP file"));
}

/// Returns two frames of SMPL's joints; the pelvis is turned so that the body stands along the file's Z.
Npz SmallAmass(std::size_t width) {
  Npz npz;
  npz.arrays["poses"] = {{2, width}, std::vector<double>(2 * width)};
  npz.arrays["trans"] = {{2, 3}, {1, 2, 3, 4, 5, 6}};
  npz.arrays[width == 156 ? "mocap_framerate" : "mocap_frame_rate"] = {{}, {120}};
  for (const std::size_t frame : {0u, 1u}) npz.arrays["poses"].values[frame * width] = kPi / 2;
  npz.arrays["poses"].values[width + 3 * 18 + 2] = kPi / 2;  // left elbow of the second frame, about the body's Z
  return npz;
}

TEST(Amass, TurnsOurTPoseAsTheArraysSay) {
  for (const std::size_t width : {156u, 165u}) {
    ASSERT_OK(clip, ReadAmass(SmallAmass(width), "a.npz"));
    EXPECT_EQ(clip->rate_hz, 120);
    ASSERT_EQ(clip->frames.size(), 2u);
    std::vector<GlobalTransform> globals;
    const auto at = [&](const char* joint) {
      return globals[static_cast<std::size_t>(clip->skeleton.Find(joint))].position;
    };
    ComputeGlobals(clip->skeleton, clip->frames[0], globals);
    EXPECT_LT(glm::distance(at("left_ankle"), glm::dvec3(1.09, 2, 3 - 0.06 - 0.4165 - 0.418)), 1e-12);
    EXPECT_LT(glm::distance(at("left_wrist"), glm::dvec3(1 + 0.07 + 0.11 + 0.55, 2, 3 + 0.28 + 0.16)), 1e-12);
    EXPECT_LT(glm::distance(at("right_wrist"), glm::dvec3(1 - 0.07 - 0.11 - 0.55, 2, 3 + 0.28 + 0.16)), 1e-12);
    ComputeGlobals(clip->skeleton, clip->frames[1], globals);
    EXPECT_LT(glm::distance(at("left_wrist"), glm::dvec3(4 + 0.07 + 0.11 + 0.30, 5, 6 + 0.28 + 0.16 + 0.25)), 1e-12);
    EXPECT_LT(glm::distance(at("pelvis"), glm::dvec3(4, 5, 6)), 1e-12);
  }
}

TEST(Amass, TakesTheRateThatIsToldAndRefusesNone) {
  Npz npz = SmallAmass(156);
  EXPECT_EQ(ReadAmass(npz, "a.npz", 50)->rate_hz, 50);
  npz.arrays.erase("mocap_framerate");
  EXPECT_EQ(ReadAmass(npz, "a.npz", 50)->rate_hz, 50);
  EXPECT_THAT(testing::Refusal(ReadAmass(npz, "a.npz")),
              HasSubstr("states no frame rate (its arrays: poses, trans); allowed: the array mocap_framerate"));
}

TEST(Amass, TakesTimesAndJointsByThemselves) {
  const Npz usual = SmallAmass(156);
  ASSERT_OK(wanted, ReadAmass(usual, "a.npz"));
  Npz npz = usual;
  npz.arrays["poses"].shape = {2, 52, 3};
  ASSERT_OK(same, ReadAmass(npz, "a.npz"));
  EXPECT_EQ(same->frames, wanted->frames);
  // Times overrule the rate, which is 120 Hz.
  npz.arrays["times"] = {.shape = {2}, .values = {3, 3.5}};
  npz.arrays.erase("mocap_framerate");
  EXPECT_EQ(ReadAmass(npz, "a.npz")->rate_hz, 2);
  npz.arrays["times"].values = {3, 3};
  EXPECT_THAT(testing::Refusal(ReadAmass(npz, "a.npz")), HasSubstr("all times in the array times are equal"));
}

TEST(Amass, RefusesArraysThatAreNoMotion) {
  const auto reason = [](const std::function<void(Npz&)>& change) {
    Npz npz = SmallAmass(156);
    change(npz);
    const auto clip = ReadAmass(npz, "a.npz");
    return clip ? std::string("(read)") : ToString(clip.error());
  };
  EXPECT_EQ(reason([](Npz&) {}), "(read)");
  EXPECT_THAT(reason([](Npz& npz) { npz.arrays.erase("trans"); }),
              HasSubstr("found the arrays mocap_framerate, poses; allowed: the arrays of AMASS"));
  EXPECT_THAT(reason([](Npz& npz) {
                npz.arrays.clear();
                for (char name = 'a'; name <= 'y'; ++name) npz.arrays[std::string(1, name)] = {};
              }),
              HasSubstr("the arrays a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t and 5 more; allowed:"));
  EXPECT_THAT(reason([](Npz& npz) {
                npz.arrays["poses"].shape = {4, 78};
              }),
              HasSubstr("poses, frames × 72, 156 or 165"));
  EXPECT_THAT(reason([](Npz& npz) {
                npz.arrays["trans"] = {{1, 3}, {1, 2, 3}};
              }),
              HasSubstr("the array trans has 1 frames, but the array poses has 2"));
  EXPECT_THAT(reason([](Npz& npz) { npz.arrays["poses"] = {{0, 156}, {}}; }), HasSubstr("no frames"));
  EXPECT_THAT(reason([](Npz& npz) { npz.arrays["mocap_framerate"].values = {0.5}; }), HasSubstr("the rate is 0.5 Hz"));
  EXPECT_EQ(reason([](Npz& npz) { npz.arrays["mocap_framerate"].values = {10000}; }), "(read)");
  EXPECT_THAT(reason([](Npz& npz) { npz.arrays["mocap_framerate"].values = {10001}; }),
              HasSubstr("mocap_framerate is 10001; allowed: 0.1 to 10000 Hz"));
  EXPECT_THAT(reason([](Npz& npz) { npz.arrays["trans"].values[4] = 2e6; }),
              HasSubstr("array trans, frame 1: found 2000000"));
  EXPECT_THAT(reason([](Npz& npz) { npz.arrays["poses"].values[3] = NAN; }),
              HasSubstr("array poses, frame 0: found nan"));
  EXPECT_THAT(
      reason([](Npz& npz) { npz.arrays["poses"].values[156 + 4] = -90; }),
      HasSubstr(
          "in frame 1, the array poses rotates left_hip by 90 radians; allowed: at most 12.57 (4π); are the values "
          "degrees?"));
}

std::string MotiveTake(const std::string& unit = "Centimeters", const std::string& type = "Bone") {
  return "Format Version,1.23,Take Name,t,Capture Frame Rate,120.0,Export Frame Rate,60.0,Length Units," + unit +
         ",Coordinate Space,Global\r\n\r\n" + ",Type," + type + "," + type + "," + type + "," + type +
         ",Marker,Marker,Marker\r\n" + ",Name,\"A:Hip\",\"A:Hip\",\"A:Hip\",\"A:Hip\",m1,m1,m1\r\n,ID,,,,,,,\r\n" +
         ",,Rotation,Position,Position,Position,Position,Position,Position\r\n" +
         "Frame,Time (Seconds),X,X,Y,Z,X,Y,Z\r\n" + "0,0.0,9,10,20,-30,1,2,3\r\n" +
         "1,0.016667,9,,20,-30,4,5,6\r\n\r\n";
}

TEST(MotiveCsv, ReadsBonesInMetresAndLeavesGaps) {
  for (const auto& [unit, metres] : {std::pair("Meters", 1.0), {"Centimeters", 0.01}, {"Millimeters", 0.001}}) {
    ASSERT_OK(read, ReadMotiveCsv(MotiveTake(unit), "a.csv"));
    EXPECT_EQ(read->rate_hz, 60);
    EXPECT_THAT(read->names, ElementsAre("A:Hip"));
    ASSERT_EQ(read->frames.size(), 2u);
    ASSERT_TRUE(read->frames[0][0]);
    EXPECT_LT(glm::distance(*read->frames[0][0], metres * glm::dvec3(10, 20, -30)), 1e-12);
    EXPECT_FALSE(read->frames[1][0]) << "no X";
  }
  ASSERT_OK(markers, ReadMotiveCsv(MotiveTake("Meters", "Rigid Body"), "a.csv"));
  EXPECT_THAT(markers->names, ElementsAre("m1")) << "markers where no bone is";
  EXPECT_EQ(markers->frames[1][0], glm::dvec3(4, 5, 6));
  EXPECT_TRUE(IsMotiveCsv(MotiveTake()));
  EXPECT_TRUE(IsMotiveCsv("\xEF\xBB\xBF" + MotiveTake()));
  EXPECT_FALSE(IsMotiveCsv("Frame,Time"));
}

TEST(MotiveCsv, TakesTheRateThatIsTold) {
  const auto reason = [](const std::string& from, const std::string& to) {
    const auto read = ReadMotiveCsv(testing::Replaced(MotiveTake(), from, to), "a.csv");
    return read ? std::string("(read)") : ToString(read.error());
  };
  EXPECT_EQ(reason("Export Frame Rate,60.0", "Export Frame Rate,"), "(read)") << "Capture Frame Rate counts";
  EXPECT_THAT(reason("Export Frame Rate,60.0", "Export Frame Rate,20000"),
              HasSubstr("'Export Frame Rate' is missing or out of range; allowed: above 0, up to 10000 Hz"));
}

}  // namespace
}  // namespace etude
