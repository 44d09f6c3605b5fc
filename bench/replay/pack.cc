#include "bench/replay/pack.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/replay/replay.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "bench/run/manifest.h"
#include "bench/run/supervisor.h"
#include "io/clips/references.h"
#include "io/files/files.h"
#include "io/files/own_files.h"
#include "io/files/temporary_folder.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kPackVersion = 3;

/// Packs clips in order. A built-in clip is packed as its name, any other clip as the name and content of its file.
/// Each file is packed once.
Result<Json> PackClips(const ClipLibrary& library) {
  Json clips = Json::array(), files = Json::array();
  std::map<std::string, std::size_t> number_of;
  for (const LibraryClip& clip : library.clips) {
    if (clip.source.starts_with(kBuiltinPrefix)) {
      clips.push_back({{"source", clip.source}});
      continue;
    }
    const SplitReference reference = Split(clip.source);
    const auto [file, is_new] = number_of.emplace(reference.path, files.size());
    if (is_new) {
      ASSIGN_OR_RETURN(auto bytes, ReadWholeFile(FileOf(reference.path)));
      const std::size_t first = bytes.find_first_not_of(" \t\r\n");
      if (first != std::string::npos && bytes[first] == '{') {
        return Fail({reference.path, 0, 0},
                    "a .gltf file cannot be packed, because it may need other files; 'etude clip convert' makes a .glb "
                    "file of it");
      }
      files.push_back({{"name", fs::path(FileOf(reference.path)).filename().string()},
                       {"bytes", Json::binary({bytes.begin(), bytes.end()})}});
    }
    clips.push_back({{"file", file->second}, {"animation", reference.animation.value_or("")}});
  }
  return Json{{"clips", std::move(clips)}, {"files", std::move(files)}};
}

/// Writes each packed file into a folder of its own, so that the file keeps its name. Returns references to the written
/// clips.
Result<std::vector<std::string>> UnpackClips(const Json& packed, const fs::path& folder) {
  std::vector<std::string> paths;
  for (const Json& file : packed.at("files")) {
    const auto name = file.at("name").get<std::string>();
    if (name.empty() || name == "." || name == ".." || name.find_first_of(std::string("/\0", 2)) != std::string::npos) {
      return Fail({}, "'{}' is not a file name", name);
    }
    const auto& bytes = file.at("bytes").get_binary();
    paths.push_back((folder / std::to_string(paths.size()) / name).string());
    RETURN_IF_ERROR(
        WriteFileAtomically(paths.back(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, OnDisk::kLater));
  }
  std::vector<std::string> references;
  for (const Json& clip : packed.at("clips")) {
    if (clip.contains("source")) {
      references.push_back(clip.at("source").get<std::string>());
      continue;
    }
    const std::string animation = clip.at("animation").get<std::string>();
    references.push_back(paths.at(clip.at("file").get<std::size_t>()) + (animation.empty() ? "" : "#" + animation));
  }
  return references;
}

/// Packs recordings in order, in the format that PackClips uses.
Result<Json> PackStreams(const LabelledStreams& recordings) {
  Json clips = Json::array(), files = Json::array();
  for (const NamedStream& recording : recordings.streams) {
    ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(recording.source));
    clips.push_back({{"file", files.size()}, {"animation", ""}});
    files.push_back({{"name", fs::path(recording.source).filename().string()},
                     {"bytes", Json::binary({bytes.begin(), bytes.end()})}});
  }
  return Json{{"clips", std::move(clips)}, {"files", std::move(files)}};
}

/// Packs a scenario's motions as {"clips": …, "libraries": {name: …}, "streams": … if there are any}, in the format
/// that PackClips uses.
Result<Json> PackMotions(const PreparedScenario& scenario) {
  Json motions{{"clips", nullptr}, {"libraries", Json::object()}};
  for (const auto& [name, library] : scenario.libraries()) {
    ASSIGN_OR_RETURN(motions["libraries"][name], PackClips(library));
  }
  if (scenario.libraries().empty()) {
    ASSIGN_OR_RETURN(motions["clips"], PackClips(scenario.clips()));
  }
  if (!scenario.setup().streams.empty()) {
    ASSIGN_OR_RETURN(motions["streams"], PackStreams(*scenario.recordings()));
  }
  return motions;
}

Result<void> UnpackMotions(const Json& motions, const fs::path& folder, ScenarioSetup& scenario) {
  if (!motions.at("clips").is_null()) {
    ASSIGN_OR_RETURN(scenario.clips, UnpackClips(motions.at("clips"), folder));
  }
  if (motions.contains("streams")) {
    ASSIGN_OR_RETURN(scenario.streams, UnpackClips(motions.at("streams"), folder / "streams"));
  }
  for (std::size_t i = 0; i < scenario.libraries.size(); ++i) {
    NamedClips& library = scenario.libraries[i];
    ASSIGN_OR_RETURN(library.clips,
                     UnpackClips(motions.at("libraries").at(library.name), folder / ("library-" + std::to_string(i))));
  }
  return {};
}

}  // namespace

