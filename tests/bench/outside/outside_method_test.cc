#include "bench/outside/outside_method.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

Payload Show(Json json, std::vector<Attachment> files = {}) { return PayloadOf(std::move(json), std::move(files)); }

const Fence& FenceOfMethods() {
  static const Fence fence = Fence::Find();
  return fence;
}

OutsideOptions Behaving(const std::string& behaviour, const Fence& fence = {}) {
  OutsideOptions options{.fence = fence};
  options.command = {"python3", "tests/bench/outside/hostile.py", behaviour};
  options.task = "echo";
  options.time_s = 20;
  options.memory_mb = 100;
  options.error_file = ::testing::TempDir() + "standard-error-" + behaviour;
  std::filesystem::remove(options.error_file);
  return options;
}

OutsideReply Ask(OutsideMethod& method, const std::string& id = "p", const std::string& setting = "s") {
  return method.Ask(setting, Show({{"size", 1}, {"name", setting}}), id, Show({{"question", 2}}));
}

std::string ReadText(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(OutsideMethod, AnswersManyProblemsInOneLife) {
  OutsideMethod method(Behaving("works_a_while"));
  double cpu_s = 0;
  for (const char* setting : {"s", "s", "t", "s"}) {
    const OutsideReply reply = Ask(method, "p", setting);
    ASSERT_EQ(reply.status, Status::kOk) << reply.reason;
    EXPECT_EQ(reply.answer->dump(), R"({"number":1})");
    EXPECT_GT(reply.peak_mb, 1);
    EXPECT_GE(reply.cpu_s, 0);  // the kernel may count this time only with the next answer
    cpu_s += reply.cpu_s;
  }
  EXPECT_GT(cpu_s, 0);
  EXPECT_EQ(method.ProgramName(), "hostile 1.0");
  EXPECT_EQ(method.End(5000), "exit code 0");
}

TEST(OutsideMethod, IdsTellNoNamesAndUnderASecretSeedNoLifeSeesTwoSettings) {
  std::string ids_of_plain;
  for (const Seed& seed : {Seed(1), Seed::Secret({1, 2, 3, 4})}) {
    OutsideOptions options = Behaving("tells_its_settings");
    options.seed = seed;
    OutsideMethod method(std::move(options));
    std::string ids;
    for (const char* noise : {"0", "0", "10"}) {
      const std::string setting = std::string("noise=") + noise;
      const OutsideReply reply = Ask(method, setting + "/7", setting);
      ASSERT_EQ(reply.status, Status::kOk) << reply.reason;
      EXPECT_EQ((*reply.answer)["number"], seed.IsPlain() && noise == std::string("10") ? 2 : 1);
      ids = (*reply.answer)["ids"].get<std::string>();
      EXPECT_THAT(ids, ::testing::MatchesRegex("(s[0-9a-f]+ )+p[0-9a-f]+"));
    }
    EXPECT_NE(ids, ids_of_plain);
    ids_of_plain = ids;
  }
}

TEST(OutsideMethod, LargeAnswersAndLargeProblemsPass) {
  OutsideMethod method(Behaving("answers_large"));
  const OutsideReply reply = method.Ask("s", Show({{"size", 1}}), "p", Show({{"text", std::string(5000000, 'x')}}));
  ASSERT_EQ(reply.status, Status::kOk) << reply.reason;
  EXPECT_EQ((*reply.answer)["number"].get<std::string>().size(), 5000000u);
}

TEST(OutsideMethod, NoAnswerIsUnsolvedWithItsReason) {
  OutsideMethod method(Behaving("gives_up"));
  const OutsideReply reply = Ask(method);
  EXPECT_EQ(reply.status, Status::kUnsolved);
  EXPECT_EQ(reply.reason, "gave no answer: 'no way\\x0aout'");
}

struct Hostility {
  std::string behaviour;
  Status status;
  std::string reason;  ///< how it begins
};

class Hostile : public ::testing::TestWithParam<Hostility> {};

TEST_P(Hostile, BecomesTheSameReplyWithAndWithoutAFenceAndTheNextProblemIsPutToANewProgram) {
  const Hostility& hostility = GetParam();
  for (const Fence& fence : {Fence(), FenceOfMethods()}) {
    OutsideMethod method(Behaving(hostility.behaviour, fence));
    const OutsideReply reply = Ask(method);
    EXPECT_EQ(StatusName(reply.status), StatusName(hostility.status));
    EXPECT_THAT(reply.reason, StartsWith(hostility.reason));
    EXPECT_EQ(reply.answer, nullptr);
    EXPECT_EQ(method.End(0), "not running");
  }
}

INSTANTIATE_TEST_SUITE_P(
    OutsideMethod, Hostile,
    ::testing::Values(
        Hostility{"crashes", Status::kCrashed,
                  "ended with signal 11 (Segmentation fault); its last words: 'about to fall'"},
        Hostility{"exits", Status::kFailed, R"(ended with exit code 3, in the middle of the line '{"type": "ans')"},
        Hostility{"prints_garbage", Status::kBadOutput,
                  R"(wrote something that is not JSON: 'loading model \x1b[1m100%\x1b[0m')"},
        Hostility{"answers_nan", Status::kBadOutput,
                  "its message contains NaN, which is not JSON; allowed: finite numbers"},
        Hostility{"answers_minus_infinity", Status::kBadOutput,
                  "its message contains -Infinity, which is not JSON; allowed: finite numbers"},
        Hostility{"answers_beyond_doubles", Status::kBadOutput, "wrote a number that is too large: '"},
        Hostility{"answers_deeply", Status::kBadOutput, "wrote something nested more than 32 levels deep: '[[[["},
        Hostility{"answers_a_key_twice", Status::kBadOutput, "wrote the key 'number' twice in one object: '"},
        Hostility{"answers_bytes", Status::kBadOutput, "wrote something that is not JSON: "},
        Hostility{"answers_behind_a_zero_byte", Status::kBadOutput, "wrote something that is not JSON: a zero byte"},
        Hostility{"answers_without_end", Status::kBadOutput, "wrote a line of more than 16 MiB: 'xxx"},
        Hostility{"answers_another_question", Status::kBadOutput, "answered 'another' when asked 'p"},
        Hostility{"answers_a_list", Status::kBadOutput, "its message 'answer' has no object with the key \"answer\": "},
        Hostility{"chats_after_its_answer", Status::kBadOutput,
                  "after its reply: wrote something that is not JSON: 'done'"},
        Hostility{"begins_a_line_after_its_answer", Status::kBadOutput,
                  "after its reply: wrote a part of a line: 'done '"},
        Hostility{"ends_after_its_answer", Status::kFailed, "after its reply: ended with exit code 0"},
        Hostility{"chats_after_its_setting", Status::kBadOutput,
                  "at setting 's': after its reply: wrote something that is not JSON: 'done'"},
        Hostility{"eats_memory", Status::kOutOfMemory, "held more than 100 MB of memory"},
        Hostility{"lets_a_child_eat_memory", Status::kOutOfMemory, "held more than 100 MB of memory"},
        Hostility{"leaves_a_child_at_its_output", Status::kFailed, "ended with exit code 5"},
        Hostility{"speaks_another_protocol", Status::kBadOutput, "in its start: does not support protocol 1: "}),
    [](const auto& tested) { return tested.param.behaviour; });

TEST(OutsideMethod, GreetsBeforeItIsAskedAnything) {
  OutsideMethod method(Behaving("is_good"));
  EXPECT_EQ(method.ProgramName(), "");
  EXPECT_EQ(method.Greet().status, Status::kOk);
  EXPECT_EQ(method.ProgramName(), "hostile 1.0");
  EXPECT_EQ(Ask(method).status, Status::kOk);
  OutsideMethod silent(Behaving("dies_in_the_handshake"));
  EXPECT_FALSE(silent.Greet().was_asked);
  EXPECT_EQ(silent.ProgramName(), "");
}

TEST(OutsideMethod, ClosingItsOutputIsNoWayToLiveOn) {
  for (const Fence& fence : {Fence(), FenceOfMethods()}) {
    OutsideMethod method(Behaving("closes_its_output", fence));
    const OutsideReply reply = Ask(method);
    EXPECT_EQ(reply.status, Status::kBadOutput);
    EXPECT_EQ(reply.reason, "closed its output, but continued to run");
  }
}

TEST(OutsideMethod, AnOutputMovedToAnotherPlaceIsNotClosed) {
  OutsideOptions options = Behaving("moves_its_output", FenceOfMethods());
  OutsideMethod method(options);
  EXPECT_EQ(Ask(method).status, Status::kOk);
}

TEST(OutsideMethod, TakingTooLongIsATimeout) {
  for (const char* behaviour : {"hangs", "answers_late"}) {
    OutsideOptions options = Behaving(behaviour);
    options.time_s = 0.1;
    OutsideMethod method(options);
    const OutsideReply reply = Ask(method);
    EXPECT_EQ(reply.status, Status::kTimeout);
    EXPECT_EQ(reply.reason, "took longer than 0.1 s");
  }
}

TEST(OutsideMethod, ALateAnswerIsNotTakenForTheNextOne) {
  OutsideOptions options = Behaving("answers_late");
  options.time_s = 0.1;
  OutsideMethod method(options);
  EXPECT_EQ(Ask(method, "first").status, Status::kTimeout);
  EXPECT_EQ(Ask(method, "second").status, Status::kTimeout);
}

TEST(OutsideMethod, AnAnswerGivenAgainIsPassedOverWheneverItComes) {
  for (const char* behaviour : {"answers_twice", "answers_again_after_the_next_question"}) {
    OutsideMethod method(Behaving(behaviour));
    int repeated = 0;
    for (const char* id : {"a", "b", "c", "d"}) {
      const OutsideReply reply = Ask(method, id);
      ASSERT_EQ(reply.status, Status::kOk) << behaviour << ": " << reply.reason;
      EXPECT_EQ(reply.answer->dump(), R"({"number":1})") << behaviour;
      repeated += reply.repeated;
    }
    EXPECT_GE(repeated, 2) << behaviour;
  }
}

TEST(OutsideMethod, WhoOnlyRepeatsItselfTakesTooLong) {
  OutsideOptions options = Behaving("repeats_itself_without_end");
  options.time_s = 3;
  OutsideMethod method(options);
  EXPECT_EQ(Ask(method, "first").status, Status::kOk);
  const OutsideReply second = Ask(method, "second");
  EXPECT_EQ(second.status, Status::kTimeout);
  EXPECT_EQ(second.reason, "took longer than 3 s; it answered an earlier question again instead of this one");
}

TEST(OutsideMethod, WhoNeverReadsIsNotWaitedForLongerThanAllowed) {
  OutsideOptions options = Behaving("never_reads");
  options.time_s = options.start_s = 0.1;
  OutsideMethod method(options);
  const auto start = std::chrono::steady_clock::now();
  const OutsideReply reply = method.Ask("s", Show({{"text", std::string(5000000, 'x')}}), "p", Show({{"question", 2}}));
  EXPECT_EQ(reply.status, Status::kTimeout);
  EXPECT_EQ(reply.reason, "in its start: took longer than 0.1 s");
  EXPECT_FALSE(reply.was_asked);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(500)) << "it would sleep for 1000";
}

TEST(OutsideMethod, AProblemAfterACrashIsAnsweredByANewProgram) {
  OutsideMethod method(Behaving("crashes_at_every_second_problem"));
  for (const Status expected : {Status::kOk, Status::kCrashed, Status::kOk, Status::kCrashed}) {
    EXPECT_EQ(Ask(method).status, expected);
  }
}

TEST(OutsideMethod, AStartThatFailsThreeTimesIsNotTriedAgain) {
  OutsideOptions options = Behaving("dies_in_the_handshake");
  const std::string starts = ::testing::TempDir() + "starts";
  std::filesystem::remove(starts);
  options.command.insert(options.command.end(), {"{}", starts});
  OutsideMethod method(options);
  for (int i = 0; i < 6; ++i) {
    const OutsideReply reply = Ask(method);
    EXPECT_EQ(reply.status, Status::kFailed);
    EXPECT_FALSE(reply.was_asked) << "it never replied to its handshake: the set-up is the cause";
    EXPECT_EQ(reply.reason,
              "in its start: ended with exit code 1; its last words: 'no licence found' "
              "(inside a fence, it can read only the system's files and what its key 'files' lists)");
  }
  EXPECT_EQ(ReadText(starts), "started\nstarted\nstarted\n");
}

TEST(OutsideMethod, AStartThatFailsAfterItOnceSucceededIsTheProgramsOwnFailure) {
  const std::string started = ::testing::TempDir() + "started-once";
  std::filesystem::remove(started);
  OutsideOptions options = Behaving("is_good");
  options.command = {
      "sh", "-c",
      "[ -e " + started + " ] && exit 4; touch " + started +
          "; read hello; echo '{\"type\":\"hello\",\"protocol\":1,\"name\":\"n\",\"version\":\"1\"}'; exit 5"};
  OutsideMethod method(options);
  EXPECT_THAT(Ask(method).reason, HasSubstr("ended with exit code 5"));
  const OutsideReply again = Ask(method);
  EXPECT_THAT(again.reason, StartsWith("in its start: ended with exit code 4"));
  EXPECT_TRUE(again.was_asked);
}

TEST(OutsideMethod, AStartThatTheFencePreventsIsToldWithItsCure) {
  if (!FenceOfMethods().IsUp()) GTEST_SKIP() << FenceOfMethods().description();
  namespace fs = std::filesystem;
  // A manager of interpreters: the command in PATH is a script that starts a program in another folder. Inside the
  // fence, this folder is missing.
  const fs::path home = fs::path(::testing::TempDir()) / "managed";
  fs::remove_all(home);
  for (const char* folder : {"manager/shims", "manager/libexec", "mine"}) fs::create_directories(home / folder);
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(home / name) << text;
    fs::permissions(home / name, fs::perms::owner_all);
    return (home / name).string();
  };
  const std::string manager = write("manager/libexec/run", "#!/bin/sh\nexec /usr/bin/python3 \"$@\"\n");
  const std::string shim = write("manager/shims/python3", "#!/bin/sh\nexec '" + manager + "' \"$@\"\n");
  fs::copy("tests/bench/outside/hostile.py", home / "mine/hostile.py");
  OutsideOptions options = Behaving("is_good", FenceOfMethods());
  options.command = {shim, (home / "mine/hostile.py").string(), "is_good"};
  const OutsideReply reply = OutsideMethod(options).Ask("s", Show({{"size", 1}}), "p", Show({{"question", 2}}));
  EXPECT_FALSE(reply.was_asked);
  EXPECT_THAT(reply.reason, StartsWith("in its start: ended with exit code 127"));
  const std::string whole = (home / "manager").string(), mine = (home / "mine").string();
  EXPECT_THAT(reply.reason, HasSubstr("; " + whole + " cannot be read inside its fence: give it files: ["));
  EXPECT_THAT(reply.reason, HasSubstr(mine));
  // The proposed remedy works.
  options.files = {mine, whole};
  const OutsideReply cured = OutsideMethod(options).Ask("s", Show({{"size", 1}}), "p", Show({{"question", 2}}));
  EXPECT_EQ(cured.status, Status::kOk) << cured.reason;
  fs::remove_all(home);
}

