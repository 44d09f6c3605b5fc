#include "bench/run/manifest.h"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <thread>

#include "bench/metrics/catalogue.h"
#include "bench/metrics/export.h"
#include "bench/model/recording.h"
#include "bench/results/folder.h"
#include "bench/tasks/registry.h"
#include "engine/base/digest.h"
#include "engine/base/machine.h"
#include "engine/base/names.h"
#include "io/clips/raw_motions.h"
#include "io/files/files.h"
#include "io/process/closed_environment.h"
#include "io/process/loaded_libraries.h"
#include "sim/render/renderer.h"

namespace etude {
namespace {

std::string ProcessorName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

Json DescribeClips(const ClipLibrary& library) {
  Json clips = Json::array();
  for (const LibraryClip& clip : library.clips) {
    Digest digest;
    for (const BodyPose& pose : clip.motion.poses) AddTo(digest, pose);
    clips.push_back({{"name", clip.name},
                     {"source", clip.source},
                     {"frames", clip.motion.poses.size()},
                     {"digest", digest.Hex()},
                     {"note", Join(clip.changes, "; ")}});
    if (!clip.changes.empty()) clips.back()["changes"] = clip.changes;
  }
  return clips;
}

/// Lists the files of a task that judges files. For each world, lists the file with the ground truth, if there is one,
/// and then the files of all answers.
Json DescribeFiles(const PreparedScenario& scenario) {
  Json files = Json::array();
  std::map<std::string, Result<std::string>> known;  // results by file, because several worlds may be in one file
  for (const JudgedFiles& world : scenario.setup().files) {
    std::vector<std::string> references = {world.truth};
    references.insert(references.end(), world.answers.begin(), world.answers.end());
    for (const std::string& reference : references) {
      if (reference.empty()) continue;
      if (!known.contains(reference)) known.emplace(reference, DigestOfFile(reference, scenario.opening()));
      const Result<std::string>& digest = known.at(reference);
      files.push_back({{"name", world.name}, {"source", reference}, {"digest", digest.value_or("")}});
      if (!digest) files.back()["note"] = ToString(digest.error());
    }
  }
  return files;
}

Json DescribeMotions(const PreparedScenario& scenario) {
  if (!scenario.setup().files.empty()) return DescribeFiles(scenario);
  Json motions = DescribeClips(scenario.clips());
  if (scenario.setup().streams.empty()) return motions;
  for (const NamedStream& recording : scenario.recordings()->streams) {
    Digest digest;
    for (const SensedFrame& frame : recording.stream.frames) {
      digest.Add(std::int64_t{frame.body_seen});
      for (const SensedJoint& joint : frame.joints) {
        digest.Add(joint.position.x).Add(joint.position.y).Add(joint.position.z);
        digest.Add(static_cast<std::int64_t>(joint.state));
      }
    }
    motions.push_back({{"name", recording.name},
                       {"source", recording.source},
                       {"frames", recording.stream.frames.size()},
                       {"digest", digest.Hex()},
                       {"note", recording.description}});
  }
  return motions;
}

/// The libraries that affect results, given by the beginnings of their file names: C and C++, Ceres with its linear
/// algebra and orderings, image codecs. Eigen, GLM, Random123 and, on Debian 12, Ceres are compiled into the program,
/// whose build is stated in the head of a journal. Libraries that only draw pages, read fonts or learn weights are not
/// listed, so their updates do not change the identity of a run.
constexpr std::array kDecisiveLibraries = {
    "libc.",       "libm.",        "libstdc++.",  "libblas.",     "libceres.", "liblapack.", "libatlas",
    "libopenblas", "libgfortran.", "libcholmod.", "libcxsparse.", "libamd.",   "libcamd.",   "libcolamd.",
    "libccolamd.", "libmetis.",    "libhwy.",     "libjpeg.",     "libpng",    "libz.",      "libzip.",
    "libOpenEXR",  "libImath",     "libIex",      "libtinygltf.", "libstb."};
/// The renderer and its compiler. They affect only the results of scenarios that draw.
constexpr std::array kRendererLibraries = {"libOSMesa.",  "libEGL_mesa.", "libgallium",
                                           "swrast_dri.", "libglapi.",    "libLLVM"};

/// Returns the builds of the libraries that affect results: the name and the first half of the build ID. The renderer's
/// libraries are loaded, and listed, only if `draws` is true.
Result<Json> DescribeLibraries(bool draws) {
  constexpr std::size_t kToldDigits = 20;
  if (draws) {
    // If the renderer is not installed, leave it out of the list.
    auto loaded = LoadRenderer();
    if (!loaded && IsOfThisMachine(loaded.error())) return tl::unexpected(loaded.error());
  }
  Json libraries = Json::object();
  for (const auto& [name, build] : LoadedLibraries()) {
    const auto begins = [&library = name](const char* stem) { return library.starts_with(stem); };
    const bool counts =
        std::ranges::any_of(kDecisiveLibraries, begins) || (draws && std::ranges::any_of(kRendererLibraries, begins));
    if (counts) libraries[name] = build.substr(0, kToldDigits);
  }
  return libraries;
}

constexpr const char* kUnknownPrograms =
    "the versions of the outside programs are unknown, because the etude of that run did not record the versions";

/// Returns a part of `line` in quotes: about 60 bytes, beginning shortly before byte `at`.
std::string ShowPart(const std::string& line, std::size_t at) {
  constexpr std::size_t kBefore = 20, kShown = 60;
  // Returns true if byte `i` continues a UTF-8 character that began at an earlier byte.
  const auto is_inside = [&](std::size_t i) { return i < line.size() && (line[i] & 0xC0) == 0x80; };
  std::size_t start = at > kBefore ? at - kBefore : 0, end = std::min(start + kShown, line.size());
  while (start > 0 && is_inside(start)) --start;
  while (is_inside(end)) ++end;
  return fmt::format("{}\"{}\"{}", start > 0 ? "…" : "", line.substr(start, end - start), end < line.size() ? "…" : "");
}

/// Returns the difference of two texts, at least one of which has several lines: the first line that differs.
JsonDifference CompareTexts(const std::string& path, const std::string& then, const std::string& now) {
  std::istringstream old_lines(then), new_lines(now);
  std::string was, is;
  for (int number = 1;; ++number) {
    const bool has_old = !std::getline(old_lines, was).fail(), has_new = !std::getline(new_lines, is).fail();
    if (has_old && has_new && was == is) continue;
    const auto at = static_cast<std::size_t>(std::ranges::mismatch(was, is).in1 - was.begin());
    return {fmt::format("{}, line {},", path, number), has_old ? ShowPart(was, at) : "absent",
            has_new ? ShowPart(is, at) : "absent"};
  }
}

/// Adds the differences between two values of manifests, `then` and `now`, to `found`. `path` is the position of both
/// values within their manifests.
void CompareJson(const std::string& path, const Json& then, const Json& now, std::vector<JsonDifference>& found) {
  if (then == now) return;
  if (then.is_object() && now.is_object()) {
    const auto below = [&](const std::string& key) { return path.empty() ? key : path + "." + key; };
    for (const auto& [key, value] : then.items()) CompareJson(below(key), value, now.value(key, Json()), found);
    for (const auto& [key, value] : now.items()) {
      if (!then.contains(key)) CompareJson(below(key), Json(), value, found);
    }
  } else if (then.is_array() && now.is_array() && then.size() == now.size()) {
    for (std::size_t i = 0; i < now.size(); ++i) CompareJson(fmt::format("{}[{}]", path, i), then[i], now[i], found);
  } else if (then.is_string() && now.is_string() &&
             (then.get<std::string>() + now.get<std::string>()).find('\n') != std::string::npos) {
    found.push_back(CompareTexts(path, then, now));
  } else {
    found.push_back({path, then.is_null() ? "absent" : ShowJson(then), now.is_null() ? "absent" : ShowJson(now)});
  }
}

SuiteSetup WithCanonicalNames(SuiteSetup suite) {
  const auto rename = [&](const std::string& name) {
    const auto found = suite.canonical.find(name);
    return found == suite.canonical.end() ? name : found->second;
  };
  SourceTexts sources;
  for (auto& [name, text] : suite.sources) sources.emplace(rename(name), std::move(text));
  suite.sources = std::move(sources);
  for (ScenarioSetup& scenario : suite.scenarios) scenario.file = rename(scenario.file);
  return suite;
}

Result<Json> ReadManifestJson(const FilePath& path) {
  auto json = ReadJsonFile(path);
  if (!json) return json;
  const Json schema = json->is_object() ? json->value("schema", Json()) : Json();
  if (schema != kResultSchema) {
    return Fail({path.string(), 0, 0}, "is not a manifest of schema {}; found schema {}", kResultSchema, schema.dump());
  }
  return json;
}

}  // namespace

Result<Json> MakeManifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                          const std::string& version) {
  const bool draws = std::ranges::any_of(scenarios, Draws, &PreparedScenario::scenario);
  ASSIGN_OR_RETURN(const auto libraries, DescribeLibraries(draws));
  Json json{{"schema", kResultSchema},
            {"etude", version},
            {"compiler", __VERSION__},
            {"packages", ETUDE_PACKAGES},
            {"glibc", gnu_get_libc_version()},
            {"libraries", libraries},
            {"environment", DigestOfEnvironment(PinnedEnvironment())}};
  json.update(EncodeSetup(WithCanonicalNames(suite)));
  for (const TaskKind& kind : AllTaskKinds()) {
    for (const std::string& id : kind.metrics) json["metrics"][id] = FindMetric(id)->version;
  }
  if (!AddedMetrics().empty()) json["own_metrics"] = AddedMetricsJson();
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    json["scenarios"][s]["loaded_clips"] = DescribeMotions(scenarios[s]);
    const TaskKind& kind = *FindTaskKind(IsFilmed(scenarios[s].scenario()) ? "capture" : scenarios[s].scenario().task);
    if (kind.platform != nullptr) json["scenarios"][s]["platform"] = kind.platform();
  }
  return json;
}

