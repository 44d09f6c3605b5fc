#pragma once

#include <string>
#include <vector>

namespace etude {

/// What is told about files that cannot tell it themselves; "" = found out.
struct ClipReading {
  std::string joint_map;  ///< a joint-map file
  std::string unit;       ///< "m", "cm", … or metres per unit as a number
  std::string up;         ///< "y" or "z"
};

struct ClipInfoOptions {
  std::vector<std::string> clips;
  bool as_json = false;
  ClipReading reading;
};
/// `etude clip info`: exit 2 when a clip is not understood; the others are told of all the same.
int ClipInfoCommand(const ClipInfoOptions& options);

struct ClipConvertOptions {
  std::string input, output;
  double rate_hz = 0;  ///< 0 = the clip's own, or 30 Hz of a body
  std::string trim;    ///< "1.5:4", "" = all of it
  std::string character;
  bool mirror = false, retarget = false, ground = false, overwrite = false;
  ClipReading reading;
};
/// `etude clip convert`: BVH or glTF to BVH, GLB, TRC or CSV.
int ClipConvertCommand(const ClipConvertOptions& options);

struct ClipRenderOptions {
  std::vector<std::string> clips;
  std::string output;
  std::string trim;
  std::string character;  ///< "" = chosen for each clip
  std::string view = "three-quarter";
  std::string size;  ///< "200x260", "" = 200 × 260 for pictures of a sheet, 720 × 720 for films
  int frames = 0;    ///< per clip; 0 = 12 of one clip, 8 of several
  int columns = 0;   ///< 0 = 6 of one clip, a line each of several
  bool overwrite = false;
  ClipReading reading;
};
/// `etude clip render`: a contact sheet of any clips, or a film of one.
int ClipRenderCommand(const ClipRenderOptions& options);

struct ClipContactsOptions {
  std::string clip;
  std::string output;  ///< an SVG picture
  bool overwrite = false;
  ClipReading reading;
};
/// `etude clip contacts`: when the feet stand, as transitions see it.
int ClipContactsCommand(const ClipContactsOptions& options);

struct ClipMapOptions {
  std::string clip;
  std::string output;  ///< a joint-map file, "" = only printed
  bool overwrite = false;
  std::string joint_map;
};
/// `etude clip map`: which joint plays which role.
int ClipMapCommand(const ClipMapOptions& options);

struct ClipGradesOptions {
  std::vector<std::string> clips;
  std::string output;                   ///< a CSV file of one clip, "" = none
  std::string fuzzy = "builtin:paper";  ///< builtin:NAME or a file (docs/fuzzy-system.md)
  bool overwrite = false;
  ClipReading reading;
};
/// `etude clip grades`: what paper A's fuzzy system sees in clips, and how alike they are.
int ClipGradesCommand(const ClipGradesOptions& options);

}  // namespace etude
