#include "engine/base/machine.h"

#include <gtest/gtest.h>

#include <cerrno>

namespace etude {
namespace {

TEST(CannotWrite, BlamesTheMachineButForTheName) {
  for (const int reason : {ENOSPC, EDQUOT, EFBIG, EIO, EROFS, EACCES, EPERM, EMFILE}) {
    const Error error = CannotWrite("a/b", "cannot be written", reason).value();
    EXPECT_TRUE(IsOfThisMachine(error)) << ToString(error);
  }
  for (const int reason : {ENOENT, ENOTDIR, EISDIR, ENAMETOOLONG, ELOOP}) {
    const Error error = CannotWrite("a/b", "cannot be written", reason).value();
    EXPECT_FALSE(IsOfThisMachine(error)) << ToString(error);
  }
  EXPECT_EQ(ToString(CannotWrite("a/b", "cannot be written", ENOSPC).value()),
            "this machine: a/b: cannot be written: No space left on device");
}

TEST(FailOfMachine, IsAKindOfErrorAndNoNameOfAFile) {
  EXPECT_TRUE(IsOfThisMachine(FailOfMachine("no {}", "pipe").value()));
  EXPECT_EQ(ToString(FailOfMachine("no {}", "pipe").value()), "this machine: no pipe");
  EXPECT_FALSE(IsOfThisMachine(Fail({"this machine"}, "cannot create a pipe").value()));
}

TEST(CannotRead, BlamesTheMachineForWhatItLacks) {
  for (const int reason : {EIO, ENOMEM, EMFILE}) EXPECT_TRUE(IsOfThisMachine(CannotRead("a", "no", reason).value()));
  for (const int reason : {ENOENT, EACCES, EISDIR})
    EXPECT_FALSE(IsOfThisMachine(CannotRead("a", "no", reason).value()));
}

}  // namespace
}  // namespace etude
