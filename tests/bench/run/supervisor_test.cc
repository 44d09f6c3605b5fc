#include "bench/run/supervisor.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/files/temporary_folder.h"
#include "bench/run/outside_programs.h"
#include "bench/run/worker.h"
#include "engine/base/machine.h"
#include "tests/bench/run/prepared.h"

namespace etude {
namespace {

using testing::HasSubstr;

/// Puts a worker of one's own in the place of the program: a shell script that is called with `worker`.
class SupervisorTest : public testing::Test {
 protected:
  explicit SupervisorTest(const std::string& limits = "{time_s: 0.3, memory_mb: 4096}")
      : suite_(SmallSuite(kSmallScenario + "limits: " + limits + "\n")) {}

  void SetUp() override {
    ::signal(SIGPIPE, SIG_IGN);
    auto made = TemporaryFolder::Make("supervisor-test");
    ASSERT_TRUE(made);
    folder_.emplace(std::move(*made));
  }

  /// Runs all worlds with workers that behave as `script` says; fills rows_ by cell.
  Result<bool> RunWith(const std::string& script, int jobs = 1) {
    const std::string path = (folder_->path() / "worker").string();
    std::ofstream(path) << "#!/bin/sh\nread -r setup\n" << script;
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return RunOrders(suite_, plan_, plan_.OrdersFor({}, std::vector<bool>(plan_.cell_count())),
                     {.program = path, .error_folder = "", .jobs = jobs, .stop = nullptr},
                     [&](const DeliveredCell& cell) -> Result<void> {
                       ASSIGN_OR_RETURN(const auto finished, cell.Read(plan_));
                       EXPECT_TRUE(rows_.emplace(cell.head.cell, finished.row).second)
                           << cell.head.cell << " came twice";
                       return {};
                     });
  }

  /// Every cell has its row, with this status and a reason that contains `why`.
  void ExpectAll(Status status, const std::string& why) const {
    ASSERT_EQ(rows_.size(), plan_.cell_count());
    for (const auto& [cell, row] : rows_) {
      EXPECT_EQ(row.Id(), plan_.IdentityOf(cell).Id());
      EXPECT_EQ(StatusName(row.result.status), StatusName(status));
      EXPECT_THAT(row.result.reason, HasSubstr(why));
      EXPECT_FALSE(row.result.metrics.empty());  // named as missing, or with the value that failing has
    }
  }

  const SuiteSetup suite_;
  const std::vector<PreparedScenario> scenarios_ = Prepared(suite_);
  const Plan plan_{scenarios_};
  std::optional<TemporaryFolder> folder_;
  std::map<std::size_t, Row> rows_;
};

class NarrowSupervisorTest : public SupervisorTest {
 protected:
  NarrowSupervisorTest() : SupervisorTest("{time_s: 60, memory_mb: 30}") {}
};

TEST_F(SupervisorTest, EndsWhenWorkersKeepDyingInTheirSetupAndLosesNoWorld) {
  const auto whole = RunWith("exit 1", 2);
  ASSERT_FALSE(whole);
  EXPECT_THAT(ToString(whole.error()), HasSubstr("3 workers in a row failed in their set-up"));
  EXPECT_THAT(ToString(whole.error()), HasSubstr("exit code 1"));
  EXPECT_TRUE(rows_.empty());
}

TEST_F(SupervisorTest, AWorkerThatDiesInACellTakesOnlyThatCellWithIt) {
  const auto whole = RunWith("echo ready\nread -r order\necho built\nkill -SEGV $$\n");
  ASSERT_TRUE(whole && *whole);
  ExpectAll(Status::kCrashed, "its worker ended with signal 11");
}

TEST_F(SupervisorTest, AWorldThatCannotBeBuiltTakesAllItsMethodsWithIt) {
  const auto whole = RunWith("echo ready\nread -r order\nexit 3\n", 2);
  ASSERT_TRUE(whole && *whole);
  ExpectAll(Status::kCrashed, "ended with exit code 3 while its world was being built");
}

TEST_F(SupervisorTest, AWorkerThatHangsIsEndedInTime) {
  const auto whole = RunWith("echo ready\nread -r order\necho built\nsleep 100\n", 4);
  ASSERT_TRUE(whole && *whole);
  ExpectAll(Status::kTimeout, "took longer than 0.3 s");
}

TEST_F(NarrowSupervisorTest, AWorkerThatGrowsIsEnded) {
  // As a shell's variable grows, so does the shell; it is stopped long before it would hurt the machine.
  const auto whole =
      RunWith("echo ready\nread -r order\necho built\nx=0123456789abcdef\nwhile :; do x=$x$x; done\n", 2);
  ASSERT_TRUE(whole && *whole);
  ExpectAll(Status::kOutOfMemory, "held more than 30 MB of memory");
}

TEST_F(SupervisorTest, AWorkerThatTalksNonsenseGivesBadOutput) {
  for (const char* nonsense : {"hello", "{}", R"({\"row\":{}})"}) {
    rows_.clear();
    const auto whole =
        RunWith(std::string("echo ready\nread -r order\necho built\necho \"") + nonsense + "\"\nread -r more\n");
    ASSERT_TRUE(whole && *whole);
    ExpectAll(Status::kBadOutput, "its worker answered with something else");
  }
}

TEST_F(SupervisorTest, CellsThatThisMachineKeepsFromBeingRunHaveNoRowAndEndTheRunWithTheCause) {
  FinishedCell finished;
  finished.row.result = CellResult::Ended(Status::kOk, "");
  const auto whole = RunWith("echo ready\nread -r order\necho built\ncat <<'END'\n" + EncodeCellLine(0, finished) +
                             "\nEND\necho not run: no room left\nwhile read -r order; do echo built; "
                             "echo not run: no room at all; echo not run: no room; done\n");
  ASSERT_FALSE(whole);
  EXPECT_TRUE(IsOfThisMachine(whole.error()));
  EXPECT_EQ(ToString(whole.error()),
            fmt::format("this machine: {} cells were not run: no room left", plan_.cell_count() - 1));
  EXPECT_EQ(rows_.size(), 1u);
}

TEST_F(SupervisorTest, WhatAWorkerThatThisMachineEndsWasAtIsNotRun) {
  for (const std::string& end : {fmt::format("exit {}", kCannotGoOn), std::string("kill -XCPU $$")}) {
    rows_.clear();
    const auto in_cell = RunWith("echo ready\nread -r order\necho built\n" + end + "\n", 2);
    ASSERT_FALSE(in_cell);
    EXPECT_TRUE(IsOfThisMachine(in_cell.error())) << ToString(in_cell.error());
    EXPECT_THAT(ToString(in_cell.error()), HasSubstr(fmt::format("{} cells were not run: ", plan_.cell_count())));
    const auto in_world = RunWith("echo ready\nread -r order\n" + end + "\n");
    ASSERT_FALSE(in_world);
    EXPECT_THAT(ToString(in_world.error()), HasSubstr(fmt::format("{} cells were not run: ", plan_.cell_count())));
    EXPECT_TRUE(rows_.empty());
  }
}

/// Takes so many bytes and no more, as a pipe or a disk at its end.
class FullBuffer : public std::streambuf {
 public:
  explicit FullBuffer(std::size_t room) : room_(room) {}
  const std::string& taken() const { return taken_; }