Result<SuiteSetup> ReadManifest(const FilePath& path) {
  ASSIGN_OR_RETURN(const auto json, ReadManifestJson(path));
  return DecodeSetup(json, {path.string(), 0, 0});
}

Result<void> CheckClips(const FilePath& path, std::span<const PreparedScenario> scenarios) {
  ASSIGN_OR_RETURN(const auto json, ReadManifestJson(path));
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const Json now = DescribeMotions(scenarios[s]);
    const Json then = json.at("scenarios").at(s).value("loaded_clips", Json::array());
    if (now == then) continue;
    for (std::size_t c = 0; c < std::max(now.size(), then.size()); ++c) {
      if (c < now.size() && c < then.size() && now[c] == then[c]) continue;
      const auto name = [&](const Json& clips) {
        return c < clips.size() ? fmt::format("{} {} ({})", clips[c].value("name", "?"), clips[c].value("digest", "?"),
                                              clips[c].value("note", clips[c].value("source", "")))
                                : "no clip";
      };
      return Fail({path.string(), 0, 0}, "clip {} of scenario {} was {} in the run and is {} now", c + 1,
                  scenarios[s].scenario().name, name(then), name(now));
    }
  }
  return {};
}

Result<PreparedRun> PrepareRun(const FilePath& manifest, const std::optional<SecretKey>& key) {
  ASSIGN_OR_RETURN(auto suite, ReadManifest(manifest));
  RETURN_IF_ERROR(OpenSeeds(key, {manifest.string()}, suite));
  ASSIGN_OR_RETURN(auto scenarios, PrepareAll(suite));
  RETURN_IF_ERROR(CheckClips(manifest, scenarios));
  return PreparedRun{std::move(suite), std::move(scenarios)};
}

