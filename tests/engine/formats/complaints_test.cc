// The error messages of file readers about texts with one damage, and how often they accept such texts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "engine/formats/acclaim.h"
#include "engine/formats/amass.h"
#include "engine/formats/bvh.h"
#include "engine/formats/c3d.h"
#include "engine/formats/deepmimic.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/kinect_text.h"
#include "engine/formats/motive_csv.h"
#include "engine/formats/npz.h"
#include "engine/formats/number_rows.h"
#include "engine/formats/rigid_targets.h"
#include "engine/formats/trc.h"
#include "engine/formats/unique_names.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

using testing::ComplaintLines;
using testing::SpoiltBytes;
using testing::SpoiltTexts;

template <typename T>
using ReadText = Result<T> (*)(std::string_view, const std::string&);

/// Wraps `read` for texts that belong to a file of this name.
template <typename T>
auto From(const std::string& file, ReadText<T> read) {
  return [file, read](const std::string& text) { return read(text, file); };
}

/// A result must be finite, and a refusal must have a place.
Result<Clip> ReadBvhText(const std::string& text) {
  auto clip = ReadBvh(text, "a.bvh");
  std::vector<GlobalTransform> globals;
  for (std::size_t f = 0; clip && f < clip->frames.size(); ++f) {
    ComputeGlobals(clip->skeleton, clip->frames[f], globals);
    for (const GlobalTransform& global : globals) EXPECT_TRUE(testing::IsFinite(global.position)) << text;
  }
  EXPECT_TRUE(clip || (clip.error().place.line > 0 && clip.error().place.column > 0)) << ToString(clip.error());
  return clip;
}