Result<Pack> ReadPack(std::string_view bytes, const std::string& file) {
  const Place place{file, 0, 0};
  const auto is_no_pack = [&](std::string_view why) {
    return Fail(place, "is not a packed cell: {}; 'etude replay DIR --cell ID --pack FILE' writes a packed cell", why);
  };
  const auto json = ReadCbor(bytes, file);
  if (!json) return is_no_pack(json.error().message);
  try {
    if (json->at("etude_pack") != kPackVersion) {
      return Fail(place, "found a packed cell of version {}; this program reads version {}",
                  json->at("etude_pack").dump(), kPackVersion);
    }
    ASSIGN_OR_RETURN(auto suite, DecodeSetup(json->at("setup"), place));
    if (suite.scenarios.size() != 1)
      return Fail(place, "is not a packed cell: found {} scenarios; allowed: one scenario", suite.scenarios.size());
    ASSIGN_OR_RETURN(auto row, DecodeRow(json->at("row"), place));
    return Pack{std::move(suite), std::move(row), std::make_unique<Json>(json->at("motions"))};
  } catch (const Json::exception& error) {
    return is_no_pack(error.what());
  }
}

Result<void> UnpackMotions(Pack& pack, const std::string& file, const fs::path& folder) {
  try {
    const auto unpacked = UnpackMotions(*pack.motions, folder, pack.suite.scenarios.front());
    if (!unpacked) return Fail({file, 0, 0}, "{}", ToString(unpacked.error()));
    return {};
  } catch (const std::exception& error) {  // thrown by Json, or by at() for a file that is not in the pack
    return Fail({file, 0, 0}, "cannot read a clip of this packed cell: {}", error.what());
  }
}

Result<void> PackCell(const std::string& folder, const std::string& cell, const std::string& file, Sealing sealing) {
  ASSIGN_OR_RETURN(const auto run, LoadRun(folder, sealing));
  const auto place = FindRow(run, cell);
  if (!place) return Fail({folder, 0, 0}, "contains no cell '{}'", cell);
  const Row row = RowAt(run, *place);
  // Packing makes no worlds, so the key of secret worlds is needed only when the cell is replayed.
  const FilePath manifest = Inside(folder) / "manifest.json";
  ASSIGN_OR_RETURN(SuiteSetup suite, ReadManifest(manifest));
  ASSIGN_OR_RETURN(const auto scenarios, PrepareAll(suite));
  RETURN_IF_ERROR(CheckClips(manifest, scenarios));
  RETURN_IF_ERROR(CheckStillThere(folder, run));
  // Pack the scenario of the cell only.
  const auto prepared = std::find_if(scenarios.begin(), scenarios.end(), [&](const PreparedScenario& scenario) {
    return scenario.scenario().name == row.scenario;
  });
  if (prepared == scenarios.end()) return Fail({folder, 0, 0}, "contains no scenario '{}'", row.scenario);
  ASSIGN_OR_RETURN(auto clips, PackMotions(*prepared));
  if (suite.scored && row.method == suite.scored->name) {
    return Fail({folder, 0, 0}, "'{}' cannot be packed, because its answer was read from a file and scored", cell);
  }
  suite.scored.reset();
  suite.scenarios = {prepared->setup()};
  const Json pack{{"etude_pack", kPackVersion},
                  {"etude", run.program_version},
                  {"setup", EncodeSetup(suite)},
                  {"row", EncodeRow(row)},
                  {"motions", std::move(clips)}};
  const std::vector<std::uint8_t> bytes = Json::to_cbor(pack);
  return WriteFileAtomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Result<std::optional<CellCheck>> ReplayPack(const std::string& file, const OutsideRules& outside,
                                            const std::optional<SecretKey>& key, const std::atomic<bool>* stop) {
  ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(file));
  ASSIGN_OR_RETURN(auto pack, ReadPack(bytes, file));
  RETURN_IF_ERROR(OpenSeeds(key, {file}, pack.suite));
  ASSIGN_OR_RETURN(const auto folder, TemporaryFolder::Make("replay"));
  RETURN_IF_ERROR(UnpackMotions(pack, file, folder.path()));
  ASSIGN_OR_RETURN(const auto scenarios, PrepareAll(pack.suite));
  RETURN_IF_ERROR(CheckPrograms(file, scenarios, outside));
  RETURN_IF_ERROR(NoteKey(file, pack.suite, scenarios, key));
  ASSIGN_OR_RETURN(const Fence fence, FenceFor(scenarios, outside, "", key));
  const Plan plan(scenarios);
  std::size_t cell = 0;
  while (cell < plan.cell_count() && plan.IdentityOf(cell).Id() != pack.row.Id()) ++cell;
  if (cell == plan.cell_count()) return Fail({file, 0, 0}, "the scenario of this file has no cell '{}'", pack.row.Id());
  const std::size_t world = plan.WorldOf(cell);
  std::optional<CellCheck> check;
  // The folder for the programs' standard error, which the reason of a failure quotes.
  const std::string errors = (folder.path() / "stderr").string();
  RETURN_IF_ERROR(RunOrders(pack.suite, plan, {{world, {cell - plan.CellAt(world, 0)}}},
                            {.program = ThisProgram(), .error_folder = errors, .fence = fence, .jobs = 1, .stop = stop},
                            [&](const DeliveredCell& again) -> Result<void> {
                              ASSIGN_OR_RETURN(const auto finished, again.Read(plan));
                              check = CompareRows(pack.row, finished.row);
                              return {};
                            }));
  return check;
}

}  // namespace etude