 private:
  int_type overflow(int_type c) override {
    if (taken_.size() == room_) return traits_type::eof();
    taken_ += traits_type::to_char_type(c);
    return c;
  }

  std::string taken_;
  std::size_t room_;
};

TEST_F(SupervisorTest, AWorkerWhoseAnswersCannotBeWrittenEnds) {
  const Json setup{{"setup", EncodeSetup(suite_)}, {"error_folder", ""}, {"fence", EncodeFence({})}, {"key", ""}};
  const std::string order = R"({"world":[0,0,0],"first_cell":0,"methods":[0,1]})";
  const std::string words = *WriteJson(setup) + "\n" + order + "\n";
  std::istringstream all(words);
  std::ostringstream said;
  EXPECT_EQ(RunWorker(all, said), 0) << "the control";
  for (const std::size_t room : {std::size_t{0}, std::string("ready\n").size(), std::string("ready\nbuilt\n").size()}) {
    FullBuffer buffer(room);
    std::ostream full(&buffer);
    std::istringstream in(words);
    EXPECT_EQ(RunWorker(in, full), kCannotGoOn) << room;
    EXPECT_EQ(buffer.taken(), said.str().substr(0, room));
  }
}

TEST_F(SupervisorTest, AnAnswerForAnotherCellIsNotTaken) {
  const std::string row = EncodeCellLine(plan_.cell_count(), FinishedCell());
  const auto whole = RunWith("echo ready\nread -r order\necho built\ncat <<'END'\n" + row + "\nEND\nread -r more\n");
  ASSERT_TRUE(whole && *whole);
  ExpectAll(Status::kBadOutput, "its worker answered with something else");
}

TEST_F(SupervisorTest, AWorkerIsGivenWorldsAheadAndLosesOnlyTheOneThatItWasAt) {
  // One that answers two worlds at once and then dies: of all that it held, the third alone is lost.
  const auto line = [&](std::size_t cell) {
    FinishedCell finished;
    finished.row.result = CellResult::Ended(Status::kOk, "");
    return EncodeCellLine(cell, std::move(finished));
  };
  std::string script = "echo ready\n";
  for (std::size_t world = 0; world < 2; ++world) {
    script += "read -r order\necho built\ncat <<'END'\n" + line(2 * world) + "\n" + line(2 * world + 1) + "\nEND\n";
  }
  const auto whole = RunWith("if [ ! -e '" + (folder_->path() / "died").string() + "' ]; then touch '" +
                             (folder_->path() / "died").string() + "'\n" + script +
                             "read -r order\necho built\nkill -SEGV $$\nfi\necho ready\nread -r order\nexit 3\n");
  ASSERT_TRUE(whole && *whole);
  ASSERT_EQ(rows_.size(), plan_.cell_count());
  for (std::size_t cell = 0; cell < 4; ++cell) EXPECT_EQ(rows_[cell].result.status, Status::kOk);
  EXPECT_THAT(rows_[4].result.reason, HasSubstr("signal 11"));
  for (std::size_t cell = 5; cell < plan_.cell_count(); ++cell) {
    EXPECT_THAT(rows_[cell].result.reason, HasSubstr("exit code 3 while its world was being built")) << cell;
  }
}

}  // namespace
}  // namespace etude
