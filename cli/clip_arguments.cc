#include "cli/clip_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/clip_commands.h"
#include "cli/common_arguments.h"
#include "cli/validators.h"

namespace etude {
namespace {

constexpr const char* kClipExamples =
    "\nA clip is a BVH or DeepMimic file, an animation of a glTF file (dance.glb#Jump; without # all of them), a pattern of files\n"
    "('mocap/*.bvh'), or builtin:NAME (builtin:* all moves, builtin:acts, builtin:songs). docs/clips.md tells more.\n\n"
    "Try:\n"
    "  etude clip info 'mocap/*.bvh'                          what is in these files, and are they understood?\n"
    "  etude clip render dance.bvh -o dance.png               a contact sheet\n"
    "  etude clip render builtin:clap -o clap.mp4             the bear, as a film\n"
    "  etude clip convert dance.bvh bear.glb --character bear a file for other viewers\n"
    "  etude clip contacts dance.bvh -o contacts.svg          when its feet stand\n"
    "  etude clip map odd.bvh -o odd.yaml                     to teach names: edit it, then --joint-map odd.yaml";

void DefineInfo(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipInfoOptions>();
  CLI::App* command = clip.add_subcommand("info", "Frames, joints, roles, unit, speeds, foot slide");
  command->add_option("clips", options->clips, "Clips")->required();
  command->add_flag("--json", options->as_json, "For programs (docs/schemas/clip-info.schema.json)");
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return ClipInfoCommand(*options); }; });
}

void DefineConvert(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipConvertOptions>();
  CLI::App* command = clip.add_subcommand("convert", "To BVH, GLB, TRC or CSV");
  command->add_option("input", options->input, "A clip")->required();
  command->add_option("output", options->output, "The file to write: .bvh, .glb, .trc (OpenSim) or .csv")->required();
  command->add_option("--trim", options->trim, "Only this part, seconds: FROM:TO, such as 1.5:4 or 2:");
  command->add_option("--rate", options->rate_hz, "Frames per second (default: the clip's; of bodies 30)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command->add_flag("--mirror", options->mirror, "Left becomes right");
  command->add_flag("--ground", options->ground, "As a body: twenty joints, metres, Y up, feet on the floor");
  command->add_flag("--retarget", options->retarget, "As a body of the canonical proportions, 1.70 m tall");
  command
      ->add_option("--character", options->character,
                   "Put on the bear or the mannequin, retargeted (GLB only); none leaves the file's meshes out")
      ->check(CLI::IsMember({"bear", "mannequin", "none"}));
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->footer(
      "\nWithout --ground, --retarget or --character a file keeps its own skeleton, unit and axes (GLB: metres, Y "
      "up).\n"
      "TRC and CSV hold the twenty joints of the body.");
  command->callback([=, &action] { action = [=] { return ClipConvertCommand(*options); }; });
}

void DefineRender(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipRenderOptions>();
  CLI::App* command = clip.add_subcommand("render", "A contact sheet (PNG) of clips, or a film (MP4) of one");
  command->add_option("clips", options->clips, "Clips")->required();
  command->add_option("-o,--output", options->output, "The picture: .png or .mp4")->required();
  command
      ->add_option("--character", options->character,
                   "own: the file's meshes; mannequin; bear; body: capsules, left blue and right orange\n"
                   "(default: own if there are any, else mannequin; bear for built-in clips)")
      ->check(CLI::IsMember({"own", "mannequin", "bear", "body"}));
  command->add_option("--view", options->view, "front, three-quarter or side, of how the clip begins")
      ->check(CLI::IsMember({"front", "three-quarter", "side"}))
      ->capture_default_str();
  command->add_option("--size", options->size, "Of the film, or of each picture of a sheet (720x720, 200x260)");
  command->add_option("--frames", options->frames, "Sheet: pictures of each clip (default: 12 of one, 8 of several)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--columns", options->columns, "Sheet: pictures beside each other")->check(CLI::Range(1, 100));
  command->add_option("--trim", options->trim, "Only this part, seconds: FROM:TO, such as 1.5:4 or 2:");
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return ClipRenderCommand(*options); }; });
}

void DefineGrades(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipGradesOptions>();
  CLI::App* command =
      clip.add_subcommand("grades", "Fuzzy features, grades, tags and poses of every frame; how alike clips are");
  command->add_option("clips", options->clips, "Clips")->required();
  command->add_option("-o,--output", options->output, "A table (.csv) of one clip, a line per frame");
  command->add_option("--fuzzy", options->fuzzy, "Fuzzy system: builtin:NAME or a file")->capture_default_str();
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return ClipGradesCommand(*options); }; });
}

void DefineContacts(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipContactsOptions>();
  CLI::App* command = clip.add_subcommand("contacts", "When the feet stand: their heights, speeds and contacts (SVG)");
  command->add_option("clip", options->clip, "A clip")->required();
  command->add_option("-o,--output", options->output, "The picture: .svg")->required();
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return ClipContactsCommand(*options); }; });
}

void DefineMap(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipMapOptions>();
  CLI::App* command = clip.add_subcommand("map", "Which joint plays which role");
  command->add_option("clip", options->clip, "A BVH or glTF file")->required();
  command->add_option("-o,--output", options->output,
                      "Write it as a joint-map file, to be edited; also when roles are missing");
  command->add_option("--joint-map", options->joint_map, "Roles that are taught already");
  AddOverwrite(*command, options->overwrite);
  command->callback([=, &action] { action = [=] { return ClipMapCommand(*options); }; });
}

}  // namespace

void AddClipReading(CLI::App& command, ClipReading& reading) {
  command.add_option("--joint-map", reading.joint_map, "Which joints play which roles (etude clip map writes one)");
  command.add_option("--unit", reading.unit,
                     "Unit of the file: m, cm, mm, in, ft, cmu, or metres per unit (default: found by the stature)");
  command.add_option("--up", reading.up, "Axis of the file that points up: y or z (default: found)")
      ->check(CLI::IsMember({"y", "z"}));
}

void DefineClip(CLI::App& app, Action& action) {
  CLI::App* clip = app.add_subcommand("clip", "Look at motion clips, convert and render them");
  clip->footer(kClipExamples);
  clip->require_subcommand(1);
  DefineInfo(*clip, action);
  DefineConvert(*clip, action);
  DefineRender(*clip, action);
  DefineContacts(*clip, action);
  DefineMap(*clip, action);
  DefineGrades(*clip, action);
}

}  // namespace etude
