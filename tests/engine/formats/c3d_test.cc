#include "engine/formats/c3d.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr int kIntel = 84, kDec = 85, kMips = 86;

/// Writes C3D files: a second implementation, by the tables of the format's specification.
class Writer {
 public:
  Writer(int machine, bool floats) : machine_(machine), floats_(floats) {}

  std::string labels = "LSHORSHO";  ///< four letters a point
  std::size_t points = 2, frames = 3;
  double scale = 0.25;
  std::string unit = "mm";
  std::size_t second_labels_from = 0;  ///< points from here on are named by LABELS2; 0 = none
  std::size_t analogue = 0;            ///< values a frame

  /// Point p of frame f, in the file's unit; points of frame 1 are lost where p is odd.
  static glm::dvec3 PlaceOf(std::size_t f, std::size_t p) {
    return glm::dvec3(100.0 * static_cast<double>(p), 10.0 * static_cast<double>(f), -50.5);
  }

  std::string Write() const {
    std::string parameters(4, '\0');
    parameters[2] = 3;
    parameters[3] = static_cast<char>(machine_);
    Group(parameters, 1, "POINT");
    Parameter(parameters, 1, "USED", 2, {}, Word(points));
    Parameter(parameters, 1, "SCALE", 4, {}, Float(floats_ ? -scale : scale));
    Parameter(parameters, 1, "RATE", 4, {}, Float(100));
    Parameter(parameters, 1, "UNITS", -1, {unit.size()}, unit);
    Parameter(parameters, 1, "Y_SCREEN", -1, {2}, "+Z");
    const std::size_t first = second_labels_from == 0 ? points : second_labels_from;
    Parameter(parameters, 1, "LABELS", -1, {4, first}, labels.substr(0, 4 * first));
    if (first < points) Parameter(parameters, 1, "LABELS2", -1, {4, points - first}, labels.substr(4 * first));
    Parameter(parameters, 1, "DATA_START", 2, {}, Word(2 + kBlocks));
    parameters.resize(512 * kBlocks, '\0');

    std::string header(512, '\0');
    header[0] = 2;
    header[1] = 0x50;
    const auto put = [&](std::size_t at, const std::string& bytes) { header.replace(at, bytes.size(), bytes); };
    put(2, Word(points));
    put(4, Word(analogue));
    put(6, Word(1));
    put(8, Word(frames));
    put(12, Float(floats_ ? -scale : scale));
    put(16, Word(2 + kBlocks));
    put(20, Float(100));
    std::string data;
    for (std::size_t f = 0; f < frames; ++f) {
      for (std::size_t p = 0; p < points; ++p) {
        const bool is_lost = f == 1 && p % 2 == 1;
        const glm::dvec3 place = is_lost ? glm::dvec3(0) : PlaceOf(f, p);
        for (int axis = 0; axis < 3; ++axis) data += Value(floats_ ? place[axis] : std::round(place[axis] / scale));
        data += Value(is_lost ? -1 : 0);
      }
      for (std::size_t a = 0; a < analogue; ++a) data += Value(7);
    }
    return header + parameters + data;
  }

 private:
  static constexpr std::size_t kBlocks = 3;

  std::string Word(std::size_t value) const {
    const char low = static_cast<char>(value & 0xff), high = static_cast<char>(value >> 8 & 0xff);
    return machine_ == kMips ? std::string{high, low} : std::string{low, high};
  }
  std::string Float(double value) const {
    // A VAX's number has its exponent two higher, and its halves the other way round.
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(machine_ == kDec ? value * 4 : value));
    const std::size_t low = bits & 0xffff, high = bits >> 16;
    return machine_ == kIntel ? Word(low) + Word(high) : Word(high) + Word(low);
  }
  std::string Value(double value) const {
    return floats_ ? Float(value) : Word(static_cast<std::uint16_t>(static_cast<std::int16_t>(value)));
  }
  void Group(std::string& out, int id, const std::string& name) const {
    out += static_cast<char>(name.size());
    out += static_cast<char>(-id);
    out += name + Word(3) + '\0';
  }
  void Parameter(std::string& out, int id, const std::string& name, int type, const std::vector<std::size_t>& sizes,
                 const std::string& data) const {
    out += static_cast<char>(name.size());
    out += static_cast<char>(id);
    out += name + Word(2 + 2 + sizes.size() + data.size() + 1);
    out += static_cast<char>(type);
    out += static_cast<char>(sizes.size());
    for (const std::size_t size : sizes) out += static_cast<char>(size);
    out += data + '\0';
  }

  int machine_;
  bool floats_;
};

