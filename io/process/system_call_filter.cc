#include "io/process/system_call_filter.h"

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/close_range.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace etude {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

struct Refusal {
  long number;
  int error;
};

constexpr auto kRefused = std::to_array<Refusal>({
    // Refuse memory that cannot be measured, and resources that are counted per user or per machine.
    {SYS_memfd_create, ENOSYS},
    {SYS_memfd_secret, ENOSYS},
    {SYS_shmget, ENOSYS},
    {SYS_msgget, ENOSYS},
    {SYS_semget, ENOSYS},
    {SYS_mq_open, ENOSYS},
    {SYS_vmsplice, ENOSYS},  // this and the next three calls make pipes and sockets hold pages that no process maps
    {SYS_splice, EINVAL},
    {SYS_tee, EINVAL},
    {SYS_sendfile, EINVAL},
    {SYS_seccomp, EINVAL},  // filters take up to 1 MB per thread from a pool of the whole machine
    {SYS_userfaultfd, ENOSYS},
    {SYS_io_setup, ENOSYS},
    {SYS_landlock_create_ruleset, ENOSYS},
    {SYS_fanotify_init, ENOSYS},
    {SYS_setxattr, EOPNOTSUPP},  // this and the next two calls: the kernel charges attributes in tmpfs to no process
    {SYS_lsetxattr, EOPNOTSUPP},
    {SYS_fsetxattr, EOPNOTSUPP},
    // Refuse threads with their own descriptor tables, and processes that share a table, because open files and locks
    // could then not be counted. clone3 is refused because a filter cannot read its arguments; C libraries then use
    // clone.
    {SYS_unshare, EPERM},
    {SYS_clone3, ENOSYS},
    // Refuse io_uring, because with io_uring a program could do the operations above without system calls.
    {SYS_io_uring_setup, ENOSYS},
    // Refuse the user's keys, and information about other processes.
    {SYS_add_key, ENOSYS},
    {SYS_request_key, ENOSYS},
    {SYS_keyctl, ENOSYS},
    {SYS_perf_event_open, ENOSYS},
    {SYS_bpf, ENOSYS},
    {SYS_syslog, EPERM},
});
constexpr std::array kFamilies = {AF_UNIX, AF_INET, AF_INET6, AF_NETLINK};
constexpr std::uint32_t kOtherNumbers = 0x40000000;  // from here on: the x32 ABI's calls on x86-64; unused elsewhere

using Filter = std::vector<sock_filter>;

constexpr sock_filter Load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
/// Loads the lower 32 bits of an argument; both supported CPUs are little-endian.
constexpr sock_filter LoadArgument(std::size_t index) { return Load(offsetof(seccomp_data, args) + 8 * index); }
constexpr sock_filter Return(std::uint32_t what) { return BPF_STMT(BPF_RET | BPF_K, what); }
constexpr sock_filter Refuse(int error) { return Return(SECCOMP_RET_ERRNO | static_cast<std::uint32_t>(error)); }
constexpr sock_filter kAllow = Return(SECCOMP_RET_ALLOW);
constexpr sock_filter SkipUnless(std::uint16_t test, std::uint32_t value, std::size_t count) {
  return BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), value, 0, static_cast<std::uint8_t>(count));
}

void Add(Filter& filter, const Filter& more) { filter.insert(filter.end(), more.begin(), more.end()); }

/// Adds the rules for one system call; the last rule must allow or refuse the call.
void AddCall(Filter& filter, long number, const Filter& rules) {
  filter.push_back(SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(number), rules.size()));
  Add(filter, rules);
}

}  // namespace