TEST(OutsideMethod, ASettingThatKillsItSparesTheOthers) {
  OutsideMethod method(Behaving("dies_at_a_setting"));
  for (int i = 0; i < 4; ++i) {
    const OutsideReply reply = Ask(method, "p", "fatal");
    EXPECT_EQ(reply.status, Status::kFailed);
    EXPECT_EQ(reply.reason, "at setting 'fatal': ended with exit code 7");
  }
  EXPECT_EQ(Ask(method, "p", "harmless").status, Status::kOk);
}

TEST(OutsideMethod, FilesInItsScratchFoldersAreItsMemory) {
  if (!FenceOfMethods().IsUp()) GTEST_SKIP() << FenceOfMethods().description();
  OutsideOptions options = Behaving("is_good", FenceOfMethods());
  options.command = {"sh", "-c", "for f in /tmp /var/tmp /dev/shm; do head -c 45M /dev/zero >$f/a; done; sleep 20"};
  OutsideMethod method(options);
  const OutsideReply reply = Ask(method);
  EXPECT_EQ(reply.status, Status::kOutOfMemory);
  EXPECT_EQ(reply.reason, "in its start: held more than 100 MB of memory");
}

TEST(OutsideMethod, WhatOfThisMachineKeepsUsFromAskingItIsNoAnswerOfIt) {
  const char* const before = ::getenv("TMPDIR");
  const std::string told = before == nullptr ? "" : before;
  const std::string file = ::testing::TempDir() + "no-folder";
  const OutsideOptions options = Behaving("is_good");
  std::ofstream(file) << "";
  const std::string none = " is not a folder for temporary files";
  for (const auto& [folder, complaint] :
       std::vector<std::pair<std::string, std::string>>{{"/no/such/folder", none + ": "},
                                                        {file, none},
                                                        {"/proc", ": cannot create temporary files in this folder: "},
                                                        {"tests", none + "; allowed: a path that begins with /"}}) {
    ::setenv("TMPDIR", folder.c_str(), 1);
    OutsideMethod method(options);
    const OutsideReply reply = Ask(method);
    EXPECT_FALSE(reply.was_asked);
    EXPECT_THAT(reply.reason, StartsWith("in its start: TMPDIR=" + folder + complaint));
  }
  before == nullptr ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", told.c_str(), 1);
  OutsideMethod fenceless(Behaving("is_good", Fence::Of("/bin/false")));
  const OutsideReply reply = Ask(fenceless);
  EXPECT_FALSE(reply.was_asked);
  EXPECT_THAT(reply.reason, HasSubstr("no program can run in the sandbox (bubblewrap)"));
  OutsideMethod good(Behaving("is_good"));
  EXPECT_TRUE(Ask(good).was_asked);
}

