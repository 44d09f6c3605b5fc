#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
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
#include "engine/formats/text_scanner.h"
#include "engine/formats/trc.h"
#include "engine/formats/unique_names.h"
#include "engine/formats/wav.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/c3d_writer.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;
using testing::SpoiltBytes;
using testing::SpoiltTexts;

/// Numbers of files may be none; those are told apart from all others.
double Told(double number) { return std::isfinite(number) ? number : std::isnan(number) ? 1234.5 : 4321.5; }

void AddFormat(Fingerprint& print, const Clip& clip) {
  print.Add(clip.name).Add(clip.rate_hz).Add(clip.frames.size());
  for (const Joint& joint : clip.skeleton.joints) {
    print.Add(joint.name).Add(joint.parent).Add(joint.is_end_site).Add(joint.rest.translation).Add(joint.rest.rotation);
  }
  for (const LocalPose& frame : clip.frames) {
    for (const LocalTransform& local : frame) print.Add(local.translation).Add(local.rotation).Add(local.scale);
  }
}

void AddFormat(Fingerprint& print, const MarkerMotion& markers) {
  print.Add(markers.rate_hz).Add(markers.names).Add(markers.remark);
  for (const auto& frame : markers.frames) print.Add(frame);
}

void AddFormat(Fingerprint& print, const NumberArray& array) {
  print.Add(array.shape);
  for (const double value : array.values) print.Add(Told(value));
}

void AddFormat(Fingerprint& print, const C3d& c3d) {
  print.Add(c3d.unit).Add(c3d.up).Add(c3d.step_m);
  AddFormat(print, c3d.markers);
}

void AddFormat(Fingerprint& print, const Npz& npz) {
  print.Add(npz.skipped);
  for (const auto& [name, array] : npz.arrays) {
    print.Add(name);
    AddFormat(print, array);
  }
}

void AddFormat(Fingerprint& print, const JointCsv& csv) {
  print.Add(csv.columns.count).Add(csv.columns.time).Add(csv.columns.joints).Add(csv.rate_hz).Add(csv.lines);
  for (const double time : csv.times_s) print.Add(Told(time));
  for (const auto& frame : csv.frames) print.Add(frame);
}

void AddFormat(Fingerprint& print, const AcclaimSkeleton& skeleton) {
  AddFormat(print, Clip{.name = "", .skeleton = skeleton.skeleton, .frames = {}});
  for (const auto& channels : skeleton.channels) {
    for (const AcclaimSkeleton::Channel& channel : channels) print.Add(channel.turns).Add(channel.axis);
  }
  print.Add(skeleton.axes).Add(skeleton.in_degrees);
}

void AddFormat(Fingerprint& print, const NumberRows& rows) {
  print.Add(rows.heading).Add(rows.columns).Add(rows.lines).Add(rows.RowCount());
  for (const double value : rows.values) print.Add(Told(value));
}

void AddFormat(Fingerprint& print, const std::vector<KinectV2Frame>& frames) {
  for (const KinectV2Frame& frame : frames) print.Add(frame).Add(PlacesOf(frame));
}

void AddFormat(Fingerprint& print, const std::vector<TargetFrame>& frames) {
  for (const TargetFrame& frame : frames) {
    for (const auto& target : frame) {
      print.Add(target.has_value());
      if (target) print.Add(target->position).Add(target->rotation);
    }
  }
}

void AddFormat(Fingerprint& print, const JointCsvRow& row) { print.Add(Told(row.time_s)).Add(row.places); }

/// Adds what was read, or what is complained of: a number for each, so that a huge one hides none of the others.
template <typename T>
void AddRead(Fingerprint& print, const Result<T>& read) {
  Fingerprint one;
  if (read) AddFormat(one, *read);
  if (!read) one.Add(ToString(read.error()));
  print.Add(read.has_value()).Add(std::asinh(one.sum()));
}

TEST(FormatsGolden, OfBvh) {
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
  Fingerprint print;
  const auto add = [&](const std::string& text) {
    std::vector<std::string> remarks;
    AddRead(print, ReadBvh(text, "folder/a.bvh", &remarks));
    print.Add(remarks);
  };
  add(habits);
  add(zeros);
  for (const std::string& text : SpoiltTexts(habits, 1, 700)) add(text);
  for (const std::string& text : SpoiltTexts(zeros, 2, 300)) add(text);
  for (const char* time : {"0.0001", "0.00009", "10", "10.1", "0.0333333", "0.03336", "0.0333367", "1"}) {
    std::string text = zeros;
    add(text.replace(text.find("0.04"), 4, time));
  }
  for (const std::uint64_t seed : {5u, 6u, 7u}) {
    const Clip clip = testing::RandomClip(seed, {.roots = static_cast<int>(seed - 4),
                                                 .rest_rotations = seed == 6,
                                                 .moving_offsets = seed == 7,
                                                 .scales = seed == 7});
    const std::string text = WriteBvh(clip);
    print.Add(text);
    add(text);
  }
  EXPECT_TRUE(print.Is(18417, 2029.61374889));
}

