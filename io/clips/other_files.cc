#include "io/clips/other_files.h"

#include <algorithm>

#include "engine/base/names.h"
#include "engine/base/text.h"

namespace etude {
namespace {

constexpr std::size_t kAnywhere = std::string_view::npos;
constexpr std::size_t kHeadBytes = 4096;

/// The bytes that identify a kind of file, the position of these bytes in the file, and the text about such files.
struct Mark {
  std::string_view bytes;
  const char* told;
  std::size_t at = 0;  ///< position in the file; kAnywhere: anywhere in the first kHeadBytes
};

constexpr const char* kOpenSim =
    "an OpenSim table (.mot, .sto), which needs a model from another file: in OpenSim, export the markers as TRC";
constexpr const char* kFilm = "a film, a picture or a sound: use `etude capture` to recover motions from films";
constexpr const char* kJsonList =
    "a JSON list: for joint positions, use numpy.save (frames × joints × 3); for keypoints of pictures, use `etude "
    "capture`";
constexpr const char* kMaya = "a Maya file: in Maya, export FBX";
constexpr const char* kUsd = "a USD scene: export it as glTF, FBX or BVH, for example with Blender";
constexpr const char* kUtf16 = "text in UTF-16: save it as UTF-8";
constexpr const char* kVicon = "Vicon's CSV: in Nexus, export C3D";

constexpr Mark kMarks[] = {
    {"\x1f\x8b", "a gzip file: unpack it"},
    {"BZh", "a bzip2 file: unpack it"},
    {"\xfd"
     "7zXZ",
     "an xz file: unpack it"},
    {"7z\xbc\xaf", "a 7-Zip archive: unpack it"},
    {"Rar!", "a RAR archive: unpack it"},
    {"ustar", "a tar archive: unpack it", 257},
    {"\x28\xb5\x2f\xfd", "a zstd file: unpack it; if it is a Blender scene, export BVH or glTF from Blender"},
    {"\x80",
     "a pickled Python object, which can run code, so Etude does not open it; write the arrays with numpy.savez"},
    {"\x89HDF", "an HDF5 file: write the arrays with numpy.savez"},
    {"MATLAB", "a MATLAB file: write the arrays with numpy.savez"},
    {"\xff\xfe", kUtf16},
    {"\xfe\xff", kUtf16},
    {"version https://git-lfs", "a pointer of Git LFS instead of the file: run `git lfs pull`"},
    {"<!DOCTYPE html", "a web page"},
    {"<html", "a web page"},
    {"Vocaloid Motion Data",
     "a motion of MikuMikuDance (.vmd), which needs a model from another file: load both in Blender (MMD Tools), and "
     "export BVH or glTF"},
    {"PMX ", "a model of MikuMikuDance (.pmx), which contains no motion"},
    {"Pmd", "a model of MikuMikuDance (.pmd), which contains no motion"},
    {"PXR-USDC", kUsd},
    {"#usda", kUsd},
    {"NO_OF_FRAMES", "Qualisys' TSV: in QTM, export C3D"},
    {"Trajectories", kVicon},
    {"Model Outputs", kVicon},
    {"Devices", kVicon},
    {"BLENDER", "a Blender scene: in Blender, export BVH or glTF"},
    {"//Maya", kMaya},
    {"animVersion", kMaya},
    {"FOR4", kMaya},
    {"FOR8", kMaya},
    {"%YAML 1.1\n%TAG !u!", "a Unity file: in Unity, export FBX"},
    {"#VRML", "a VRML scene: export it as BVH or glTF, for example with Blender"},
    {"\x89PNG", kFilm},
    {"\xff\xd8\xff", kFilm},
    {"\x1a\x45\xdf\xa3", kFilm},
    {"RIFF", kFilm},
    {"ftyp", kFilm, 4},
    {"[SegmentNames&Hierarchy]", "Motion Analysis' HTR: in Cortex, export TRC or C3D", kAnywhere},
    {"<mvnx", "Xsens' MVNX: in MVN, export BVH, C3D or FBX", kAnywhere},
    {"<COLLADA", "a Collada scene: export it as glTF or BVH, for example with Blender", kAnywhere},
    {"<X3D", "an X3D scene: export it as BVH or glTF, for example with Blender", kAnywhere},
    {"<OpenSimDocument", "an OpenSim model, which contains no motion", kAnywhere},
    {"<?xml", "XML of an unknown type: export BVH, FBX or C3D from the program that wrote the file"},
    {"Coordinates", kOpenSim},
    {"\nendheader", kOpenSim, kAnywhere},
    {":", "an Acclaim skeleton without motion: open an .amc file of the same folder"},
    {"{",
     "JSON that is neither glTF (it has no \"asset\") nor a motion of DeepMimic (it has no \"Frames\"): for joint "
     "positions, use numpy.save (frames × joints × 3); for keypoints of pictures, use `etude capture`"},
    {"[[", kJsonList},
    {"[{", kJsonList}};

bool Has(std::string_view head, const Mark& mark) {
  return mark.at == kAnywhere ? head.find(mark.bytes) != kAnywhere
                              : head.size() > mark.at && head.substr(mark.at).starts_with(mark.bytes);
}

}  // namespace

std::string DescribeOtherFile(std::string_view bytes, std::string_view first_word) {
  const std::string_view head = bytes.substr(0, kHeadBytes);
  if (first_word.empty()) return "an empty file";
  const auto* const known = std::ranges::find_if(kMarks, [&](const Mark& mark) { return Has(head, mark); });
  if (known != std::end(kMarks)) return known->told;
  if (head.find('\0') != kAnywhere) {
    return "a binary file of an unknown type: export BVH, FBX or C3D from the program that wrote the file (for .tak "
           "files Motive, for .qtm files QTM)";
  }
  const std::string begins = "that begins with " + Quote(std::string(first_word));
  const std::string_view line = FirstLine(head);
  if (std::ranges::count_if(line, [](char c) { return c == ',' || c == ';' || c == '\t'; }) > 1) {
    return "a table " + begins +
           ": for joint positions, use columns such as wrist_x, wrist_y and wrist_z of at least three joints, or "
           "numpy.save (frames × joints × 3)";
  }
  return "a file " + begins;
}

}  // namespace etude
