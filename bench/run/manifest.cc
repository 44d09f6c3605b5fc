#include "bench/run/manifest.h"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/files/files.h"
#include "bench/metrics/catalogue.h"
#include "bench/model/recording.h"
#include "bench/process/pinned_environment.h"
#include "bench/results/folder.h"
#include "bench/tasks/base/sensor_key.h"
#include "bench/tasks/registry.h"
#include "bench/training/genetic_search.h"
#include "engine/base/digest.h"
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
                     {"note", clip.note}});
  }
  return clips;
}

/// True if a task of another kind sees by the cameras of the capture task.
bool IsFilmed(const Scenario& scenario) {
  return std::ranges::any_of(scenario.conditions, [](const Condition& condition) {
    const Node* sensor = condition.node.Find(kSensorKey);
    return sensor != nullptr && sensor->scalar == kCameraSensor;
  });
}

/// Describes the clips, then the recordings of people.
Json DescribeMotions(const PreparedScenario& scenario) {
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

std::string DigestOf(const std::vector<std::string>& texts) {
  Digest digest;
  for (const std::string& text : texts) digest.Add(text + "\n");
  return digest.Hex();
}

/// The digest of all libraries that a worker may load, by their build IDs: those of the program, renderer and codecs, and
/// of the genetic search.
std::string DigestOfLibraries() {
  static_cast<void>(LoadRenderer());  // where one is missing, the digest tells that
  static_cast<void>(LoadGeneticSearch());
  std::vector<std::string> texts;
  for (const auto& [name, build] : LoadedLibraries()) texts.push_back(name + " " + build);
  return DigestOf(texts);
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

Result<Json> ReadManifestJson(const std::filesystem::path& path) {
  auto json = ReadJsonFile(path);
  if (!json) return json;
  const Json schema = json->is_object() ? json->value("schema", Json()) : Json();
  if (schema != kResultSchema) {
    return Fail({path.string(), 0, 0}, "not a manifest of schema {} (found {})", kResultSchema, schema.dump());
  }
  return json;
}

}  // namespace

Json MakeManifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios, const std::string& version) {
  Json json{{"schema", kResultSchema},
            {"etude", version},
            {"compiler", __VERSION__},
            {"packages", ETUDE_PACKAGES},
            {"glibc", gnu_get_libc_version()},
            {"libraries", DigestOfLibraries()},
            {"environment", DigestOf(PinnedEnvironment())}};
  json.update(EncodeSetup(WithCanonicalNames(suite)));
  for (const TaskKind& kind : AllTaskKinds()) {
    for (const std::string& id : kind.metrics) json["metrics"][id] = FindMetric(id)->version;
  }
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    json["scenarios"][s]["loaded_clips"] = DescribeMotions(scenarios[s]);
    const TaskKind& kind = *FindTaskKind(IsFilmed(scenarios[s].scenario()) ? "capture" : scenarios[s].scenario().task);
    if (kind.platform != nullptr) json["scenarios"][s]["platform"] = kind.platform();
  }
  return json;
}

Result<SuiteSetup> ReadManifest(const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(const auto json, ReadManifestJson(path));
  return DecodeSetup(json, {path.string(), 0, 0});
}

Result<void> CheckClips(const std::filesystem::path& path, std::span<const PreparedScenario> scenarios) {
  ASSIGN_OR_RETURN(const auto json, ReadManifestJson(path));
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    const Json now = DescribeMotions(scenarios[s]);
    const Json then = json.at("scenarios").at(s).value("loaded_clips", Json::array());
    if (now == then) continue;
    for (std::size_t c = 0; c < std::max(now.size(), then.size()); ++c) {
      if (c < now.size() && c < then.size() && now[c] == then[c]) continue;
      const auto name = [&](const Json& clips) {
        return c < clips.size() ? clips[c].value("name", "?") + " " + clips[c].value("digest", "?") : "no clip";
      };
      return Fail({path.string(), 0, 0}, "clip {} of scenario {} was {} then and is {} now", c + 1,
                  scenarios[s].scenario().name, name(then), name(now));
    }
  }
  return {};
}

Result<PreparedRun> PrepareRun(const std::filesystem::path& manifest) {
  ASSIGN_OR_RETURN(auto suite, ReadManifest(manifest));
  ASSIGN_OR_RETURN(auto scenarios, PrepareAll(suite));
  RETURN_IF_ERROR(CheckClips(manifest, scenarios));
  return PreparedRun{std::move(suite), std::move(scenarios)};
}

Result<std::string> BuildDigest() {
  ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile("/proc/self/exe"));
  return Digest().Add(std::string_view(bytes)).Hex();
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