TEST(OutsideMethod, ReasonsDoNotNameTheFoldersOfAttachments) {
  OutsideOptions options = Behaving("is_good");
  options.command = {"sh", "-c",
                     "read hello; echo '{\"type\":\"hello\",\"protocol\":1,\"name\":\"n\",\"version\":\"1\"}';"
                     "read setting; echo '{\"type\":\"ready\"}'; read problem;"
                     "echo \"$problem\" | sed 's/.*\"files\":\"\\([^\"]*\\)\".*/cannot read \\1\\/a.txt/' >&2; exit 1"};
  OutsideMethod method(options);
  for (int i = 0; i < 2; ++i) {
    const OutsideReply reply =
        method.Ask("s", Show({{"size", 1}}), "p", Show({{"question", 2}}, {{"a.txt", "inside"}}));
    EXPECT_EQ(reply.reason, "ended with exit code 1; its last words: 'cannot read FILES/a.txt'");
  }
}

TEST(OutsideMethod, AProgramThatCannotBeFoundIsNotAsked) {
  OutsideOptions options = Behaving("is_good");
  options.command = {"no-such-program"};
  OutsideMethod method(options);
  const OutsideReply reply = Ask(method);
  EXPECT_FALSE(reply.was_asked);
  EXPECT_THAT(reply.reason, HasSubstr("no program 'no-such-program' in PATH"));
}

