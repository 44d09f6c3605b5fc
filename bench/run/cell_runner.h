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
  /// False if the method has answered, but other programs must still measure its answer (CellRunner::Measure).
  bool is_measured = true;
  /// The reason why this machine could not ask the method; the cell then gets no row. "" = no fault.
  std::string why_not_run = {};
};

/// Scores an outside method's answer, and adds the answer's digest to the digests of the result. Fails if
/// TaskWorld::Judge fails.
Result<CellResult> JudgeAnswer(TaskWorld& world, const Json& answer);

/// Runs the cells of one world after another. Each world is built once. Outside methods keep running between worlds.
class CellRunner {
 public:
  /// Outside methods run in `fence`. Their standard error goes to files in `error_folder`; "" = to Etude's standard
  /// error.
  CellRunner(const PreparedScenario& scenario, std::string error_folder, const Fence& fence);
  ~CellRunner();

  /// Builds the world. If that fails, all cells of the world end with that failure.
  void Open(int condition, int trial);
  /// Runs a method in the open world. An exception gives a row of status `failed`. If memory runs out and the cell held
  /// more memory than the scenario allows, its status is `out_of_memory`; if it held less, the machine has too little
  /// memory, and the cell is not run. Metric programs are not asked here, because they would learn the truth of the
  /// world before all methods have answered.
  FinishedCell Run(std::size_t method);
  /// Asks the metric programs to measure an answered cell. A run calls this after all methods have answered
  /// (RunOrders).
  FinishedCell Measure(int condition, FinishedCell answered);

 private:
  /// Measures the peak resident size of this process. Reading it takes as long as running a short cell, so the value is
  /// cached for 5 ms.
  class PeakMemory {
   public:
    void Begin();
    double Mb();

   private:
    static constexpr std::chrono::milliseconds kLookEvery{5};
    Clock::time_point looked_ = {};
    double mb_ = 0;
  };

  /// Returns the result of a cell that ended with an exception. Sets `why_not_run_` instead if this machine is the
  /// cause.
  CellResult Thrown(const std::string& when, const std::exception& error);
  /// Removes the motion of a measured cell if it must not be recorded, and adds the metrics that the cell does not
  /// report.
  void Complete(int condition, Row& row) const;
  CellResult RunMethod(std::size_t method, CellUsage& usage);
  CellResult AskOutside(std::size_t method, CellUsage& usage);
  /// Returns the name of an outside method and the reason why it was not asked.
  std::string WhyNotAsked(std::size_t method, const std::string& reason) const;
  CellResult RunWithProgram(std::size_t method, CellUsage& usage);
  std::size_t IndexInTask(std::size_t method) const;
  /// Returns the setting, which is sent before the first problem. If it cannot be made, returns the result of the cell.
  tl::expected<const Payload*, CellResult> OpenSetting();
  std::string SettingId() const;

  const PreparedScenario& scenario_;
  const std::string error_folder_;
  std::map<std::size_t, OutsideMethod> outside_;  ///< key: index of the method
  OutsideMetrics metrics_;
  int condition_ = 0, trial_ = 0;
  std::unique_ptr<TaskWorld> world_;
  CellResult why_no_world_;
  std::string why_not_run_;        ///< why the current cell could not be run
  std::string why_world_not_run_;  ///< why no cell could be run, if the world could not be built
  CellUsage world_usage_;
  PeakMemory peak_memory_;
  std::unique_ptr<Payload> setting_, problem_;  ///< setting and problem of the open world; null until needed
  int condition_of_setting_ = -1, trial_of_setting_ = -1;
};

}  // namespace etude
