#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "engine/base/names.h"
#include "engine/retargeting/body_choice.h"
#include "io/clips/clip_library.h"
#include "io/clips/convert.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "tools/clips/clip_facts.h"
#include "tools/clips/contact_index.h"
#include "tools/clips/role_sheet.h"

namespace etude {
namespace {

constexpr const char* kClipText =
    "\n"
    "A clip is a BVH or DeepMimic file, an animation of a glTF file (dance.glb#Jump; dance.glb is all its "
    "animations),\n"
    "a pattern of file names ('mocap/*.bvh'), or builtin:NAME (builtin:* all moves, builtin:acts, builtin:songs).\n"
    "docs/clips.md explains more.";

struct ClipInfoOptions {
  std::vector<std::string> clips;
  bool as_json = false;
  ClipReading reading;
};

/// Prints the facts of all clips. Returns 2 if a clip cannot be interpreted; the other clips are printed nevertheless.
Result<int> ClipInfoCommand(const ClipInfoOptions& options) {
  ASSIGN_OR_RETURN(const auto reading, ReadOptions(options.reading));
  ASSIGN_OR_RETURN(const auto references, ExpandReferences(options.clips, kMaxLibraryClips));
  std::vector<ClipFacts> all;
  for (const std::string& reference : references) {
    for (ClipFacts& facts : FactsOf(reference, reading)) {
      if (!options.as_json && facts.format) fmt::print("{}", FactsAsText(facts, all.empty() ? nullptr : &all.back()));
      all.push_back(std::move(facts));
    }
  }
  if (options.as_json) RETURN_IF_ERROR(PrintFacts("clip info", FactsAsJson(all)));
  int code = kSuccess;
  for (const ClipFacts& facts : all) {
    if (facts.complaint) code = Complain(*facts.complaint);
  }
  return code;
}

void DefineInfo(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipInfoOptions>();
  CLI::App* command = clip.add_subcommand("info", "Show frames, joints, roles, unit, speeds and foot slide");
  command->add_option("clips", options->clips, "Clips")->required();
  command->add_flag("--json", options->as_json, "Print JSON (docs/schemas/clip-info.schema.json)");
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return Finish(ClipInfoCommand(*options)); }; });
}

struct ClipConvertOptions {
  std::string input, output;
  double rate_hz = 0;  ///< frames per second; 0 = the clip's own rate, or 30 Hz for bodies
  std::string trim;    ///< the part FROM:TO in seconds, "1.5:4"; "" = the whole clip
  std::string character;
  bool mirror = false, retarget = false, ground = false, overwrite = false, as_json = false;
  ClipReading reading;
};

Performer PerformerNamed(const std::string& name) {
  if (name == "bear") return Performer::kBear;
  if (name == "mannequin") return Performer::kMannequin;
  return name == "none" ? Performer::kNone : Performer::kFile;
}

/// Writes the files of a motion into the folder of a data set. Existing files that describe the whole data set are
/// kept.
Result<void> WriteBids(const BidsFiles& files, const std::filesystem::path& folder, bool overwrite) {
  std::vector<std::pair<FilePath, const std::string*>> written;
  for (const auto& [name, bytes] : files) {
    const bool is_of_set = name.find('/') == std::string::npos;
    if (is_of_set && std::filesystem::exists(folder / name)) continue;
    RETURN_IF_ERROR(CheckOutput((folder / name).string(), overwrite));
    written.emplace_back(Inside(folder) / name, &bytes);  // `Inside` follows no links in the folder
  }
  for (const auto& [path, bytes] : written) RETURN_IF_ERROR(WriteFileAtomically(path, *bytes));
  return {};
}

