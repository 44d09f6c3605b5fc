#include "bench/run/supervisor.h"

#include <gmock/gmock.h>
#include <signal.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/run/outside_programs.h"
#include "bench/run/worker.h"
#include "engine/base/machine.h"
#include "io/files/temporary_folder.h"
#include "tests/bench/run/prepared.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Replaces the worker program by a shell script, which is called with `worker`.
class SupervisorTest : public ::testing::Test {
 protected:
  explicit SupervisorTest(const std::string& limits = "{time_s: 0.3, memory_mb: 4096}")
      : suite_(SmallSuite(kSmallScenario + "limits: " + limits + "\n")) {}

  void SetUp() override {
    ::signal(SIGPIPE, SIG_IGN);
    auto made = TemporaryFolder::Make("supervisor-test");
    ASSERT_TRUE(made);
    folder_.emplace(std::move(*made));
  }

  /// Runs all worlds with workers that execute `script`; fills rows_ by cell.
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

  /// Checks that every cell has a row with this status and a reason that contains `why`.
  void ExpectAll(Status status, const std::string& why) const {
    ASSERT_EQ(rows_.size(), plan_.cell_count());
    for (const auto& [cell, row] : rows_) {
      EXPECT_EQ(row.Id(), plan_.IdentityOf(cell).Id());
      EXPECT_EQ(StatusName(row.result.status), StatusName(status));
      EXPECT_THAT(row.result.reason, HasSubstr(why));
      EXPECT_TRUE(status == Status::kOk ||
                  !row.result.metrics.empty());  // metrics are listed as missing, or with the value that a failure has
    }
  }

  const SuiteSetup suite_;
  const std::vector<PreparedScenario> scenarios_ = Prepared(suite_);
  const Plan plan_{scenarios_};
  std::optional<TemporaryFolder> folder_;
  std::map<std::size_t, Row> rows_;
};

class HurriedSupervisorTest : public SupervisorTest {
 protected:
  HurriedSupervisorTest() : SupervisorTest("{time_s: 0.05, memory_mb: 4096}") {}
};

class NarrowSupervisorTest : public SupervisorTest {
 protected:
  NarrowSupervisorTest() : SupervisorTest("{time_s: 60, memory_mb: 30}") {}
};

TEST_F(SupervisorTest, EndsWhenWorkersKeepDyingInTheirSetupAndLosesNoWorld) {
  const auto whole = RunWith("exit 1", 2);
  ASSERT_FALSE(whole);
  EXPECT_THAT(ToString(whole.error()), HasSubstr("3 workers in a row failed before they were ready"));
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

TEST_F(HurriedSupervisorTest, AWorkerThatComputesTooLongIsEnded) {
  for (const std::string built : {"", "echo built\n"}) {
    rows_.clear();
    const auto whole = RunWith("echo ready\nread -r order\n" + built + "while :; do :; done\n", 2);
    ASSERT_TRUE(whole && *whole);
    ExpectAll(Status::kTimeout, "took longer than 0.05 s of processor time");
  }
}

TEST_F(SupervisorTest, NeitherWaitingNorWhatWasBeforeAWorldIsATimeout) {
  FinishedCell finished;
  finished.row.result = CellResult::Ended(Status::kOk, "");
  // The set-up computes for longer than the limit. Then the worker waits, as on a busy machine, twice for 0.6 s of
  // wall-clock time, which is twice the limit. Later workers exit when they get an order.
  const auto whole = RunWith(
      "[ ! -e $0.was ] || exec sh -c 'echo ready; read order'\n: > $0.was\n"
      "i=0\nwhile [ $i -lt 400000 ]; do i=$((i+1)); done\necho ready\nread -r order\nsleep 0.6\necho built\n"
      "sleep 0.6\ncat <<'END'\n" +
      EncodeCellLine(0, finished) + "\nEND\nexit 0\n");
  ASSERT_TRUE(whole && *whole);
  EXPECT_EQ(StatusName(rows_.at(0).result.status), StatusName(Status::kOk)) << rows_.at(0).result.reason;
}

TEST_F(HurriedSupervisorTest, AWorkerThatWaitsForeverIsEndedAndThisMachineIsToBlame) {
  const auto whole = RunWith("echo ready\nread -r order\necho built\nsleep 100\n", 4);
  ASSERT_FALSE(whole);
  EXPECT_TRUE(IsOfThisMachine(whole.error()));
  EXPECT_THAT(ToString(whole.error()), HasSubstr("this machine: a worker reached its limit of wall-clock time after"));
  EXPECT_THAT(ToString(whole.error()),
              HasSubstr(fmt::format("s of processor time; cells not run: {}", plan_.cell_count())));
  EXPECT_TRUE(rows_.empty());
}

TEST_F(NarrowSupervisorTest, AWorkerThatGrowsIsEnded) {
  // The shell grows with its variable; it is stopped at 30 MB.
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
    ExpectAll(Status::kBadOutput, "its worker sent an unexpected answer");
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
            fmt::format("this machine: no room left; cells not run: {}", plan_.cell_count() - 1));
  EXPECT_EQ(rows_.size(), 1u);
}