TEST(Formats, BvhComplaintsAreAsTheyWere) {
  const std::string habits =
      "\xEF\xBB\xBFHIERARCHY\r\nROOT Hips\r\n{\r\n\tOFFSET 0 0 0\r\n\tCHANNELS 6 Xposition Yposition Zposition "
      "Yrotation "
      "Xrotation Zrotation\r\n\tJoint Left Up:Leg\r\n\t{\r\n\t\toffset 1.5 -2 0.25\r\n\t\tCHANNELS 3 Zrotation "
      "Yrotation "
      "Xrotation\r\n\t\tEnd Site\r\n\t\t{\r\n\t\t\tOFFSET 0 -4 1\r\n\t\t}\r\n\t}\r\n\tJOINT Left "
      "Up:Leg\r\n\t{\r\n\t\tOFFSET 3 "
      "0 0\r\n\t\tCHANNELS 1 Xrotation\r\n\t}\r\n}\r\nMOTION\r\nFrames: 3\r\nFrame Time: .0083333\r\n"
      "1 2 3 10 20 30 5 15 25 7\r\n4 5 6 -10 200 3 0 1 2 8\r\n4.5 5 6 -10 200 3 0 1 2 -9e1\r\n";
  const std::string zeros =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Xposition Yposition Zposition\nJOINT b\n{\nOFFSET 0 0 0\n"
      "CHANNELS 6 Xposition Yposition Zposition Xrotation Yrotation Zrotation\n}\n}\nMOTION\nFrames: 2\nFrame Time: "
      "0.04\n1 2 3 4 5 6 7 8 9\n1 2 4 4 5 7 7 8 0\n7 8 9 1 2 3 4 5 6\n";
  std::vector<std::string> times;
  for (const char* time : {"0.0001", "0.00009", "10", "10.1", "0.0333333", "0.03336", "0.0333367", "1"}) {
    times.push_back(zeros);
    times.back().replace(zeros.find("0.04"), 4, time);
  }
  ComplaintLines complaints;
  complaints.Add("habits", SpoiltTexts(habits, 1, 700), ReadBvhText);
  complaints.Add("zeros", SpoiltTexts(zeros, 2, 300), ReadBvhText);
  complaints.Add("frame times", times, ReadBvhText);
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/formats/bvh_complaints.txt"));
}

TEST(Formats, BvhIsReadUpToItsLimits) {
  const auto nested = [](int levels) {
    std::string text = "HIERARCHY\nROOT r\n{\nOFFSET 0 1 0\nCHANNELS 1 Xrotation\n", ends;
    for (int level = 0; level < levels; ++level) {
      text += fmt::format("JOINT j{}\n{{\nOFFSET 0 1 0\n", level);
      ends += "}\n";
    }
    return text + ends + "}\nMOTION\nFrames: 1\nFrame Time: 1\n0\n";
  };
  const auto wide = [](int joints) {
    std::string text = "HIERARCHY\nROOT r\n{\nOFFSET 0 1 0\nCHANNELS 1 Xrotation\n";
    for (int joint = 0; joint < joints; ++joint) text += fmt::format("JOINT j{}\n{{\nOFFSET 0 1 0\n}}\n", joint);
    return text + "}\nMOTION\nFrames: 1\nFrame Time: 1\n0\n";
  };
  for (const int levels : {126, 127, 128, 129})
    EXPECT_EQ(ReadBvhText(nested(levels)).has_value(), levels < 128) << levels;
  for (const int joints : {1022, 1023, 1024}) EXPECT_EQ(ReadBvhText(wide(joints)).has_value(), joints < 1024) << joints;
  for (const std::size_t length : {499u, 500u, 501u}) {
    std::string text = wide(1);
    text.replace(text.find("j0"), 2, std::string(length, 'n'));
    EXPECT_EQ(ReadBvhText(text).has_value(), length < 501) << length;
  }
}

TEST(Formats, AcclaimComplaintsAreAsTheyWere) {
  const std::string skeleton =
      "# a remark\n:version 1.10\n:name VICON\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n:documentation\n  none\n"
      ":root\n   order TX TY TZ RX RY RZ\n   axis XYZ\n   position 0 1 0\n   orientation 10 20 30\n:bonedata\n  begin\n"
      "    id 1\n    name upper\n    direction 1 0.5 0\n    length 2\n    axis 0 20 90 XYZ\n    dof rx ry rz\n"
      "    limits (-160 20)\n           (-70 70)\n  end\n  begin\n    name lower\n    direction 0 0 -1\n    length 3\n"
      "    axis 5 6 7 ZYX\n    dof rz\n  end\n  begin\n    name tip\n    direction 0 1 0\n    length 0.5\n    axis 0 0 "
      "0 "
      "XYZ\n  end\n:hierarchy\n  begin\n    root upper\n    upper lower tip\n  end\n";
  const std::string motion =
      "#!OML:ASF\n:FULLY-SPECIFIED\n:DEGREES\n1\nroot 5 1 2 10 20 30\nupper 90 5 -5\nlower 12\n2\nroot 0 0 0 0 0 90\n"
      "upper 0 1 2\nlower -3\n3\nlower 4\n";
  AcclaimSkeleton read = ReadAcclaimSkeleton(skeleton, "a.asf").value();
  const auto motion_of = [&](const std::string& text) { return ReadAcclaimMotion(text, read, "a.amc"); };
  ComplaintLines complaints;
  complaints.Add("asf", SpoiltTexts(skeleton, 3, 600), From("a.asf", ReadAcclaimSkeleton));
  complaints.Add("amc", SpoiltTexts(motion, 4, 300), motion_of);
  read.in_degrees = false;
  complaints.Add("amc in radians", SpoiltTexts(motion, 4, 300), motion_of);
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/formats/acclaim_complaints.txt"));
}

MarkerMotion OddMarkers() {
  testing::Dice dice(5);
  MarkerMotion markers{
      .rate_hz = 60, .names = {"Ann:LASI", "RASI", "a very long name of a marker", "", "x\ty"}, .frames = {}};
  for (int f = 0; f < 7; ++f) {
    auto& frame = markers.frames.emplace_back();
    for (int i = 0; i < 5; ++i) {
      const glm::dvec3 place = 3.0 * dice.Vector();
      frame.push_back(dice.Below(6) == 0 ? std::nullopt : std::optional(place));
    }
  }
  return markers;
}

BodyMotion SomeBody(double rate_hz) {
  testing::Dice dice(6);
  BodyMotion motion{.rate_hz = rate_hz, .poses = std::vector<BodyPose>(5)};
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint = dice.Vector();
  }
  return motion;
}

