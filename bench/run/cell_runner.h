#pragma once

#include <map>
#include <memory>
#include <string>

#include "bench/model/row.h"
#include "bench/outside/outside_method.h"
#include "bench/run/outside_metrics.h"
#include "bench/run/setup.h"
#include "io/process/clock.h"

namespace etude {

struct FinishedCell {
  Row row;
  CellUsage usage;
  /// False: the method has answered, but other programs have yet to measure its answer (CellRunner::Measure).
  bool is_measured = true;
  /// Why this machine could not ask the method; there is no row then; "" = no fault.
  std::string why_not_run = {};
};

/// Scores an outside answer, and adds its digest to those of the cell. Fails like TaskWorld::Judge.
Result<CellResult> JudgeAnswer(TaskWorld& world, const Json& answer);

/// Runs cells, world after world. Each world is built once; outside methods keep running between worlds.
class CellRunner {
 public:
  /// Outside methods run in `fence`. Their standard error goes to files in `error_folder`; "" = to our own.
  CellRunner(const PreparedScenario& scenario, std::string error_folder, const Fence& fence);
  ~CellRunner();

  /// Builds the world. If that fails, every cell of the world reports the failure.
  void Open(int condition, int trial);
  /// Runs a method in the open world. An exception gives a failed row. If memory runs out, the cell is `out_of_memory`
  /// if it held more than the scenario allows; otherwise the machine has too little, and the cell is not run. Metric
  /// programs do not measure here, because they would learn the truth of the world before all methods have answered.
  FinishedCell Run(std::size_t method);
  /// Lets programs measure an answered cell. A run does so when all methods have answered (RunOrders).
  FinishedCell Measure(int condition, FinishedCell answered);

 private:
  /// The peak resident size of this process. Reading it takes as long as a short cell, so the value is cached briefly.
  class PeakMemory {
   public:
    void Begin();
    double Mb();

   private:
    static constexpr std::chrono::milliseconds kLookEvery{5};
    Clock::time_point looked_ = {};
    double mb_ = 0;
  };

  /// Returns the result of a cell that ended with an exception, or sets `why_not_run_`.
  CellResult Thrown(const std::string& when, const std::exception& error);
  /// Removes the motion of a measured cell unless it is to be recorded, and adds the metrics that the cell does not
  /// report.
  void Complete(int condition, Row& row) const;
  CellResult RunMethod(std::size_t method, CellUsage& usage);
  CellResult AskOutside(std::size_t method, CellUsage& usage);
  /// Returns why an outside method was not asked, with its name.
  std::string WhyNotAsked(std::size_t method, const std::string& reason) const;
  CellResult RunWithProgram(std::size_t method, CellUsage& usage);
  std::size_t IndexInTask(std::size_t method) const;
  /// Returns the message that precedes the first problem, or the result of the cell if it cannot be made.
  tl::expected<const Payload*, CellResult> OpenSetting();
  std::string SettingId() const;

  const PreparedScenario& scenario_;
  const std::string error_folder_;
  std::map<std::size_t, OutsideMethod> outside_;  ///< key: index of the method
  OutsideMetrics metrics_;
  int condition_ = 0, trial_ = 0;
  std::unique_ptr<TaskWorld> world_;
  CellResult why_no_world_;
  std::string why_not_run_;        ///< of the current cell
  std::string why_world_not_run_;  ///< of all cells, if the world could not be built
  CellUsage world_usage_;
  PeakMemory peak_memory_;
  std::unique_ptr<Payload> setting_, problem_;  ///< of the open world; null until needed
  int condition_of_setting_ = -1, trial_of_setting_ = -1;
};

}  // namespace etude
