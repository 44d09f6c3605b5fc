#include "cli/commands.h"

#include <fmt/core.h>

#include <cstdio>

#include "bench/gate/baseline_file.h"
#include "bench/model/run_data.h"
#include "engine/base/machine.h"
#include "engine/base/utf8.h"

namespace etude {

int Complain(const Error& error) {
  std::fputs(("etude: " + ToString(error) + "\n").c_str(), stderr);
  return IsOfThisMachine(error) ? kIncompleteRun : kUnusableInput;
}

int Finish(const Result<int>& code) { return code ? *code : Complain(code.error()); }

int TellStopped(const Error& what_is_left) {
  Complain(what_is_left);
  return kInterrupted;
}

Result<int> UnlessReplaced(const std::string& folder, const RunData& run, int code) {
  if (CheckStillThere(folder, run)) return code;
  Complain({{folder, 0, 0},
            "changed while Etude wrote files into it: another run replaced the folder, or another program wrote a file "
            "there. Repeat this command"});
  return kIncompleteRun;
}

void TellUnsealed(const std::string& why) {
  if (!why.empty()) std::fputs(("etude: read unsealed: " + Visible(why) + "\n").c_str(), stderr);
}

Result<Snapshot> TakeBaseline(const std::string& path, Sealing sealing) {
  ASSIGN_OR_RETURN(auto baseline, LoadBaseline(path, sealing == Sealing::kIgnored ? BaselineSeal::kMayBreak
                                                                                  : BaselineSeal::kMustHold));
  TellUnsealed(baseline.unsealed);
  return baseline;
}

void PrintList(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  fmt::print("{}\n", title);
  for (const std::string& line : lines) fmt::print("  {}\n", line);
}

}  // namespace etude
