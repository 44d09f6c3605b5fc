#include "io/clips/other_files.h"

#include <algorithm>

#include "engine/base/names.h"

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
    "an OpenSim table (.mot, .sto), whose model is another file: export its markers as TRC from OpenSim";
constexpr const char* kFilm = "a film, picture or sound, not a motion: etude capture recovers motions from films";
constexpr const char* kJsonList =
    "a JSON list; write joints with numpy.save, frames × joints × 3; keypoints of pictures are for etude capture";
constexpr const char* kMaya = "a file of Maya: export FBX there";
constexpr const char* kUsd = "a USD scene: export glTF, FBX or BVH of it, from Blender for instance";
constexpr const char* kUtf16 = "text in UTF-16: save it as UTF-8";
constexpr const char* kVicon = "Vicon's CSV: export C3D from Nexus";

constexpr Mark kMarks[] = {
    {"\x1f\x8b", "a gzip file: unpack it"},
    {"BZh", "a bzip2 file: unpack it"},
    {"\xfd"
     "7zXZ",
     "an xz file: unpack it"},
    {"7z\xbc\xaf", "a 7-Zip archive: unpack it"},
    {"Rar!", "a RAR archive: unpack it"},
    {"ustar", "a tar archive: unpack it", 257},
    {"\x28\xb5\x2f\xfd", "a file packed by zstd: unpack it; if it is Blender's, export BVH or glTF there"},
    {"\x80", "a pickled Python object, which is never opened: write its arrays with numpy.savez"},
    {"\x89HDF", "an HDF5 file: write its arrays with numpy.savez"},
    {"MATLAB", "a file of MATLAB: write its arrays with numpy.savez"},
    {"\xff\xfe", kUtf16},
    {"\xfe\xff", kUtf16},
    {"version https://git-lfs", "a pointer of Git LFS, not the file: git lfs pull"},
    {"<!DOCTYPE html", "a web page"},
    {"<html", "a web page"},
    {"Vocaloid Motion Data",
     "a motion of MikuMikuDance (.vmd), whose model is another file: load both in Blender (MMD "
     "Tools), and export BVH or glTF"},
    {"PMX ", "a model of MikuMikuDance (.pmx), which holds no motion"},
    {"Pmd", "a model of MikuMikuDance (.pmd), which holds no motion"},
    {"PXR-USDC", kUsd},
    {"#usda", kUsd},
    {"NO_OF_FRAMES", "Qualisys' TSV: export C3D from QTM"},
    {"Trajectories", kVicon},
    {"Model Outputs", kVicon},
    {"Devices", kVicon},
    {"BLENDER", "a scene of Blender: export BVH or glTF there"},
    {"//Maya", kMaya},
    {"animVersion", kMaya},
    {"FOR4", kMaya},
    {"FOR8", kMaya},
    {"%YAML 1.1\n%TAG !u!", "a file of Unity: export FBX there"},
    {"#VRML", "a VRML scene: export BVH or glTF of it, from Blender for instance"},
    {"\x89PNG", kFilm},
    {"\xff\xd8\xff", kFilm},
    {"\x1a\x45\xdf\xa3", kFilm},
    {"RIFF", kFilm},
    {"ftyp", kFilm, 4},
    {"[SegmentNames&Hierarchy]", "Motion Analysis' HTR: export TRC or C3D from Cortex", kAnywhere},
    {"<mvnx", "Xsens' MVNX: export BVH, C3D or FBX from MVN", kAnywhere},
    {"<COLLADA", "a Collada scene: export glTF or BVH of it, from Blender for instance", kAnywhere},
    {"<X3D", "an X3D scene: export BVH or glTF of it, from Blender for instance", kAnywhere},
    {"<OpenSimDocument", "a model of OpenSim, which holds no motion", kAnywhere},
    {"<?xml", "XML of an unknown kind; export BVH, FBX or C3D from the program that wrote it"},
    {"Coordinates", kOpenSim},
    {"\nendheader", kOpenSim, kAnywhere},
    {":", "an Acclaim skeleton, whose motions are the .amc files beside it"},
    {"{",
     "JSON that is neither glTF (it has no \"asset\") nor a motion of DeepMimic (\"Frames\"); write joints with "
     "numpy.save, frames × joints × 3; keypoints of pictures are for etude capture"},
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
    return "a binary file of an unknown kind; export BVH, FBX or C3D from the program that wrote it (Motive writes "
           ".tak, QTM .qtm)";
  }
  const std::string begins = "that begins with " + Quote(std::string(first_word));
  const std::string_view line = head.substr(0, head.find('\n'));
  if (std::ranges::count_if(line, [](char c) { return c == ',' || c == ';' || c == '\t'; }) > 1) {
    return "a table " + begins +
           "; one of joints has columns left_wrist_x_m, …; or write joints with numpy.save, frames × joints × 3";
  }
  return "a file " + begins;
}

}  // namespace etude
