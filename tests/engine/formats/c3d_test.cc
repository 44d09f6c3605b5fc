#include "engine/formats/c3d.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "tests/support/c3d_writer.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::C3dWriter;
using ::testing::HasSubstr;
using testing::kDec;
using testing::kIntel;
using testing::kMips;

std::string C3dComplaint(const std::string& bytes) {
  const auto read = ReadC3d(bytes, "a.c3d");
  return read ? "(read)" : ToString(read.error());
}

TEST(C3d, ReadsEveryMachineAndKindOfNumber) {
  for (const int machine : {kIntel, kDec, kMips}) {
    for (const bool floats : {false, true}) {
      C3dWriter writer(machine, floats);
      writer.analogue = 3;
      const auto read = ReadC3d(writer.Write(), "a.c3d");
      ASSERT_TRUE(read) << machine << floats << ToString(read.error());
      EXPECT_EQ(read->markers.rate_hz, 100);
      EXPECT_EQ(read->unit, "mm");
      EXPECT_EQ(read->up, 'Z');
      EXPECT_NEAR(read->step_m, floats ? 0 : 0.25e-3, 1e-12);
      EXPECT_THAT(read->markers.names, ::testing::ElementsAre("LSHO", "RSHO"));
      ASSERT_EQ(read->markers.frames.size(), 3u);
      for (std::size_t f = 0; f < 3; ++f) {
        for (std::size_t p = 0; p < 2; ++p) {
          const auto& place = read->markers.frames[f][p];
          if (f == 1 && p == 1) {
            EXPECT_FALSE(place) << "a residual below zero is a gap, never the origin";
          } else {
            ASSERT_TRUE(place);
            EXPECT_LT(glm::distance(*place, 1e-3 * C3dWriter::PlaceOf(f, p)), floats ? 1e-7 : 0.25e-3) << machine;
          }
        }
      }
    }
  }
}

TEST(C3d, ReadsMoreThan255PointsAndThoseWithoutNames) {
  C3dWriter writer(kIntel, false);
  writer.points = 260;
  writer.second_labels_from = 130;
  writer.labels.clear();
  for (int i = 0; i < 260; ++i) writer.labels += i == 7 ? "    " : "P" + std::to_string(100 + i);
  ASSERT_OK(read, ReadC3d(writer.Write(), "a.c3d"));
  ASSERT_EQ(read->markers.names.size(), 260u);
  EXPECT_EQ(read->markers.names[7], "point 8");
  EXPECT_EQ(read->markers.names[259], "P359");
  ASSERT_TRUE(read->markers.frames[2][30]);
  EXPECT_NEAR(read->markers.frames[2][30]->x, 3.0, 1e-9);
}