Result<int> ClipConvertCommand(const ClipConvertOptions& given) {
  // Check the output, and read the options and the clip.
  const bool is_bids = given.output.ends_with('/');
  MotionFormat format = MotionFormat::kBids;
  if (!is_bids) {
    RETURN_IF_ERROR(CheckOutput(given.output, given.overwrite));
    ASSIGN_OR_RETURN(format, FormatOfName(given.output));
  }
  ASSIGN_OR_RETURN(auto reading, ReadOptions(given.reading));
  ASSIGN_OR_RETURN(const auto trim, ReadTrim(given.trim));
  ASSIGN_OR_RETURN(const auto references, ExpandReferences({given.input}));
  if (references.size() > 1) {
    return Fail({}, "'{}' matches {} clips; allowed: one clip", given.input, references.size());
  }
  ASSIGN_OR_RETURN(auto clips, ReadClips(references.front(), reading));

  // Convert the clip and write the result.
  ConvertOptions options{.trim = trim,
                         .rate_hz = std::nullopt,
                         .mirror = given.mirror,
                         .ground = given.ground,
                         .retarget = given.retarget,
                         .performer = PerformerNamed(given.character),
                         .open = std::move(reading),
                         .version = ETUDE_VERSION};
  if (given.rate_hz > 0) options.rate_hz = given.rate_hz;
  ASSIGN_OR_RETURN(const auto converted, ConvertClips(std::move(clips), format, options));
  if (is_bids) {
    RETURN_IF_ERROR(WriteBids(converted.files, given.output, given.overwrite));
  } else {
    RETURN_IF_ERROR(WriteFileAtomically(given.output, converted.bytes));
  }
  // Report the conversion.
  if (given.as_json) {
    RETURN_IF_ERROR(PrintFacts("clip convert", {{"clip", references.front()},
                                                {"output", given.output},
                                                {"as", converted.note},
                                                {"changes", converted.changes}}));
  } else {
    fmt::print("{}\n", converted.note);
    for (const std::string& change : converted.changes) fmt::print("  {}\n", change);
  }
  TellWritten(given.output, given.as_json ? stderr : stdout);
  return kSuccess;
}

void DefineConvert(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipConvertOptions>();
  CLI::App* command =
      clip.add_subcommand("convert", "Convert a clip to BVH, GLB, TRC, CSV, C3D, NPZ, MOT or Motion-BIDS");
  command->add_option("input", options->input, "A clip")->required();
  command
      ->add_option("output", options->output,
                   "The file to write: .bvh, .glb, .trc (OpenSim markers), .mot (OpenSim joint angles), .csv, .c3d, "
                   ".npz (NumPy); or, for Motion-BIDS, a folder such as data/")
      ->required();
  // Define the part of the clip that is converted, and the changes to the clip.
  command->add_option(
      "--trim", options->trim,
      "Convert only the part FROM:TO, in seconds after the first frame: 1.5:4, or 2: for the part from 2 s to the end");
  command
      ->add_option("--rate", options->rate_hz,
                   "Frames per second of the output (default: the clip's rate, or 30 for a body of twenty joints)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command->add_flag("--mirror", options->mirror, "Mirror the motion: left becomes right");
  command->add_flag("--ground", options->ground,
                    "Write Etude's body of twenty joints, in metres, with Y up and the feet on the floor");
  command->add_flag("--retarget", options->retarget,
                    "Write Etude's body of twenty joints with canonical proportions, 1.70 m tall");
  command
      ->add_option("--character", options->character,
                   "GLB only: retarget the motion to the bear or the mannequin; none: leave out the meshes of the file")
      ->check(OneOf({"bear", "mannequin", "none"}));
  // Define how files are written and read.
  AddOverwrite(*command, options->overwrite);
  AddJson(*command, options->as_json);
  AddClipReading(*command, options->reading, "--file-rate");
  command->footer(
      "\n"
      "Without --ground, --retarget or --character, the output keeps the skeleton, unit and axes of the input (GLB: "
      "metres,\n"
      "Y up). TRC, CSV, C3D, NPZ and Motion-BIDS contain the twenty joints of Etude's body. MOT contains the angles "
      "between\n"
      "its limbs.");
  command->callback([=, &action] { action = [=] { return Finish(ClipConvertCommand(*options)); }; });
}

struct ClipContactsOptions {
  std::string clip;
  std::string output;  ///< the SVG file to write
  bool overwrite = false;
  ClipReading reading;
};

Result<int> ClipContactsCommand(const ClipContactsOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite, ".svg"));
  ASSIGN_OR_RETURN(const auto reading, ReadOptionsTellingDoubts(options.reading));
  ASSIGN_OR_RETURN(const auto clips, LoadClips({options.clip}, {}, reading));
  if (clips.clips.size() != 1) {
    return Fail({}, "'{}' matches {} clips; allowed: one clip", options.clip, clips.clips.size());
  }
  RETURN_IF_ERROR(WriteFileAtomically(options.output, ContactIndexSvg(clips.clips[0].name, clips.clips[0].motion)));
  TellWritten(options.output);
  return kSuccess;
}