TEST(FormatsGolden, OfBvhAtItsLimits) {
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
  Fingerprint print;
  for (const int levels : {120, 126, 127, 128, 129}) print.Add(ReadBvh(nested(levels), "a.bvh").has_value());
  for (const int joints : {1022, 1023, 1024, 1025}) print.Add(ReadBvh(wide(joints), "a.bvh").has_value());
  for (const std::size_t length : {499u, 500u, 501u}) {
    std::string text = wide(1);
    print.Add(ReadBvh(text.replace(text.find("j0"), 2, std::string(length, 'n')), "a.bvh").has_value());
  }
  EXPECT_TRUE(print.Is(12, 0.159257230349));
}

TEST(FormatsGolden, OfAcclaim) {
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
  Fingerprint print;
  AddRead(print, ReadAcclaimSkeleton(skeleton, "a.asf"));
  for (const std::string& text : SpoiltTexts(skeleton, 3, 600)) AddRead(print, ReadAcclaimSkeleton(text, "a.asf"));
  const AcclaimSkeleton read = ReadAcclaimSkeleton(skeleton, "a.asf").value();
  AcclaimSkeleton radians = read;
  radians.in_degrees = false;
  AddRead(print, ReadAcclaimMotion(motion, read, "a.amc"));
  for (const std::string& text : SpoiltTexts(motion, 4, 300)) {
    print.Add(IsAcclaimMotion(text));
    AddRead(print, ReadAcclaimMotion(text, text.size() % 2 == 0 ? read : radians, "folder/a.amc"));
  }
  EXPECT_TRUE(print.Is(2104, -32.7788255363));
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

TEST(FormatsGolden, OfC3d) {
  Fingerprint print;
  const std::string written = WriteC3d(OddMarkers()), body = WriteC3d(SomeBody(29.97));
  print.Add(written).Add(body).Add(WriteC3d(MarkerMotion{.names = {std::string(130, 'n')}, .frames = {}}));
  for (const std::string& bytes : SpoiltBytes(written, 7, 500)) {
    print.Add(IsC3d(bytes));
    AddRead(print, ReadC3d(bytes, "a.c3d"));
  }
  for (const int machine : {testing::kIntel, testing::kDec, testing::kMips, 87}) {
    for (const bool floats : {false, true}) {
      testing::C3dWriter writer(machine, floats);
      AddRead(print, ReadC3d(writer.Write(), "a.c3d"));
      writer.analogue = 3;
      writer.unit = "in";
      AddRead(print, ReadC3d(writer.Write(), "a.c3d"));
      writer.points = 5;
      writer.labels = "AAAABBBBCCCCDDDD    ";
      writer.second_labels_from = 3;
      for (const char* unit : {"m", "cm", "mm", "ft", "", "mi", "MM"}) {
        writer.unit = unit;
        AddRead(print, ReadC3d(writer.Write(), "a.c3d"));
      }
      for (const std::string& bytes : SpoiltBytes(writer.Write(), 8, 150)) AddRead(print, ReadC3d(bytes, "a.c3d"));
    }
  }
  EXPECT_TRUE(print.Is(10703, -692.943462918));
}

TEST(FormatsGolden, OfTrcAndMotive) {
  Fingerprint print;
  const std::string markers = WriteTrc(OddMarkers(), "a\tb"), body = WriteTrc(SomeBody(24), "b");
  print.Add(markers).Add(body);
  for (const std::string& text : {markers, body}) {
    for (const std::string& spoilt : SpoiltTexts(text, 9, 300)) AddRead(print, ReadTrc(spoilt, "a.trc"));
    for (const char* unit : {"m", "cm", "in"}) {
      std::string other = text;
      AddRead(print, ReadTrc(other.replace(other.find("\tmm\t") + 1, 2, unit), "a.trc"));
    }
  }
  for (const auto& [step, rows] : {std::pair{0.01, 20},
                                   {0.0158, 40},
                                   {0.0159, 40},
                                   {0.0175, 40},
                                   {0.0176, 40},
                                   {0.03, 17},
                                   {0.03, 18},
                                   {0.03, 30},
                                   {0.0, 30},
                                   {-0.02, 30}}) {
    MarkerMotion many{
        .rate_hz = 60, .names = {"a"}, .frames = std::vector(rows, std::vector{std::optional(glm::dvec3(1))})};
    std::string text = WriteTrc(many, "a");
    const std::size_t start = text.find("\n1\t") + 1;
    std::string told = text.substr(0, start);
    for (int row = 0; row < rows; ++row) told += fmt::format("{}\t{:.6f}\t1000\t1000\t1000\n", row + 1, step * row);
    AddRead(print, ReadTrc(told, "a.trc"));
  }
  const std::string take =
      "Format Version,1.23,Take Name,t,Capture Frame Rate,120.0,Export Frame Rate,60.0,Length Units,Centimeters,"
      "Coordinate Space,Global\r\n\r\n,Type,Bone,Bone,Bone,Bone,Marker,Marker,Marker\r\n,Name,\"A:Hip\",\"A:Hip\","
      "\"A:Hip\",\"A:Hip\",m1,m1,m1\r\n,ID,,,,,,,\r\n,,Rotation,Position,Position,Position,Position,Position,"
      "Position\r\n"
      "Frame,Time (Seconds),X,X,Y,Z,X,Y,Z\r\n0,0.0,9,10,20,-30,1,2,3\r\n1,0.016667,9,,20,-30,4,5,6\r\n\r\n";
  for (const std::string& text : SpoiltTexts(take, 10, 500)) {
    print.Add(IsMotiveCsv(text));
    AddRead(print, ReadMotiveCsv(text, "a.csv"));
  }
  EXPECT_TRUE(print.Is(7840, 2052.90727109));
}

TEST(FormatsGolden, OfTextsThatAreTooLong) {
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
  EXPECT_EQ(ToString(ReadDeepMimicMotion(text, "a.txt").error()), "a.txt: 64 MiB; allowed: 64 MiB");
}

TEST(FormatsGolden, OfDeepMimic) {
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
  Fingerprint print;
  for (const double duration : {0.0333, 1e-4, 0.99e-4, 10.0, 10.1, 1.0, -1.0}) {
    AddRead(print, ReadDeepMimicMotion(motion(44, duration), "a.txt"));
  }
  AddRead(print, ReadDeepMimicMotion(motion(43, 0.04), "a.txt"));
  for (const std::string& text : SpoiltTexts(motion(44, 0.04), 12, 400)) {
    print.Add(IsDeepMimicMotion(text));
    AddRead(print, ReadDeepMimicMotion(text, "folder/a.txt"));
  }
  EXPECT_TRUE(print.Is(1216, 89.9792476146));
}

TEST(FormatsGolden, OfArrays) {
  Fingerprint print;
  testing::Dice dice(13);
  NumberArray poses{.shape = {3, 72}, .values = {}}, trans{.shape = {3, 3}, .values = {}};
  for (int i = 0; i < 216; ++i) poses.values.push_back(dice.Signed());
  for (int i = 0; i < 9; ++i) trans.values.push_back(dice.Signed());
  const NumberArray rate{.shape = {}, .values = {120}};
  const std::string bytes = WriteNpz({{"poses", poses}, {"trans", trans}, {"mocap_framerate", rate}},
                                     {{"names", {"a", "bcd", ""}}, {"gender", {"x"}}});
  print.Add(bytes);
  for (const std::string& spoilt : SpoiltBytes(bytes, 14, 300)) {
    print.Add(IsZip(spoilt)).Add(ReadNpz(spoilt, "a.npz").has_value());
  }
  const Npz read = ReadNpz(bytes, "a.npz").value();
  AddFormat(print, read);
  AddRead(print, ReadAmass(read, "a.npz"));
  for (const double other : {1.0, 0.99, 10000.0, 10000.1}) {
    Npz changed = read;
    changed.arrays["mocap_framerate"].values = {other};
    AddRead(print, ReadAmass(changed, "a.npz"));
    changed.arrays["mocap_frame_rate"] = rate;
    changed.arrays.erase("mocap_framerate");
    changed.arrays["trans"].values[5] = 1e6 * other;
    AddRead(print, ReadAmass(changed, "a.npz"));
    changed.arrays["poses"].values[100] = std::numeric_limits<double>::infinity();
    AddRead(print, ReadAmass(changed, "a.npz"));
  }
  for (const char* type : {"<f8", "<f4", "<i8", "<i4", "<u4", "<i2", "<u2", "|u1", "|i1", "|b1", ">f8", "<f2", "|O"}) {
    for (const char* shape : {"3,", "", "2, 2", "1, 2, 2", "1000000000000, 9", "-1,", "x"}) {
      for (const char* order : {"False", "True"}) {
        std::string header =
            fmt::format("{{'descr': '{}', 'fortran_order': {}, 'shape': ({}), }}\n", type, order, shape);
        std::string npy = std::string("\x93NUMPY\1\0", 8) + static_cast<char>(header.size()) + '\0' + header;
        for (int i = 0; i < 32; ++i) npy += static_cast<char>(i == 7 || i == 15 ? 64 : 5 * i);
        print.Add(IsNpy(npy));
        AddRead(print, ReadNpy(npy, "a.npy"));
        AddRead(print, ReadNpy(npy.substr(0, npy.size() - 9), "a.npy"));
      }
    }
  }
  EXPECT_TRUE(print.Is(4814, -988.412695272));
}

TEST(FormatsGolden, OfRowsOfNumbers) {
  Fingerprint print;
  const std::string table = "# remark\nx, y; z w\n1 2,3;4\n-5e2\tnan  .25 +7\n// no\n\n8,,9,10\r\n1e9 2 3 NaN\n";
  for (const std::string& text : SpoiltTexts(table, 15, 500)) AddRead(print, ReadNumberRows(text, "a.txt", 500));
  std::string kinect, targets;
  testing::Dice dice(16);
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 75; ++i) kinect += fmt::format("{:.3f} ", i % 30 < 3 && row == 1 ? 0 : 3 * dice.Signed());
    for (int i = 0; i < 17; ++i) {
      const glm::dvec3 place = 1500.0 * dice.Vector();
      const glm::dquat turn = dice.Rotation();
      targets += fmt::format("{:.2f} {:.2f} {:.2f} {:.5f} {:.5f} {:.5f} {:.5f} ", place.x, place.y, place.z, turn.x,
                             turn.y, turn.z, i == 5 ? 0.05 * row + turn.w : turn.w);
    }
    kinect += "\n";
    targets += "\n";
  }
  for (const std::string& text : SpoiltTexts(kinect, 17, 150)) AddRead(print, ReadKinectV2Text(text, "k.txt"));
  for (const std::string& text : SpoiltTexts(targets, 18, 150)) AddRead(print, ReadRigidTargets(text, "t.txt"));
  for (const double length : {0.0, 0.89, 0.91, 1.0, 1.09, 1.11}) {
    for (const double place : {19.9, 20.0, 20.1, 1e5}) {
      std::string row;
      for (int i = 0; i < 17; ++i) row += fmt::format("{} 1 2 0 {} 0 0 ", i == 3 ? place : 1, i == 8 ? length : 1);
      AddRead(print, ReadRigidTargets(row, "t.txt"));
      std::string joints;
      for (int i = 0; i < 25; ++i) joints += fmt::format("{} 0 0 0 0 0 1 ", i == 3 ? length * place : 0);
      AddRead(print, ReadKinectV2Text(joints, "k.txt"));
    }
  }
  for (const Role role : AllRoles()) print.Add(KinectV2JointOf(role));
  EXPECT_TRUE(print.Is(1716, -152.611602179));
}

