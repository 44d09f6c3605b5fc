#pragma once

#include <string>

namespace etude {

/// Returns the system call filter for outside programs, a seccomp BPF program; "" if this CPU is not supported. It
/// refuses calls that create or use
/// - memory that TreeMeter and Fence::MeasureScratch cannot measure;
/// - resources that are counted per user or machine and have no limit in a namespace;
/// - the user's keys, or the kernel's log;
/// - sockets, except UNIX, INET, INET6 and NETLINK, because a network namespace does not isolate every family: through
///   AF_VSOCK, a program could reach the host.
std::string SystemCallFilter();

}  // namespace etude