TEST(Formats, MarkerComplaintsAreAsTheyWere) {
  ComplaintLines complaints;
  complaints.Add("c3d", SpoiltBytes(WriteC3d(OddMarkers()), 7, 500), From("a.c3d", ReadC3d));
  for (const int machine : {testing::kIntel, testing::kDec, testing::kMips, 87}) {
    for (const bool floats : {false, true}) {
      testing::C3dWriter writer(machine, floats);
      writer.analogue = 3;
      writer.points = 5;
      writer.labels = "AAAABBBBCCCCDDDD    ";
      writer.second_labels_from = 3;
      std::vector<std::string> units;
      for (const char* unit : {"m", "cm", "mm", "ft", "", "mi", "MM", "in"}) {
        writer.unit = unit;
        units.push_back(writer.Write());
      }
      const std::string what = fmt::format("c3d of machine {}{}", machine, floats ? ", floats" : "");
      complaints.Add(what + ", any unit", units, From("a.c3d", ReadC3d));
      complaints.Add(what, SpoiltBytes(units.back(), 8, 150), From("a.c3d", ReadC3d));
    }
  }
  for (const std::string& text : {WriteTrc(OddMarkers(), "a\tb"), WriteTrc(SomeBody(24), "b")}) {
    complaints.Add("trc", SpoiltTexts(text, 9, 300), From("a.trc", ReadTrc));
  }
  for (const auto& [step, rows] : {std::pair{0.0158, 40},
                                   {0.0159, 40},
                                   {0.0175, 40},
                                   {0.0176, 40},
                                   {0.03, 17},
                                   {0.03, 30},
                                   {0.0, 30},
                                   {-0.02, 30}}) {
    const std::vector frames(rows, std::vector{std::optional(glm::dvec3(1))});
    const std::string text = WriteTrc(MarkerMotion{.rate_hz = 60, .names = {"a"}, .frames = frames}, "a");
    std::string told = text.substr(0, text.find("\n1\t") + 1);
    for (int row = 0; row < rows; ++row) told += fmt::format("{}\t{:.6f}\t1000\t1000\t1000\n", row + 1, step * row);
    complaints.Add(fmt::format("{} rows every {} s", rows, step), std::vector{told}, From("a.trc", ReadTrc));
  }
  const std::string take =
      "Format Version,1.23,Take Name,t,Capture Frame Rate,120.0,Export Frame Rate,60.0,Length Units,Centimeters,"
      "Coordinate Space,Global\r\n\r\n,Type,Bone,Bone,Bone,Bone,Marker,Marker,Marker\r\n,Name,\"A:Hip\",\"A:Hip\","
      "\"A:Hip\",\"A:Hip\",m1,m1,m1\r\n,ID,,,,,,,\r\n,,Rotation,Position,Position,Position,Position,Position,"
      "Position\r\n"
      "Frame,Time (Seconds),X,X,Y,Z,X,Y,Z\r\n0,0.0,9,10,20,-30,1,2,3\r\n1,0.016667,9,,20,-30,4,5,6\r\n\r\n";
  complaints.Add("motive", SpoiltTexts(take, 10, 500), From("a.csv", ReadMotiveCsv));
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/formats/marker_complaints.txt"));
}

TEST(Formats, RefuseTextsOfMoreThan64MiB) {
  const std::string text((std::size_t{64} << 20) + 1, ' ');
  const std::string_view longest = std::string_view(text).substr(1);
  for (const std::string_view some : {std::string_view(text), longest}) {
    const bool is_refused = some.size() > longest.size();
    const auto tells = [&](const auto& read, const std::string& size) {
      return !read && (ToString(read.error()).find(size) != std::string::npos) == is_refused;
    };
    EXPECT_TRUE(tells(ReadTrc(some, "a.trc"), "67108864"));
    EXPECT_TRUE(tells(ReadMotiveCsv(some, "a.csv"), "67108864"));
    EXPECT_TRUE(tells(ReadNumberRows(some, "a.txt"), "67108864"));
  }
  EXPECT_EQ(ToString(ReadDeepMimicMotion(text, "a.txt").error()), "a.txt: found 64 MiB; allowed: at most 64 MiB");
}

