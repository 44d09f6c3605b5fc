#pragma once

#include <string>

namespace etude {

/// A filter of system calls for programs that are not ours, as the kernel takes it (a seccomp BPF program): refuses
/// memory that no look at processes and folders sees (memfd_create, SysV shared memory and queues), sockets of other
/// families than UNIX, INET, INET6 and NETLINK, which no network namespace closes (AF_VSOCK speaks to the host), keys
/// of the user's, and io_uring, which does all of these without system calls. "" where it is not known for this CPU.
std::string SystemCallFilter();

}  // namespace etude