void DefineContacts(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipContactsOptions>();
  CLI::App* command =
      clip.add_subcommand("contacts", "Plot the heights, speeds and floor contacts of the feet over time (SVG)");
  command->add_option("clip", options->clip, "A clip")->required();
  command->add_option("-o,--output", options->output, "The picture: .svg")->required();
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return Finish(ClipContactsCommand(*options)); }; });
}

struct ClipMapOptions {
  std::string clip;
  std::string output;   ///< a joint-map file; "" = the map is only printed
  std::string preview;  ///< a picture, "" = none
  bool overwrite = false, as_json = false;
  std::string joint_map;
};

void PrintRoles(const Skeleton& skeleton, const JointMap& map) {
  for (const Role role : AllRoles()) {
    const bool composed = std::ranges::find(map.composed, role) != map.composed.end();
    fmt::print(
        "{:<16} {}{}\n", RoleName(role), Quote(skeleton.joints[map[role].joint].name),
        composed ? " (composed: no joint has this role, so Etude uses a point that is fixed to this joint)" : "");
  }
}

std::vector<std::string> UnusedJoints(const Skeleton& skeleton, const JointMap& map) {
  std::vector<std::string> unused;
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const auto plays = [&](const RolePoint& point) { return point.joint == static_cast<int>(i); };
    const Joint& joint = skeleton.joints[i];
    if (!joint.is_end_site && std::ranges::none_of(map.points, plays)) unused.push_back(Quote(joint.name));
  }
  return unused;
}

Json RolesAsJson(const Skeleton& skeleton, const JointMap& map, const MadeBody& made) {
  Json roles = Json::array();
  for (const Role role : AllRoles()) {
    roles.push_back({{"role", RoleName(role)},
                     {"joint", skeleton.joints[map[role].joint].name},
                     {"composed", std::ranges::find(map.composed, role) != map.composed.end()}});
    if (HasMarkers(made.markers)) roles.back()["markers"] = made.markers[Index(role)];
  }
  return roles;
}

/// Writes a joint-map file for a skeleton with missing roles. It holds the roles that were found, anatomical proposals
/// for the missing roles, and the joint names to choose from.
std::string UnfinishedMapFile(const Skeleton& skeleton) {
  const PartialRoles roles = FindPartialRoles(skeleton);
  std::string text =
      "# Each role needs a joint: write its name after the colon. Hands, feet, spine and head may be left "
      "out.\nroles:\n";
  for (const Role role : AllRoles()) {
    const int found = roles.found[Index(role)], proposed = roles.proposed[Index(role)];
    if (found >= 0) {
      text += fmt::format("  {}: {}\n", RoleName(role), QuotedInYaml(skeleton.joints[found].name));
    } else if (proposed >= 0) {
      text += fmt::format("  # {}: {}  # proposed because of the skeleton's shape, confidence {:.2f}\n", RoleName(role),
                          QuotedInYaml(skeleton.joints[proposed].name), roles.confidence);
    } else {
      text += fmt::format("  # {}:\n", RoleName(role));
    }
  }
  text += "# All joints of the file:\n";
  for (const Joint& joint : skeleton.joints) text += fmt::format("#   {}\n", QuotedInYaml(joint.name));
  return text;
}

/// Returns the joint of each role in `map` or, if `map` is null, of each role that FindPartialRoles finds or proposes.
std::array<RoleOnSheet, kRoleCount> RolesOnSheet(const Skeleton& skeleton, const JointMap* map) {
  using By = RoleOnSheet::By;
  std::array<RoleOnSheet, kRoleCount> roles;
  const PartialRoles in_part = map == nullptr ? FindPartialRoles(skeleton) : PartialRoles{};
  for (const Role role : AllRoles()) {
    RoleOnSheet& shown = roles[Index(role)];
    if (map != nullptr) {
      const auto is_among = [&](const std::vector<Role>& some) { return std::ranges::find(some, role) != some.end(); };
      shown = {(*map)[role].joint, is_among(map->composed)     ? By::kComposed
                                   : is_among(map->by_anatomy) ? By::kAnatomy
                                                               : By::kName};
    } else if (const int found = in_part.found[Index(role)]; found >= 0) {
      shown = {found, By::kName};
    } else if (const int proposed = in_part.proposed[Index(role)]; proposed >= 0) {
      shown = {proposed, By::kProposed};
    }
  }
  return roles;
}