std::string SystemCallFilter() {
  if (kArchitecture == 0) return "";
  // Refuse other ABIs, then the calls of kRefused.
  Filter filter = {Load(offsetof(seccomp_data, arch)),
                   BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
                   Refuse(ENOSYS),
                   Load(offsetof(seccomp_data, nr)),
                   SkipUnless(BPF_JGE, kOtherNumbers, 1),
                   Refuse(ENOSYS)};
  for (const auto& [number, error] : kRefused) AddCall(filter, number, {Refuse(error)});
  // Allow only sockets of kFamilies.
  Filter families = {LoadArgument(0)};
  for (const int family : kFamilies)
    Add(families, {SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(family), 1), kAllow});
  families.push_back(Refuse(EAFNOSUPPORT));
  for (const auto number : {SYS_socket, SYS_socketpair}) AddCall(filter, number, families);
  // Refuse large pipes, and locks and leases that CountLocks cannot attribute to a process.
  AddCall(filter, SYS_fcntl,
          {LoadArgument(1), SkipUnless(BPF_JEQ, F_SETPIPE_SZ, 1), Refuse(EPERM), SkipUnless(BPF_JEQ, F_OFD_SETLK, 1),
           Refuse(EINVAL), SkipUnless(BPF_JEQ, F_OFD_SETLKW, 1), Refuse(EINVAL), SkipUnless(BPF_JEQ, F_SETLEASE, 1),
           Refuse(EINVAL), kAllow});
  // PR_FUTEX_HASH (Linux 6.16) makes the kernel allocate up to a gigabyte that is not counted as a process's memory.
  constexpr std::uint32_t kFutexHash = 78;
  AddCall(filter, SYS_prctl,
          {LoadArgument(0), SkipUnless(BPF_JEQ, PR_SET_SECCOMP, 1), Refuse(EINVAL), SkipUnless(BPF_JEQ, kFutexHash, 1),
           Refuse(EINVAL), kAllow});
  AddCall(filter, SYS_close_range,
          {LoadArgument(2), SkipUnless(BPF_JSET, CLOSE_RANGE_UNSHARE, 1), Refuse(EINVAL), kAllow});
  // Allow descriptor tables that the threads of one process share; refuse descriptor tables that processes share.
  AddCall(filter, SYS_clone,
          {LoadArgument(0), BPF_STMT(BPF_ALU | BPF_AND | BPF_K, CLONE_THREAD | CLONE_FILES),
           SkipUnless(BPF_JEQ, CLONE_THREAD, 1), Refuse(EINVAL), SkipUnless(BPF_JEQ, CLONE_FILES, 1), Refuse(EINVAL),
           kAllow});
  // Refuse huge pages.
  constexpr std::uint32_t kCollapse = 25;  // MADV_COLLAPSE
  AddCall(filter, SYS_madvise,
          {LoadArgument(2), SkipUnless(BPF_JEQ, MADV_HUGEPAGE, 1), Refuse(EINVAL), SkipUnless(BPF_JEQ, kCollapse, 1),
           Refuse(EINVAL), kAllow});
  AddCall(filter, SYS_mmap, {LoadArgument(3), SkipUnless(BPF_JSET, MAP_HUGETLB, 1), Refuse(ENOMEM), kAllow});
  // For sizes of socket buffers, report success without changing them, because the kernel may round sizes anyway.
  constexpr int kDone = 0;
  AddCall(filter, SYS_setsockopt,
          {LoadArgument(1), SkipUnless(BPF_JEQ, SOL_SOCKET, 9), LoadArgument(2), SkipUnless(BPF_JEQ, SO_SNDBUF, 1),
           Refuse(kDone), SkipUnless(BPF_JEQ, SO_RCVBUF, 1), Refuse(kDone), SkipUnless(BPF_JEQ, SO_ATTACH_FILTER, 1),
           Refuse(ENOMEM), SkipUnless(BPF_JEQ, SO_ATTACH_REUSEPORT_CBPF, 1), Refuse(ENOMEM), kAllow});
  filter.push_back(kAllow);
  return {reinterpret_cast<const char*>(filter.data()), filter.size() * sizeof(sock_filter)};
}

}  // namespace etude