TEST_F(SupervisorTest, WhatAWorkerThatThisMachineEndsWasAtIsNotRun) {
  for (const std::string& end : {fmt::format("exit {}", kCannotGoOn), std::string("kill -XCPU $$")}) {
    rows_.clear();
    const auto in_cell = RunWith("echo ready\nread -r order\necho built\n" + end + "\n", 2);
    ASSERT_FALSE(in_cell);
    EXPECT_TRUE(IsOfThisMachine(in_cell.error())) << ToString(in_cell.error());
    EXPECT_THAT(ToString(in_cell.error()), HasSubstr(fmt::format("; cells not run: {}", plan_.cell_count())));
    EXPECT_THAT(testing::Refusal(RunWith("echo ready\nread -r order\n" + end + "\n")),
                HasSubstr(fmt::format("; cells not run: {}", plan_.cell_count())));
    EXPECT_TRUE(rows_.empty());
  }
}

/// A stream buffer that accepts `room` bytes, like a full disk or a closed pipe.
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

/// A scenario with an outside metric. Workers are scripts with a fixed reply to each world and to each answered cell.
class MeasuringSupervisorTest : public SupervisorTest {
 protected:
  MeasuringSupervisorTest()
      : SupervisorTest("{time_s: 60, memory_mb: 4096}\nmetrics: [{name: graded, exec: [/bin/true]}]") {}

  std::string LineOf(std::size_t cell, bool is_measured) const {
    FinishedCell finished;
    finished.row.result = CellResult::Ended(Status::kOk, "");
    finished.is_measured = is_measured;
    return EncodeCellLine(cell, std::move(finished));
  }

  /// Returns a worker that logs its first order, each message, and its end. It runs `measure` for an answered cell.
  std::string Worker(const std::string& measure) const {
    std::string world;
    for (std::size_t w = 0; w < plan_.world_count(); ++w) {
      world += fmt::format("*first_cell*:{},*) echo '{}'; echo '{}';;\n", plan_.CellAt(w, 0),
                           LineOf(plan_.CellAt(w, 0), false), LineOf(plan_.CellAt(w, 1), false));
    }
    std::string cells;
    for (std::size_t cell = 0; cell < plan_.cell_count(); ++cell) {
      cells += fmt::format("'{}{},'*) echo '{}';;\n", kAnsweredBegin, cell, LineOf(cell, true));
    }
    return fmt::format(
        "note() {{ echo \"$1\" >> '{}'; }}\nbegan=\necho ready\nwhile read -r order; do\n"
        "[ -n \"$began\" ] || {{ began=1; note begins; }}\n"
        "case $order in '{{\"world\"'*) note world; echo built; case $order in {} esac;;\n"
        "*) note cell; {}\ncase $order in {} esac;; esac\ndone\nsleep 0.1\n[ -z \"$began\" ] || note ends\n",
        Noted(), world, measure, cells);
  }