TEST(C3d, HasAsManyFramesAsLongFramesTells) {
  for (const int machine : {kIntel, kDec, kMips}) {
    for (const std::size_t header_frames : {std::size_t{65535}, std::size_t{66000 % 65536}}) {
      C3dWriter writer(machine, false);
      writer.frames = 66'000;
      writer.header_frames = header_frames;
      writer.long_frames = 66'000;
      ASSERT_OK(read, ReadC3d(writer.Write(), "a.c3d"));
      EXPECT_EQ(read->markers.frames.size(), 66'000u);
      EXPECT_EQ(read->markers.remark, "");
    }
  }
}

TEST(C3d, TellsOfDataBeyondTheLastFrame) {
  C3dWriter writer(kIntel, true);
  writer.frames = 100;
  writer.header_frames = 40;
  ASSERT_OK(read, ReadC3d(writer.Write(), "a.c3d"));
  EXPECT_EQ(read->markers.frames.size(), 40u);
  EXPECT_EQ(read->markers.remark,
            "the file contains 60 frames more than the 40 that its header states; Etude did not read them");
  writer.header_frames = 100;
  std::string padded = writer.Write();
  padded.resize(padded.size() + 2000, '\0');
  EXPECT_EQ(ReadC3d(padded, "a.c3d")->markers.remark, "") << "zeros are no data";
}

TEST(C3d, HasAsManyFramesAsPointFramesTells) {
  const auto writer = [](std::size_t held, std::size_t header, std::size_t told, std::size_t trial) {
    C3dWriter one(kIntel, true);
    one.frames = held;
    one.header_frames = header;
    one.told_frames = told;
    one.trial_frames = trial;
    return one.Write();
  };
  struct Case {
    std::size_t held, header, told, trial, read;
    const char* remark;
  };
  const char* const cropped =
      "POINT:FRAMES states 20 frames, but TRIAL states 40 and the file contains 20; Etude uses the first number";
  for (const Case& one :
       {Case{40, 40, 40, 40, 40, ""}, Case{20, 20, 20, 40, 20, cropped},
        Case{20, 40, 20, 0, 20,
             "POINT:FRAMES states 20 frames, but its header states 40 and the file contains 20; "
             "Etude uses the first number"},
        Case{40, 40, 40, 20, 40,
             "POINT:FRAMES states 40 frames, but TRIAL states 20 and the file contains 40; Etude "
             "uses the first number"},
        Case{70'000, 65'535, 65'535, 70'000, 70'000, ""}, Case{70'000, 65'535, 70'000 - 65'536, 70'000, 70'000, ""}}) {
    ASSERT_OK(read, ReadC3d(writer(one.held, one.header, one.told, one.trial), "a.c3d"));
    EXPECT_EQ(read->markers.frames.size(), one.read);
    EXPECT_EQ(read->markers.remark, one.remark);
  }
  EXPECT_EQ(C3dComplaint(writer(20, 20, 40, 20)), "a.c3d: the file ends too early: it contains 20 of 40 frames");
}

TEST(C3d, LeavesOutThePointsThatAreNoPositions) {
  C3dWriter writer(kIntel, true);
  writer.points = 6;
  writer.labels = "LSHOLKNALGRFRSHOXROTCOFM";
  writer.lists = {{"ANGLES", "LKNA"}, {"POWERS", "LGRF"}, {"TURN", "XROT"}, {"BODY", "COFM"}};
  ASSERT_OK(read, ReadC3d(writer.Write(), "a.c3d"));
  EXPECT_THAT(read->markers.names, ::testing::ElementsAre("LSHO", "RSHO", "XROT", "COFM"));
  ASSERT_TRUE(read->markers.frames[2][3]);
  EXPECT_LT(glm::distance(*read->markers.frames[2][3], 1e-3 * C3dWriter::PlaceOf(2, 5)), 1e-7) << "its own position";
  writer.types = "Angle   TURN    MARKER  BODY    ";
  EXPECT_THAT(ReadC3d(writer.Write(), "a.c3d")->markers.names, ::testing::ElementsAre("LSHO", "RSHO", "COFM"));
  writer.lists.push_back({"SCALARS", writer.labels});
  EXPECT_THAT(C3dComplaint(writer.Write()), HasSubstr("contains no points (Etude does not read angles, forces and"));
}

TEST(C3d, TakesWhatIsNoNumberForAGap) {
  std::string bytes = C3dWriter(kIntel, true).Write();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  bytes.replace(bytes.size() - 16, 4, reinterpret_cast<const char*>(&nan), 4);
  ASSERT_OK(read, ReadC3d(bytes, "a.c3d"));
  EXPECT_FALSE(read->markers.frames[2][1]);
  EXPECT_TRUE(read->markers.frames[2][0]);
}

TEST(C3d, TakesNoMoreNamesThanThereArePoints) {
  std::string bytes = C3dWriter(kIntel, true).Write();
  bytes[bytes.find("LABELS") + 9] = 7;  // dimensions with a product of about 10¹⁰
  ASSERT_OK(read, ReadC3d(bytes, "a.c3d"));
  EXPECT_EQ(read->markers.names.size(), 2u);
}

TEST(C3d, RefusesWhatIsDamaged) {
  const std::string good = C3dWriter(kIntel, true).Write();
  EXPECT_EQ(C3dComplaint("HIERARCHY"), "a.c3d: no C3D file");
  EXPECT_EQ(C3dComplaint(good.substr(0, good.size() - 20)),
            "a.c3d: the file ends too early: it contains 2 of 3 frames");
  std::string other = good;
  other[512 + 3] = 7;
  EXPECT_THAT(C3dComplaint(other), HasSubstr("the processor type is 7; allowed: 84 (Intel), 85 (DEC), 86 (MIPS)"));
  C3dWriter furlongs(kIntel, true), none(kIntel, true), flat(kIntel, true);
  furlongs.unit = "fl";
  none.points = 0;
  flat.scale = 0;
  EXPECT_EQ(C3dComplaint(furlongs.Write()), "a.c3d: units are 'fl'; allowed: m, cm, mm, in, ft");
  EXPECT_THAT(C3dComplaint(none.Write()), HasSubstr("contains no points"));
  EXPECT_THAT(C3dComplaint(flat.Write()), HasSubstr("POINT:SCALE is"));
  for (std::size_t cut = 0; cut < good.size(); cut += 37) EXPECT_NE(C3dComplaint(good.substr(0, cut)), "(read)") << cut;
}

TEST(C3d, ARateOfZeroIsReplacedByTheHeadersRate) {
  const std::string good = C3dWriter(kIntel, true).Write();
  std::string without = good, none = good;
  without.replace(good.find("RATE") + 8, 4, 4, '\0');
  none = without;
  none.replace(20, 4, 4, '\0');
  ASSERT_OK(read, ReadC3d(without, "a.c3d"));
  EXPECT_EQ(read->markers.rate_hz, 100);
  EXPECT_EQ(read->markers.remark, "POINT:RATE is 0; Etude uses the header's rate, 100 Hz");
  EXPECT_EQ(C3dComplaint(none), "a.c3d: the rate is 0 Hz; allowed: above 0");
}

TEST(C3d, UnitsMayBeNamedInTheSingular) {
  for (const auto& [unit, metres] :
       {std::pair("Meter", 1.0), {"inch", 0.0254}, {"Millimetre", 0.001}, {"foot", 0.3048}}) {
    C3dWriter writer(kIntel, true);
    writer.unit = unit;
    ASSERT_OK(read, ReadC3d(writer.Write(), "a.c3d"));
    EXPECT_NEAR(read->markers.frames[0][0]->z, -50.5 * metres, 1e-6) << unit;
  }
}

/// Returns markers of which every seventh is unseen in the second frame.
MarkerMotion SomeMarkers(std::size_t markers, std::size_t frames) {
  MarkerMotion motion{.rate_hz = 120, .names = {}, .frames = {}};
  for (std::size_t p = 0; p < markers; ++p) motion.names.push_back("marker" + std::to_string(p));
  for (std::size_t f = 0; f < frames; ++f) {
    auto& frame = motion.frames.emplace_back();
    for (std::size_t p = 0; p < markers; ++p) {
      frame.emplace_back(glm::dvec3(0.001 * static_cast<double>(p), 1.25, -0.5 * static_cast<double>(f)));
      if (f == 1 && p % 7 == 3) frame.back().reset();
    }
  }
  return motion;
}

TEST(WriteC3d, IsReadBackWithItsGapsWhateverTheNumberOfMarkersAndFrames) {
  for (const auto& [markers, frames] : {std::pair(1u, 2u), {20u, 40u}, {255u, 3u}, {600u, 2u}, {1u, 70000u}}) {
    const MarkerMotion motion = SomeMarkers(markers, frames);
    const std::string bytes = WriteC3d(motion);
    EXPECT_EQ(bytes.size() % 512, 0u) << "whole blocks";
    EXPECT_TRUE(IsC3d(bytes));
    const auto read = ReadC3d(bytes, "w.c3d");
    ASSERT_TRUE(read) << markers << " markers: " << ToString(read.error());
    EXPECT_EQ(read->markers.names, motion.names);
    EXPECT_EQ(read->markers.rate_hz, 120);
    EXPECT_EQ(read->unit, "mm");
    EXPECT_EQ(read->up, 'Y');
    EXPECT_EQ(read->step_m, 0);
    ASSERT_EQ(read->markers.frames.size(), frames);
    for (std::size_t f = 0; f < frames; f += 1 + frames / 8) {
      for (std::size_t p = 0; p < markers; ++p) {
        const auto &found = read->markers.frames[f][p], &wanted = motion.frames[f][p];
        ASSERT_EQ(found.has_value(), wanted.has_value());
        EXPECT_LT(wanted ? glm::distance(*found, *wanted) / (1 + glm::length(*wanted)) : 0, 1e-6);
      }
    }
  }
}

/// Positions and values by the format's specification (c3d.org), byte by byte.
TEST(WriteC3d, HasTheHeaderThatTheFormatPrescribes) {
  const std::string bytes = WriteC3d(SomeMarkers(3, 5));
  const auto word = [&](std::size_t n) {
    return static_cast<unsigned char>(bytes[2 * n - 2]) + 256 * static_cast<unsigned char>(bytes[2 * n - 1]);
  };
  EXPECT_EQ(word(1), 0x5002) << "parameters begin in the second block";
  EXPECT_EQ(word(2), 3) << "points";
  EXPECT_EQ(word(3), 0) << "analogue values";
  EXPECT_EQ(word(4), 1) << "first frame";
  EXPECT_EQ(word(5), 5) << "last frame";
  EXPECT_EQ(word(6), 0) << "no gap is filled";
  const auto blocks = static_cast<unsigned char>(bytes[512 + 2]);
  EXPECT_EQ(word(9), 2 + blocks) << "data begin behind the parameters";
  EXPECT_EQ(bytes[512 + 3], 84) << "Intel";
  float rate = 0;
  std::memcpy(&rate, &bytes[20], sizeof rate);
  EXPECT_EQ(rate, 120);
  EXPECT_EQ(bytes.size(), 512u * (1 + blocks + 1)) << "3 points of 16 bytes in 5 frames take a block";
  EXPECT_NE(bytes.find("UNITS"), std::string::npos);
}

TEST(ReadC3d, TellsTheTimeOfItsFirstFrame) {
  std::string bytes = WriteC3d(SomeMarkers(3, 5));
  ASSERT_OK(read, ReadC3d(bytes, "a.c3d"));
  EXPECT_EQ(read->markers.start_s, 0);
  // Frames 61 to 65. A parameter's name is followed by its offset, type, dimensions, and two words.
  for (const auto& [name, frame] : {std::pair<std::string, char>("ACTUAL_START_FIELD", 61), {"ACTUAL_END_FIELD", 65}}) {
    const std::size_t at = bytes.find(name);
    ASSERT_NE(at, std::string::npos);
    bytes[at + name.size() + 5] = frame;
  }
  ASSERT_OK(cut, ReadC3d(bytes, "a.c3d"));
  EXPECT_EQ(cut->markers.frames.size(), 5u);
  EXPECT_NEAR(cut->markers.start_s.value_or(0), 60 / cut->markers.rate_hz, 1e-9);
}

TEST(WriteC3d, CutsNamesThatAreTooLong) {
  MarkerMotion motion = SomeMarkers(2, 1);
  motion.names[1] = std::string(200, 'n');
  EXPECT_EQ(ReadC3d(WriteC3d(motion), "w.c3d")->markers.names[1], std::string(127, 'n'));
}

}  // namespace
}  // namespace etude