TEST(OutsideMethod, KeepsAMebibyteOfItsStandardErrorAndItsLastWords) {
  const OutsideOptions options = Behaving("floods_its_standard_error");
  {
    OutsideMethod method(options);
    EXPECT_EQ(Ask(method).status, Status::kOk);
    EXPECT_THAT(Ask(method, "crash").reason, HasSubstr("; its last words: 'about to fall'"));
  }
  EXPECT_EQ(std::filesystem::file_size(options.error_file), std::uintmax_t{1} << 20);
}

TEST(OutsideMethod, MakesTheFolderOfItsStandardErrorWhenItHasSomethingToKeep) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "folder-of-standard-errors";
  std::filesystem::remove_all(folder);
  OutsideOptions silent = Behaving("is_good");
  silent.error_file = folder / "inner" / "silent.txt";
  OutsideMethod quiet(silent);
  EXPECT_EQ(Ask(quiet).status, Status::kOk);
  EXPECT_FALSE(std::filesystem::exists(folder));
  OutsideOptions loud = Behaving("crashes");
  loud.error_file = folder / "inner" / "loud.txt";
  OutsideMethod talker(loud);
  EXPECT_EQ(Ask(talker).status, Status::kCrashed);
  EXPECT_THAT(ReadText(loud.error_file), HasSubstr("about to fall"));
}