Result<void> WritePreview(const ClipMapOptions& options, const Clip& clip, const JointMap* map) {
  if (options.preview.empty()) return {};
  ASSIGN_OR_RETURN(const auto png, DrawRoleSheet(clip, RolesOnSheet(clip.skeleton, map)));
  RETURN_IF_ERROR(WriteFileAtomically(options.preview, png));
  TellWritten(options.preview, options.as_json ? stderr : stdout);
  return {};
}

Result<void> CheckMapOutputs(const ClipMapOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  return CheckOutput(options.preview, options.overwrite, ".png");
}

Result<int> ClipMapCommand(const ClipMapOptions& options) {
  const bool writes = !options.output.empty();
  RETURN_IF_ERROR(CheckMapOutputs(options));
  ASSIGN_OR_RETURN(const auto reading, ReadOptions({.joint_map = options.joint_map, .unit = "", .up = ""}));
  // All animations of a file share one skeleton, so the first animation is enough.
  OpenOptions as_file;
  as_file.recorded = reading.recorded;
  ASSIGN_OR_RETURN(const auto clips, ReadClips(options.clip, as_file));
  const Skeleton& skeleton = clips.front().clip.skeleton;
  const MadeBody made = clips.front().made.value_or(MadeBody{});
  const auto chosen =
      ChooseBody(clips.front().clip, options.clip, reading.roles ? &*reading.roles : nullptr, clips.front().skinned);
  const JointMap* const map = chosen ? &chosen->map : nullptr;
  RETURN_IF_ERROR(WritePreview(options, clips.front().clip, map));
  // If roles are missing, write a file to fill in, and complain.
  if (!map) {
    // Never overwrite the joint map that the user gave: the user may still edit this file, and it may be the output
    // file.
    if (options.joint_map.empty() && writes) {
      RETURN_IF_ERROR(WriteFileAtomically(options.output, UnfinishedMapFile(skeleton)));
      TellWritten(options.output);
      fmt::print("Next: assign joints to the missing roles in this file, then use --joint-map {}\n", options.output);
    }
    return tl::unexpected(chosen.error());
  }
  // If all roles are known, print and write the map.
  if (options.as_json) {
    RETURN_IF_ERROR(PrintFacts("clip map", {{"clip", options.clip}, {"roles", RolesAsJson(skeleton, *map, made)}}));
  } else if (HasMarkers(made.markers)) {
    for (const Role role : AllRoles()) {
      fmt::print("{:<16} {}\n", RoleName(role), DescribeMarkers(made.markers[Index(role)]));
    }
  } else {
    PrintRoles(skeleton, *map);
    PrintList("joints without a role:", UnusedJoints(skeleton, *map));
  }
  if (!writes) return kSuccess;
  RETURN_IF_ERROR(WriteFileAtomically(options.output, WriteJointMapFile(skeleton, *map)));
  TellWritten(options.output, options.as_json ? stderr : stdout);
  return kSuccess;
}

void DefineMap(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipMapOptions>();
  CLI::App* command = clip.add_subcommand("map", "Show which joint of the skeleton has which role");
  command->add_option("clip", options->clip, "A BVH or glTF file")->required();
  command->add_option("-o,--output", options->output,
                      "Write a joint-map file that you can edit, even if some roles have no joint");
  command->add_option("--preview", options->preview, "Draw the skeleton with joint names and roles (.png)");
  command->add_option(kJointMapOption, options->joint_map, "A joint map with the roles that you have already assigned");
  AddJson(*command, options->as_json);
  AddOverwrite(*command, options->overwrite);
  command->callback([=, &action] { action = [=] { return Finish(ClipMapCommand(*options)); }; });
}

}  // namespace

void DefineClip(CLI::App& app, Action& action) {
  CLI::App* clip = app.add_subcommand("clip", "Inspect, convert and render motion clips");
  clip->footer(kClipText);
  clip->require_subcommand(1);
  DefineInfo(*clip, action);
  DefineConvert(*clip, action);
  DefineRender(*clip, action);
  DefineContacts(*clip, action);
  DefineMap(*clip, action);
  DefineGrades(*clip, action);
}

}  // namespace etude