TEST(FormatsGolden, OfJointCsv) {
  Fingerprint print;
  const std::string csv = WriteJointCsv(SomeBody(50));
  print.Add(csv);
  for (const std::string& text : SpoiltTexts(csv, 19, 300)) AddRead(print, ReadJointCsv(text, "a.csv"));
  const std::string few = "head_z_m,time_s,head_x_m,head_y_m\n3,0.1,1,2\n6,0.15,4,nan\n,0.3,7,8\n9,nan,7,8\n";
  for (const std::string& text : SpoiltTexts(few, 20, 300)) AddRead(print, ReadJointCsv(text, "a.csv"));
  const JointCsvColumns columns = ReadJointCsv(few, "a.csv")->columns;
  for (const std::string& row : SpoiltTexts("6,0.15,4,5\n", 21, 60)) {
    const auto read = ReadJointCsvRow(row, columns, "a.csv");
    AddRead(print, read);
  }
  EXPECT_TRUE(print.Is(8195, 2582.84750292));
}

TEST(FormatsGolden, OfWordsNamesAndSounds) {
  Fingerprint print;
  for (const std::string& text : SpoiltTexts("ab {c: 1.5 2} x\r\n\r d  e f { 3e2 }\n\n7 z\r9", 22, 200)) {
    TextScanner scanner(text, "a.txt");
    const auto add = [&](const Token& token) { print.Add(token.text).Add(token.line).Add(token.column); };
    for (int i = 0; i < 4; ++i) {
      add(scanner.Next());
      add(scanner.NextInLine());
      print.Add(scanner.TakeNumberInLine());
      add(scanner.NameInLine());
      print.Add(scanner.SkipToText());
    }
    const auto number = scanner.Number(scanner.Next(), "a number");
    print.Add(number.has_value());
    if (!number) print.Add(ToString(number.error()));
  }
  UniqueNames names;
  for (const char* name : {"a", "b", "a", "a", "a#2", "b", ""}) print.Add(names.Add(name));
  const std::vector<double> samples = {0, 0.5, -0.5, 1, -1, 1.5, -2, 1e-5, 0.3333};
  EXPECT_TRUE(print.Add(WriteWav(samples, 44100)).Add(WriteWav({}, 8000)).Is(17833, -22.4709111475));
}

}  // namespace
}  // namespace etude