std::string Complaint(const std::string& bytes) {
  const auto read = ReadC3d(bytes, "a.c3d");
  return read ? "(read)" : ToString(read.error());
}

TEST(C3d, ReadsEveryMachineAndKindOfNumber) {
  for (const int machine : {kIntel, kDec, kMips}) {
    for (const bool floats : {false, true}) {
      Writer writer(machine, floats);
      writer.analogue = 3;
      const auto read = ReadC3d(writer.Write(), "a.c3d");
      ASSERT_TRUE(read) << machine << floats << ToString(read.error());
      EXPECT_EQ(read->markers.rate_hz, 100);
      EXPECT_EQ(read->unit, "mm");
      EXPECT_EQ(read->up, 'Z');
      EXPECT_NEAR(read->step_m, floats ? 0 : 0.25e-3, 1e-12);
      EXPECT_THAT(read->markers.names, testing::ElementsAre("LSHO", "RSHO"));
      ASSERT_EQ(read->markers.frames.size(), 3u);
      for (std::size_t f = 0; f < 3; ++f) {
        for (std::size_t p = 0; p < 2; ++p) {
          const auto& place = read->markers.frames[f][p];
          if (f == 1 && p == 1) {
            EXPECT_FALSE(place) << "a residual below zero is a gap, never the origin";
          } else {
            ASSERT_TRUE(place);
            EXPECT_LT(glm::distance(*place, 1e-3 * Writer::PlaceOf(f, p)), floats ? 1e-7 : 0.25e-3) << machine;
          }
        }
      }
    }
  }
}

TEST(C3d, ReadsMoreThan255PointsAndThoseWithoutNames) {
  Writer writer(kIntel, false);
  writer.points = 260;
  writer.second_labels_from = 130;
  writer.labels.clear();
  for (int i = 0; i < 260; ++i) writer.labels += i == 7 ? "    " : "P" + std::to_string(100 + i);
  const auto read = ReadC3d(writer.Write(), "a.c3d");
  ASSERT_TRUE(read) << ToString(read.error());
  ASSERT_EQ(read->markers.names.size(), 260u);
  EXPECT_EQ(read->markers.names[7], "point 8");
  EXPECT_EQ(read->markers.names[259], "P359");
  ASSERT_TRUE(read->markers.frames[2][30]);
  EXPECT_NEAR(read->markers.frames[2][30]->x, 3.0, 1e-9);
}

TEST(C3d, TakesWhatIsNoNumberForAGap) {
  std::string bytes = Writer(kIntel, true).Write();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  bytes.replace(bytes.size() - 16, 4, reinterpret_cast<const char*>(&nan), 4);
  const auto read = ReadC3d(bytes, "a.c3d");
  ASSERT_TRUE(read);
  EXPECT_FALSE(read->markers.frames[2][1]);
  EXPECT_TRUE(read->markers.frames[2][0]);
}

TEST(C3d, RefusesWhatIsDamaged) {
  const std::string good = Writer(kIntel, true).Write();
  EXPECT_EQ(Complaint("HIERARCHY"), "a.c3d: no C3D file");
  EXPECT_EQ(Complaint(good.substr(0, good.size() - 20)), "a.c3d: is cut short: 2 of 3 frames are there");
  std::string other = good;
  other[512 + 3] = 7;
  EXPECT_THAT(Complaint(other), HasSubstr("a machine of kind 7; allowed: 84 (Intel), 85 (DEC), 86 (MIPS)"));
  Writer furlongs(kIntel, true), none(kIntel, true), flat(kIntel, true);
  furlongs.unit = "fl";
  none.points = 0;
  flat.scale = 0;
  EXPECT_EQ(Complaint(furlongs.Write()), "a.c3d: units 'fl'; allowed: m, cm, mm, in, ft");
  EXPECT_THAT(Complaint(none.Write()), HasSubstr("holds no points"));
  EXPECT_THAT(Complaint(flat.Write()), HasSubstr("POINT:SCALE is"));
  for (std::size_t cut = 0; cut < good.size(); cut += 37) EXPECT_NE(Complaint(good.substr(0, cut)), "(read)") << cut;
}

}  // namespace
}  // namespace etude