std::vector<JsonDifference> CompareManifests(const Json& then, const Json& now) {
  std::vector<JsonDifference> found;
  CompareJson("", then, now, found);
  // If a text of the suite differs, leave out the digests of scenarios, which differ for the same reason.
  if (std::ranges::any_of(found, [](const auto& one) { return one.path.starts_with("sources."); })) {
    static const std::regex digest(R"(scenarios\[\d+\]\.digest)");
    std::erase_if(found, [](const auto& one) { return std::regex_match(one.path, digest); });
  }
  return found;
}

std::vector<JsonDifference> OfPrograms(const std::vector<JsonDifference>& differences) {
  static const std::regex programs(R"(scenarios\[\d+\]\.programs.*)");
  std::vector<JsonDifference> found;
  std::ranges::copy_if(differences, std::back_inserter(found),
                       [](const auto& one) { return std::regex_match(one.path, programs); });
  return found;
}

Result<void> RequirePrograms(const Json& manifest, std::span<const PreparedScenario> scenarios, const Place& place) {
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const bool is_told = manifest.at("scenarios").at(s).contains("programs");
    if (!is_told && !ProgramsIn(scenarios[s].scenario()).empty()) return Fail(place, "{}", kUnknownPrograms);
  }
  return {};
}

std::string InWords(std::span<const JsonDifference> differences) {
  constexpr std::size_t kMaxTold = 4;
  std::vector<std::string> told;
  for (const JsonDifference& one : differences.first(std::min(differences.size(), kMaxTold))) {
    told.push_back(fmt::format("{} was {} and is {}", one.path, one.then, one.now));
  }
  if (differences.size() > kMaxTold) told.push_back(fmt::format("{} more differ", differences.size() - kMaxTold));
  return Join(told, "; ");
}