TEST(OutsideMethod, AttachmentsLieInAFolderWhileItWorks) {
  for (const Fence& fence : {Fence(), FenceOfMethods()}) {
    OutsideOptions options = Behaving("is_good", fence);
    options.command = {
        "sh", "-c",
        "read hello; echo '{\"type\":\"hello\",\"protocol\":1,\"name\":\"cat\",\"version\":\"1\"}';"
        "read setting; echo '{\"type\":\"ready\"}'; read problem;"
        "folder=$(echo \"$problem\" | sed 's/.*\"files\":\"\\([^\"]*\\)\".*/\\1/');"
        "id=$(echo \"$problem\" | sed 's/.*\"id\":\"\\([^\"]*\\)\".*/\\1/');"
        "echo \"{\\\"type\\\":\\\"answer\\\",\\\"id\\\":\\\"$id\\\",\\\"answer\\\":{\\\"folder\\\":\\\"$folder\\\","
        "\\\"text\\\":\\\"$(cat \"$folder/a.txt\")\\\"}}\"; read x"};
    OutsideMethod method(options);
    const OutsideReply reply =
        method.Ask("s", Show({{"size", 1}}), "p", Show({{"question", 2}}, {{"a.txt", "inside"}}));
    ASSERT_EQ(reply.status, Status::kOk) << reply.reason;
    EXPECT_EQ((*reply.answer)["text"], "inside");
    EXPECT_FALSE(std::filesystem::exists((*reply.answer)["folder"].get<std::string>()));
  }
}