  std::string Noted() const { return (folder_->path() / "noted").string(); }
  std::vector<std::string> Notes() const {
    std::ifstream in(Noted());
    std::vector<std::string> notes;
    for (std::string note; std::getline(in, note);) notes.push_back(note);
    return notes;
  }
};

TEST_F(MeasuringSupervisorTest, MeasuresWhenAllMethodsHaveAnsweredAndTheirWorkersHaveEnded) {
  for (const int jobs : {1, 2}) {
    rows_.clear();
    std::filesystem::remove(Noted());
    const auto whole = RunWith(Worker(":"), jobs);
    ASSERT_TRUE(whole && *whole);
    ExpectAll(Status::kOk, "");
    std::size_t alive = 0, worlds = 0, cells = 0;
    for (const std::string& note : Notes()) {
      alive += note == "begins" ? 1 : 0;
      alive -= note == "ends" ? 1 : 0;
      worlds += note == "world" ? 1 : 0;
      if (note == "cell" && cells++ == 0) {
        EXPECT_EQ(worlds, plan_.world_count()) << "a method is asked after a metric was";
        EXPECT_LE(alive, static_cast<std::size_t>(jobs)) << "a worker that ran methods lives";
      }
    }
    EXPECT_EQ(worlds, plan_.world_count());
    EXPECT_EQ(cells, plan_.cell_count());
  }
}

TEST_F(MeasuringSupervisorTest, AWorkerThatDiesOverAnAnsweredCellTakesThatAloneWithIt) {
  const std::string once = (folder_->path() / "once").string();
  const auto whole = RunWith(Worker("[ -e '" + once + "' ] || { touch '" + once + "'; kill -SEGV $$; }"));
  ASSERT_TRUE(whole && *whole);
  ASSERT_EQ(rows_.size(), plan_.cell_count());
  EXPECT_THAT(rows_[0].result.reason, HasSubstr("signal 11"));
  for (std::size_t cell = 1; cell < plan_.cell_count(); ++cell) EXPECT_EQ(rows_[cell].result.status, Status::kOk);
}

TEST_F(MeasuringSupervisorTest, NothingIsMeasuredWhereAMethodCouldNotBeAsked) {
  std::string worker = Worker(":");
  const std::string last = LineOf(plan_.cell_count() - 1, false);
  worker.replace(worker.find(last), last.size(), "not run: no room");
  EXPECT_EQ(testing::Refusal(RunWith(worker)), "this machine: no room; cells not run: 1");
  EXPECT_TRUE(rows_.empty());
  EXPECT_EQ(std::ranges::count(Notes(), "cell"), 0);
}

TEST_F(SupervisorTest, AnAnswerThatIsNotMeasuredIsNotTakenWhereNothingMeasures) {
  FinishedCell finished;
  finished.is_measured = false;
  const auto whole = RunWith("echo ready\nread -r order\necho built\ncat <<'END'\n" + EncodeCellLine(0, finished) +
                             "\nEND\nread -r more\n");
  ASSERT_TRUE(whole && *whole);
  EXPECT_EQ(rows_[0].result.status, Status::kBadOutput);
}

TEST_F(SupervisorTest, AnAnswerForAnotherCellIsNotTaken) {
  const std::string row = EncodeCellLine(plan_.cell_count(), FinishedCell());
  const auto whole = RunWith("echo ready\nread -r order\necho built\ncat <<'END'\n" + row + "\nEND\nread -r more\n");
  ASSERT_TRUE(whole && *whole);
  ExpectAll(Status::kBadOutput, "its worker sent an unexpected answer");
}

TEST_F(SupervisorTest, AWorkerIsGivenWorldsAheadAndLosesOnlyTheOneThatItWasAt) {
  // The worker answers two worlds at once, then dies: only the third of its worlds is lost.
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