bool AreOfLibraries(std::span<const JsonDifference> differences) {
  return std::ranges::all_of(differences, [](const auto& one) { return one.path.starts_with("libraries."); });
}

Result<std::vector<JsonDifference>> OtherLibrariesOf(const std::filesystem::path& folder) {
  const FilePath path = Inside(folder) / kOtherLibrariesFile;
  std::vector<JsonDifference> noted;
  if (!Exists(path)) return noted;
  ASSIGN_OR_RETURN(const auto json, ReadJsonFile(path));
  try {
    for (const Json& one : json) noted.push_back({one.at("path"), one.at("then"), one.at("now")});
  } catch (const Json::exception& error) {
    return Fail({path.string()}, "is not a list of changed libraries: {}", error.what());
  }
  return noted;
}

Result<void> RecordOtherLibraries(const std::filesystem::path& folder, std::span<const JsonDifference> differences) {
  ASSIGN_OR_RETURN(auto noted, OtherLibrariesOf(folder));
  for (const JsonDifference& one : differences) {
    if (std::ranges::find(noted, one) == noted.end()) noted.push_back(one);
  }
  Json json = Json::array();
  for (const JsonDifference& one : noted) json.push_back({{"path", one.path}, {"then", one.then}, {"now", one.now}});
  return SaveJson(Inside(folder) / kOtherLibrariesFile, json);
}

Result<std::string> BuildDigest() {
  Digest digest;
  RETURN_IF_ERROR(ReadInChunks("/proc/self/exe", [&](std::string_view bytes) { digest.Add(bytes); }));
  return digest.Hex();
}

std::string DigestOfEnvironment(const std::vector<std::string>& pinned) {
  Digest digest;
  for (const std::string& text : pinned) digest.Add(text + "\n");
  return digest.Hex();
}

Json DescribeHost(const std::string& command_line, int jobs, double seconds) {
  utsname system{};
  ::uname(&system);
  return {{"host", fmt::format("{} × {}, {} {}", std::thread::hardware_concurrency(), ProcessorName(), system.sysname,
                               system.release)},
          {"command_line", command_line},
          {"jobs", jobs},
          {"pinned_environment", PinnedEnvironment()},
          {"wall_seconds", seconds}};
}

}  // namespace etude