OutsideReply Begin(OutsideMethod& method, const std::string& id = "session") {
  return method.Begin("s", Show({{"size", 1}}), id, Show({{"rate_hz", 30}}));
}

TEST(LiveSession, GoesOnStepByStepInOneLife) {
  OutsideMethod method(Behaving("is_good"));
  for (const char* id : {"first", "second"}) {
    ASSERT_EQ(Begin(method, id).status, Status::kOk);
    for (int i = 0; i < 200; ++i) {
      const OutsideReply reply = method.Step(PayloadOf({{"pose", i}}));
      ASSERT_EQ(reply.status, Status::kOk) << reply.reason;
      EXPECT_EQ(reply.answer->dump(), R"({"number":1})");
    }
  }
  EXPECT_EQ(Ask(method).status, Status::kOk) << "a problem ends the session";
  EXPECT_EQ(method.End(5000), "exit code 0");
}

TEST(LiveSession, AStepAnsweredAgainIsPassedOver) {
  OutsideMethod method(Behaving("answers_a_session_twice"));
  for (const char* id : {"first", "second"}) {
    ASSERT_EQ(Begin(method, id).status, Status::kOk);
    for (int i = 0; i < 5; ++i) {
      const OutsideReply reply = method.Step(PayloadOf(Json::object()));
      ASSERT_EQ(reply.status, Status::kOk) << reply.reason;
      EXPECT_EQ(reply.repeated, i == 3 ? 1 : 0);
    }
  }
}

