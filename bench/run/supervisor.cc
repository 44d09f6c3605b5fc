#include "bench/run/supervisor.h"

#include <poll.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/results/row_json.h"
#include "bench/run/child_process.h"
#include "bench/run/worker.h"

namespace etude {
namespace {

constexpr int kPollMilliseconds = 200;
constexpr int kMostDeathsInSetup = 3;  // one may be chance (out of memory, a stray kill); a row of them is not

struct Worker {
  ChildProcess process;
  bool ready = false;                ///< its set-up is done
  std::optional<std::size_t> world;  ///< the one it works on
  bool dismissed = false;            ///< it ended, and no other takes its place
};

class Supervisor {
 public:
  Supervisor(std::span<const PreparedScenario> scenarios, std::span<const World> worlds,
             const SupervisorOptions& options, const std::function<Result<void>(WorldAnswer)>& deliver)
      : scenarios_(scenarios), worlds_(worlds), options_(options), deliver_(deliver) {}

  Result<bool> Run(const SuiteSetup& setup) {
    const auto setup_line = WriteJson(EncodeSetup(setup));
    if (!setup_line) return tl::unexpected(setup_line.error());
    setup_line_ = *setup_line;
    const std::size_t jobs = std::min<std::size_t>(options_.jobs, worlds_.size());
    while (workers_.size() < jobs) {
      auto worker = StartWorker();
      if (!worker && !workers_.empty()) break;  // fewer do the same work
      if (!worker) return tl::unexpected(worker.error());
      workers_.push_back(std::move(*worker));
    }
    while (delivered_ < worlds_.size()) {
      if (options_.stop != nullptr && *options_.stop) return false;
      if (auto stepped = Step(); !stepped) return tl::unexpected(stepped.error());
    }
    return true;
  }

 private:
  Result<Worker> StartWorker() {
    auto process = ChildProcess::Start(options_.program, {"worker"});
    if (!process) return tl::unexpected(process.error());
    process->Send(setup_line_);  // a worker that is already dead is noticed when it is polled
    return Worker{std::move(*process), false, std::nullopt, false};
  }

  void HandOut(Worker& worker) {
    worker.world.reset();
    if (next_ == worlds_.size()) return;
    worker.world = next_++;
    const World& world = worlds_[*worker.world];
    worker.process.Send(fmt::format("[{},{},{}]", world.scenario, world.condition, world.trial));
  }

  Result<void> Step() {
    std::vector<pollfd> outputs;
    for (const Worker& worker : workers_) outputs.push_back({worker.process.output(), POLLIN, 0});
    ::poll(outputs.data(), outputs.size(), kPollMilliseconds);
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      if (outputs[i].revents == 0) continue;
      const bool alive = workers_[i].process.Receive();
      while (const auto line = workers_[i].process.NextLine()) {
        if (auto taken = Take(workers_[i], *line); !taken) return taken;
      }
      if (alive) continue;
      if (auto replaced = Replace(workers_[i]); !replaced) return replaced;
    }
    std::erase_if(workers_, [](const Worker& worker) { return worker.dismissed; });
    return {};
  }

  Result<void> Take(Worker& worker, const std::string& line) {
    if (worker.ready) return TakeAnswer(worker, line);
    if (line != kWorkerReady) return Fail({}, "a worker said '{}' instead of '{}'", line.substr(0, 60), kWorkerReady);
    worker.ready = true;
    deaths_in_setup_ = 0;
    HandOut(worker);
    return {};
  }

  Result<void> TakeAnswer(Worker& worker, const std::string& line) {
    if (!worker.world) return Fail({}, "a worker answered without being asked");
    const Place place{"a worker's answer", 0, 0};
    WorldAnswer answer{*worker.world, {}, 0, 0};
    const auto json = ReadJson(line, place.file);
    try {
      if (!json) return tl::unexpected(json.error());
      for (const Json& cell : json->at("cells")) {
        auto row = DecodeCell(cell, place);
        if (!row) return tl::unexpected(row.error());
        answer.rows.push_back(std::move(*row));
      }
      answer.wall_s = json->at("wall_s").get<double>();
      answer.cpu_s = json->at("cpu_s").get<double>();
    } catch (const Json::exception& error) {
      return Fail(place, "{}", error.what());
    }
    HandOut(worker);
    ++delivered_;
    return deliver_(std::move(answer));
  }

  /// Turns the death of a worker into rows, and starts another while there is work.
  Result<void> Replace(Worker& worker) {
    const std::string end = worker.process.Finish();
    if (!worker.ready && ++deaths_in_setup_ == kMostDeathsInSetup) {
      return Fail({}, "{} workers in a row ended in their set-up, the last with {}", kMostDeathsInSetup, end);
    }
    const std::optional<std::size_t> lost = worker.world;
    if (lost) {
      const World& world = worlds_[*lost];
      ++delivered_;
      auto delivered = deliver_({*lost,
                                 scenarios_[world.scenario].RowsWithoutResult(
                                     world.condition, world.trial, Status::kCrashed, "its worker ended with " + end),
                                 0, 0});
      if (!delivered) return delivered;
    }
    if (next_ == worlds_.size()) {
      worker.dismissed = true;
      return {};
    }
    auto next = StartWorker();
    if (!next) return tl::unexpected(next.error());
    worker = std::move(*next);
    return {};
  }

  std::span<const PreparedScenario> scenarios_;
  std::span<const World> worlds_;
  const SupervisorOptions& options_;
  const std::function<Result<void>(WorldAnswer)>& deliver_;
  std::string setup_line_;
  std::vector<Worker> workers_;
  std::size_t next_ = 0;
  std::size_t delivered_ = 0;
  int deaths_in_setup_ = 0;  ///< since a worker last became ready
};

}  // namespace

Result<bool> RunWorlds(const SuiteSetup& setup, std::span<const PreparedScenario> scenarios,
                       std::span<const World> worlds, const SupervisorOptions& options,
                       const std::function<Result<void>(WorldAnswer)>& deliver) {
  if (worlds.empty()) return true;
  return Supervisor(scenarios, worlds, options, deliver).Run(setup);
}

}  // namespace etude
