#include "bench/files/files.h"
#include "bench/run/suite.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/sensor_commands.h"
#include "reports/clips/contact_sheet.h"

namespace etude {
namespace {

Result<void> WriteSheet(const SensorSheetOptions& options) {
  RunOptions run;
  run.scenarios = {options.scenario};
  run.seed = options.seed;
  run.clips = options.clips;
  ASSIGN_OR_RETURN(const auto suite, ReadSuite(run));
  ASSIGN_OR_RETURN(const auto scenarios, PrepareAll(suite));
  if (scenarios.empty()) return Fail({options.scenario, 0, 0}, "holds no scenario");
  const PreparedScenario& first = scenarios.front();
  const auto world = first.task(0).MakeWorld(first.KeyOf(0), /*keeps_motion=*/false);
  if (const auto why = world->WhySkipped()) return Fail({options.scenario, 0, 0}, "{}", *why);
  const auto sheet = world->MakeSensorSheet();
  if (!sheet) return Fail({options.scenario, 0, 0}, "{}", sheet.error().message);
  ASSIGN_OR_RETURN(const auto png, DrawSensorSheet(*sheet));
  return WriteFileAtomically(options.output, png);
}

}  // namespace

int SensorSheetCommand(const SensorSheetOptions& options) {
  if (!options.output.ends_with(".png")) {
    return Complain({{options.output, 0, 0}, "is no picture's name; allowed: .png"});
  }
  if (auto free = CheckOutput(options.output, options.overwrite); !free) return Complain(free.error());
  if (auto written = WriteSheet(options); !written) return Complain(written.error());
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace etude