TEST(Formats, ComplaintsAboutArraysAndRowsAreAsTheyWere) {
  testing::Dice dice(11);
  const auto motion = [&](int width, double duration) {
    std::string text = "{\"Loop\": \"wrap\",\n\"Frames\":\n[\n";
    for (int f = 0; f < 4; ++f) {
      text += fmt::format("[{}", f == 3 ? 0 : duration);
      for (int i = 1; i < width; ++i) text += fmt::format(", {:.4f}", dice.Signed());
      text += f < 3 ? "],\n" : "]\n]\n}\n";
    }
    return text;
  };
  ComplaintLines complaints;
  for (const double duration : {0.0333, 1e-4, 0.99e-4, 10.0, 10.1, -1.0}) {
    complaints.Add(fmt::format("DeepMimic, frames of {} s", duration), std::vector{motion(44, duration)},
                   From("a.txt", ReadDeepMimicMotion));
  }
  complaints.Add("DeepMimic, of 43 numbers", std::vector{motion(43, 0.04)}, From("a.txt", ReadDeepMimicMotion));
  complaints.Add("DeepMimic", SpoiltTexts(motion(44, 0.04), 12, 400), From("a.txt", ReadDeepMimicMotion));
  NumberArray poses{.shape = {3, 72}, .values = std::vector<double>(216, 0.1)}, trans{.shape = {3, 3}, .values = {}};
  for (int i = 0; i < 9; ++i) trans.values.push_back(dice.Signed());
  const std::string bytes =
      WriteNpz({{"poses", poses}, {"trans", trans}, {"mocap_framerate", {.shape = {}, .values = {120}}}},
               {{"names", {"a", "bcd", ""}}, {"gender", {"x"}}});
  std::vector<Npz> spoilt;
  for (const double other : {1.0, 0.99, 10000.0, 10000.1}) {
    spoilt.push_back(ReadNpz(bytes, "a.npz").value());
    spoilt.back().arrays["mocap_framerate"].values = {other};
    spoilt.push_back(spoilt.back());
    spoilt.back().arrays["trans"].values[5] = 1e6 * other;
    spoilt.push_back(spoilt.back());
    spoilt.back().arrays["poses"].values[100] = std::numeric_limits<double>::infinity();
  }
  complaints.Add("AMASS", spoilt, [](const Npz& arrays) { return ReadAmass(arrays, "a.npz"); });
  for (const char* type : {"<f8", "<f4", "<i8", "<i4", "<u4", "<i2", "<u2", "|u1", "|i1", "|b1", ">f8", "<f2", "|O"}) {
    std::vector<std::string> files;
    for (const char* shape : {"3,", "", "2, 2", "1, 2, 2", "1000000000000, 9", "-1,", "x"}) {
      const std::string header =
          fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}\n", type, shape);
      std::string npy = std::string("\x93NUMPY\1\0", 8) + static_cast<char>(header.size()) + '\0' + header;
      for (int i = 0; i < 32; ++i) npy += static_cast<char>(i == 7 || i == 15 ? 64 : 5 * i);
      files.push_back(npy);
      files.push_back(npy.substr(0, npy.size() - 9));
    }
    complaints.Add(std::string("npy ") + type, files, From("a.npy", ReadNpy));
  }
  const std::string table = "# remark\nx, y; z w\n1 2,3;4\n-5e2\tnan  .25 +7\n// no\n\n8,,9,10\r\n1e9 2 3 NaN\n";
  complaints.Add("rows", SpoiltTexts(table, 15, 500),
                 [](const std::string& text) { return ReadNumberRows(text, "a.txt", 500); });
  std::vector<std::string> kinect(1), targets(1);
  for (int i = 0; i < 225; ++i) kinect[0] += fmt::format("{:.3f}{}", 3 * dice.Signed(), i % 75 == 74 ? '\n' : ' ');
  for (int i = 0; i < 51; ++i) {
    targets[0] += fmt::format("{:.2f} 900.25 -30.5 0.6 0 0 0.8{}", 1500 * dice.Signed(), i % 17 == 16 ? '\n' : ' ');
  }
  for (const double length : {0.0, 0.89, 0.91, 1.0, 1.09, 1.11}) {
    for (const double place : {19.9, 20.1, 1e5}) {
      targets.emplace_back();
      kinect.emplace_back();
      for (int i = 0; i < 17; ++i)
        targets.back() += fmt::format("{} 1 2 0 {} 0 0 ", i == 3 ? place : 1, i == 8 ? length : 1);
      for (int i = 0; i < 25; ++i) kinect.back() += fmt::format("{} 0 0 0 0 0 1 ", i == 3 ? length * place : 0);
    }
  }
  std::ranges::copy(SpoiltTexts(kinect[0], 17, 150), std::back_inserter(kinect));
  std::ranges::copy(SpoiltTexts(targets[0], 18, 150), std::back_inserter(targets));
  complaints.Add("Kinect", kinect, From("k.txt", ReadKinectV2Text));
  complaints.Add("rigid targets", targets, From("t.txt", ReadRigidTargets));
  const std::string few = "head_z_m,time_s,head_x_m,head_y_m\n3,0.1,1,2\n6,0.15,4,nan\n,0.3,7,8\n9,nan,7,8\n";
  complaints.Add("joint CSV", SpoiltTexts(WriteJointCsv(SomeBody(50)), 19, 300), From("a.csv", ReadJointCsv));
  complaints.Add("a joint's CSV", SpoiltTexts(few, 20, 300), From("a.csv", ReadJointCsv));
  const JointCsvColumns columns = ReadJointCsv(few, "a.csv")->columns;
  complaints.Add("a row of CSV", SpoiltTexts("6,0.15,4,5\n", 21, 60),
                 [&](const std::string& row) { return ReadJointCsvRow(row, columns, "a.csv"); });
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/formats/array_complaints.txt"));
}

TEST(UniqueNames, NumberTheLaterOnes) {
  UniqueNames names;
  std::vector<std::string> given;
  for (const char* name : {"a", "b", "a", "a", "a#2", "b", ""}) given.emplace_back(names.Add(name));
  EXPECT_EQ(given, (std::vector<std::string>{"a", "b", "a#2", "a#3", "a#2#2", "b#2", ""}));
}

}  // namespace
}  // namespace etude
