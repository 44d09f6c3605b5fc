#pragma once

#include <string>

namespace etude {

/// Returns the system call filter for outside programs, a seccomp BPF program; "" if this CPU is not supported. It
/// refuses memory that TreeMeter and Fence::MeasureScratch cannot see; resources that are counted per user or machine
/// and have no limit in a namespace; the user's keys; the kernel's log; and sockets of families other than UNIX, INET,
/// INET6 and NETLINK, because network namespaces do not isolate all others (AF_VSOCK reaches the host).
std::string SystemCallFilter();

}  // namespace etude
