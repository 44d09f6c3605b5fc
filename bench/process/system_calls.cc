#include "bench/process/system_calls.h"

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
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

constexpr std::array kRefused = {SYS_memfd_create, SYS_memfd_secret, SYS_shmget, SYS_msgget,
                                 SYS_add_key,      SYS_request_key,  SYS_keyctl, SYS_io_uring_setup};
constexpr std::array kFamilies = {AF_UNIX, AF_INET, AF_INET6, AF_NETLINK};
constexpr std::uint32_t kOtherNumbers = 0x40000000;  // from here on the x32 ABI's, on x86-64; nobody's elsewhere

constexpr sock_filter Load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
constexpr sock_filter Return(std::uint32_t what) { return BPF_STMT(BPF_RET | BPF_K, what); }
constexpr sock_filter SkipUnless(std::uint16_t test, std::uint32_t value, std::uint8_t count) {
  return BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), value, 0, count);
}

}  // namespace

std::string SystemCallFilter() {
  if (kArchitecture == 0) return "";
  const sock_filter refuse = Return(SECCOMP_RET_ERRNO | ENOSYS), allow = Return(SECCOMP_RET_ALLOW);
  std::vector<sock_filter> filter = {Load(offsetof(seccomp_data, arch)),
                                     BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
                                     refuse,
                                     Load(offsetof(seccomp_data, nr)),
                                     SkipUnless(BPF_JGE, kOtherNumbers, 1),
                                     refuse};
  for (const auto number : kRefused) {
    filter.push_back(SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(number), 1));
    filter.push_back(refuse);
  }
  for (const auto number : {SYS_socket, SYS_socketpair}) {
    filter.push_back(SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(number), 2 * kFamilies.size() + 2));
    filter.push_back(Load(offsetof(seccomp_data, args)));  // its lower half: both CPUs are little-endian
    for (const int family : kFamilies) {
      filter.push_back(SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(family), 1));
      filter.push_back(allow);
    }
    filter.push_back(Return(SECCOMP_RET_ERRNO | EAFNOSUPPORT));
  }
  filter.push_back(allow);
  return {reinterpret_cast<const char*>(filter.data()), filter.size() * sizeof(sock_filter)};
}

}  // namespace etude
