#include "bench/run/manifest.h"

#include <sys/utsname.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/results/folder.h"
#include "bench/run/child_process.h"
#include "engine/base/digest.h"

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

}  // namespace

Json MakeManifest(const SuiteSetup& suite, std::span<const PreparedScenario> scenarios, const std::string& version) {
  Json json{{"schema", kResultSchema}, {"etude", version}, {"compiler", __VERSION__}};
  json.update(EncodeSetup(suite));
  for (std::size_t s = 0; s < scenarios.size(); ++s) {
    Json clips = Json::array();
    for (const LibraryClip& clip : scenarios[s].clips().clips) {
      Digest digest;
      for (const BodyPose& pose : clip.motion.poses) {
        for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
      }
      clips.push_back({{"name", clip.name},
                       {"source", clip.source},
                       {"frames", clip.motion.poses.size()},
                       {"digest", digest.Hex()},
                       {"note", clip.note}});
    }
    json["scenarios"][s]["digest"] = Digest().Add(suite.scenarios[s].text).Hex();
    json["scenarios"][s]["loaded_clips"] = std::move(clips);
  }
  return json;
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
