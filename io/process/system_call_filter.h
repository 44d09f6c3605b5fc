#pragma once

#include <string>

namespace etude {

/// A filter of system calls for programs that are not ours, as the kernel takes it (a seccomp BPF program); "" where it
/// is not known for this CPU. It refuses memory that no look at processes and folders sees, what is counted by user or
/// by machine and has no limit in a namespace, the keys of the user, the log of the kernel, and sockets of other
/// families than UNIX, INET, INET6 and NETLINK, which no network namespace closes (AF_VSOCK speaks to the host).
std::string SystemCallFilter();

}  // namespace etude
