#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "cli/arguments.h"
#include "cli/clip_reading.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "tools/clips/clip_film.h"
#include "tools/clips/contact_sheet.h"

namespace etude {
namespace {

struct ClipRenderOptions {
  std::vector<std::string> clips;
  std::string output;
  std::string trim;
  std::string character;  ///< the performing figure; "" = chosen for each clip
  std::string view = "three-quarter";
  std::string size;  ///< picture size, "200x260"; "" = 200 × 260 on a sheet, 720 × 720 in a film
  int frames = 0;    ///< pictures per clip; 0 = default: 12 for a single clip, 8 for each of several clips
  int columns = 0;   ///< pictures per row; 0 = default: 6 for a single clip, else all pictures of a clip
  int jobs = 0;
  bool overwrite = false;
  ClipReading reading;
};

struct Size {
  int width = 0;
  int height = 0;
};

/// Parses a size such as "200x260", pixels; returns `otherwise` for "".
Result<Size> ReadSize(const std::string& text, const Size& otherwise) {
  if (text.empty()) return otherwise;
  constexpr int kMinSide = 16, kMaxSide = 2048;  // pictures are drawn twice as large and then shrunk
  Size size;
  int end = 0;
  const bool is_size = std::sscanf(text.c_str(), "%5dx%5d%n", &size.width, &size.height, &end) == 2 &&
                       end == static_cast<int>(text.size());
  const auto fits = [](int side) { return side >= kMinSide && side <= kMaxSide; };
  if (is_size && fits(size.width) && fits(size.height)) return size;
  return Fail({}, "--size: '{}' is not a size; allowed: WIDTHxHEIGHT in pixels, {} to {} each", text, kMinSide,
              kMaxSide);
}

std::optional<ActorKind> ActorNamed(const std::string& name) {
  if (name == "own") return ActorKind::kOwn;
  if (name == "bear") return ActorKind::kBear;
  if (name == "mannequin") return ActorKind::kMannequin;
  if (name == "body") return ActorKind::kBody;
  return std::nullopt;
}

Viewpoint ViewNamed(const std::string& name) {
  if (name == "front") return Viewpoint::kFront;
  return name == "side" ? Viewpoint::kSide : Viewpoint::kThreeQuarter;
}

Result<std::vector<ClipActor>> Cast(const ClipRenderOptions& options) {
  ASSIGN_OR_RETURN(const auto reading, ReadOptionsTellingDoubts(options.reading));
  ASSIGN_OR_RETURN(const auto trim, ReadTrim(options.trim));
  ASSIGN_OR_RETURN(const auto references, ExpandReferences(options.clips));
  std::vector<ClipActor> actors;
  for (const std::string& reference : references) {
    ASSIGN_OR_RETURN(auto clips, ReadClips(reference, reading));
    for (SourceClip& clip : clips) {
      auto part = TrimTo(clip, trim);
      if (!part) return Fail({clip.source, 0, 0}, "{}", part.error().message);
      clip.clip = std::move(*part);
      ASSIGN_OR_RETURN(auto opened, UnderstandClip(std::move(clip), reading));
      ASSIGN_OR_RETURN(auto actor, ClipActor::Make(std::move(opened), ActorNamed(options.character)));
      actors.push_back(std::move(actor));
    }
  }
  return actors;
}

Result<void> WriteSheet(const ClipRenderOptions& options) {
  ASSIGN_OR_RETURN(const auto size, ReadSize(options.size, {200, 260}));
  ASSIGN_OR_RETURN(auto actors, Cast(options));
  ASSIGN_OR_RETURN(auto* const renderer, SharedRenderer());
  const bool alone = actors.size() == 1;
  const int frames = options.frames > 0 ? options.frames : alone ? 12 : 8;
  const int columns = options.columns > 0 ? options.columns : alone ? 6 : frames;
  const SheetOptions sheet{ViewNamed(options.view), size.width, size.height, frames, columns};
  ASSIGN_OR_RETURN(const auto png, DrawContactSheet(std::move(actors), sheet, *renderer));
  return WriteFileAtomically(options.output, png);
}

/// Makes a film of one clip. Returns false if Ctrl-C stopped the film.
Result<bool> WriteFilm(const ClipRenderOptions& options) {
  ASSIGN_OR_RETURN(const auto size, ReadSize(options.size, {720, 720}));
  if (size.width % 2 != 0 || size.height % 2 != 0) {
    return Fail({}, "--size: found {}x{}; allowed for films: even numbers of pixels", size.width, size.height);
  }
  ASSIGN_OR_RETURN(auto actors, Cast(options));
  if (actors.size() > 1) {
    return Fail({}, "found {} clips; a film can show only one clip, but a contact sheet (.png) can show several clips",
                actors.size());
  }
  ASSIGN_OR_RETURN(auto* const renderer, SharedRenderer());
  const Interrupt interrupt;
  const FilmOptions film{ViewNamed(options.view), size.width, size.height, WatchFilms(interrupt, options.jobs)};
  return UnlessInterrupted(FilmClip(std::move(actors.front()), film, options.output, *renderer), interrupt);
}

Result<int> ClipRenderCommand(const ClipRenderOptions& options) {
  const std::string extension = std::filesystem::path(options.output).extension().string();
  if (extension != ".png" && extension != ".mp4") {
    return Fail({options.output}, "has the wrong ending; allowed: .png (a contact sheet), .mp4 (a film)");
  }
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  if (extension == ".png") {
    RETURN_IF_ERROR(WriteSheet(options));
  } else {
    ASSIGN_OR_RETURN(const bool is_whole, WriteFilm(options));
    if (!is_whole) return TellStopped();
  }
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace

void DefineRender(CLI::App& clip, Action& action) {
  auto options = std::make_shared<ClipRenderOptions>();
  CLI::App* command = clip.add_subcommand("render", "Draw a contact sheet (PNG) of clips, or a film (MP4) of one clip");
  command->add_option("clips", options->clips, "Clips")->required();
  command->add_option("-o,--output", options->output, "The output file: .png (a contact sheet) or .mp4 (a film)")
      ->required();
  command
      ->add_option("--character", options->character,
                   "The figure to draw: own (the meshes of the file), mannequin, bear, or body (capsules; left blue, "
                   "right orange)\n"
                   "(default: own if the file has meshes, bear for built-in clips, otherwise mannequin)")
      ->check(OneOf({"own", "mannequin", "bear", "body"}));
  command
      ->add_option("--view", options->view,
                   "Direction of view relative to the first pose: front, three-quarter or side")
      ->check(OneOf({"front", "three-quarter", "side"}));
  command->add_option("--size", options->size,
                      "Size of the film (default: 720x720), or of each picture of a contact sheet (default: 200x260)");
  command
      ->add_option("--frames", options->frames,
                   "For a contact sheet: number of pictures per clip (default: 12 for one clip, 8 for several clips)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--columns", options->columns, "For a contact sheet: number of pictures in a row")
      ->check(CLI::Range(1, 100))
      ->default_str("");
  command->add_option(
      "--trim", options->trim,
      "Render only the part FROM:TO, in seconds after the first frame: 1.5:4, or 2: for the part from 2 s to the end");
  AddJobs(*command, options->jobs);
  AddOverwrite(*command, options->overwrite);
  AddClipReading(*command, options->reading);
  command->callback([=, &action] { action = [=] { return Finish(ClipRenderCommand(*options)); }; });
}

}  // namespace etude