TEST(LiveSession, WhatIsWrittenAfterTheLastAnswerFailsThisSessionAndNotTheNext) {
  OutsideMethod method(Behaving("chats_after_its_answer"));
  ASSERT_EQ(Begin(method).status, Status::kOk);
  ASSERT_EQ(method.Step(PayloadOf(Json::object())).status, Status::kOk);
  const OutsideReply end = method.EndSession();
  EXPECT_EQ(end.status, Status::kBadOutput);
  EXPECT_EQ(end.reason, "after its reply: wrote something that is not JSON: 'done'");
  ASSERT_EQ(Begin(method, "next").status, Status::kOk);
  OutsideMethod good(Behaving("answers_a_session_twice"));
  ASSERT_EQ(Begin(good).status, Status::kOk);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(good.Step(PayloadOf(Json::object())).status, Status::kOk);
  EXPECT_EQ(good.EndSession().status, Status::kOk);
}

class HostileInASession : public ::testing::TestWithParam<Hostility> {};

TEST_P(HostileInASession, EndsTheSessionAndTheNextOneBeginsAnew) {
  const Hostility& hostility = GetParam();
  OutsideOptions options = Behaving(hostility.behaviour);
  if (hostility.status == Status::kTimeout) options.time_s = 0.1;
  OutsideMethod method(options);
  for (int session = 0; session < 2; ++session) {
    ASSERT_EQ(Begin(method).status, Status::kOk);
    for (int i = 0; i < 2; ++i) ASSERT_EQ(method.Step(PayloadOf(Json::object())).status, Status::kOk);
    const OutsideReply reply = method.Step(PayloadOf(Json::object()));
    EXPECT_EQ(StatusName(reply.status), StatusName(hostility.status));
    EXPECT_THAT(reply.reason, StartsWith(hostility.reason));
    EXPECT_EQ(reply.answer, nullptr);
  }
}

INSTANTIATE_TEST_SUITE_P(
    OutsideMethod, HostileInASession,
    ::testing::Values(
        Hostility{"dies_in_a_session", Status::kFailed, "ended with exit code 1; its last words: 'out of luck'"},
        Hostility{"hangs_in_a_session", Status::kTimeout, "took longer than 0.1 s"},
        Hostility{"prints_garbage_in_a_session", Status::kBadOutput,
                  "at step 2: wrote something that is not JSON: 'loading model"},
        Hostility{"answers_another_step", Status::kBadOutput, "at step 2: answered a step other than 2: "},
        Hostility{"answers_the_next_step_as_well", Status::kBadOutput, "answered before it was asked"},
        Hostility{"gives_up_in_a_session", Status::kUnsolved, "gave no answer: 'no way\\x0aout'"}),
    [](const auto& tested) { return tested.param.behaviour; });

TEST(LiveSession, AnswersAreToSayTheirStep) {
  OutsideMethod method(Behaving("says_no_number"));
  ASSERT_EQ(Begin(method).status, Status::kOk);
  const OutsideReply reply = method.Step(PayloadOf(Json::object()));
  EXPECT_EQ(reply.status, Status::kBadOutput);
  EXPECT_THAT(reply.reason, StartsWith("at step 0: answered a step other than 0: "));
}

TEST(LiveSession, ABeginningIsRepliedToWithReady) {
  OutsideMethod method(Behaving("answers_the_beginning"));
  const OutsideReply reply = Begin(method);
  EXPECT_EQ(reply.status, Status::kBadOutput);
  EXPECT_THAT(reply.reason, StartsWith("did not write the message 'ready': "));
}

}  // namespace
}  // namespace etude
