#!/usr/bin/env bash
# Ceres 2.2.0 (Debian 13) reports the first successful step of every solve with a length of zero.
#
# IterationSummary::step_norm is 0 at the first successful iteration, for callbacks and in Solver::Summary::iterations. The step
# itself is taken: the cost falls, and later iterations have the lengths that Ceres 2.1.0 (Debian 12) reports. Code that stops at
# a short step, as a callback may, stops after one iteration and reports no error.
#
# Needs: Debian's apt-get, curl and g++, x86-64. Downloads 42 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Unpacks both versions side by side, with the packages that they need. apt-get finds these packages without changing
# this system.
unpack() {  # SUITE VERSION
  mkdir -p "$1"/etc/apt/apt.conf.d "$1"/etc/apt/preferences.d "$1"/var/lib/apt/lists/partial "$1"/var/lib/dpkg "$1"/var/cache/apt/archives/partial
  : > "$1/var/lib/dpkg/status"
  echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $1 main" > "$1/etc/apt/sources.list"
  cat > "$1/apt.conf" <<CONF
Dir "$folder/$1";
Dir::State::status "$folder/$1/var/lib/dpkg/status";
APT::Architecture "amd64";
APT::Architectures { "amd64"; };
APT::Install-Recommends "false";
APT::Sandbox::User "$(id -un)";
CONF
  APT_CONFIG="$folder/$1/apt.conf" apt-get -qq update
  APT_CONFIG="$folder/$1/apt.conf" apt-get -qq -y --download-only install "libceres-dev=$2" > /dev/null
  for package in "$1"/var/cache/apt/archives/*.deb; do dpkg-deb -x "$package" "$1/root"; done
}

cat > first.cc <<'CODE'
#include <ceres/ceres.h>

#include <cstdio>

struct Rosenbrock {
  template <typename T>
  bool operator()(const T* const x, T* residuals) const {
    residuals[0] = 10.0 * (x[1] - x[0] * x[0]);
    residuals[1] = 1.0 - x[0];
    return true;
  }
};

struct Printer : ceres::IterationCallback {
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& iteration) override {
    std::printf("iteration %d: cost %.6f, successful %d, step_norm %.6f\n", iteration.iteration, iteration.cost,
                iteration.step_is_successful, iteration.step_norm);
    return ceres::SOLVER_CONTINUE;
  }
};

int main() {
  double x[2] = {0.5, 0.5};
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Rosenbrock, 2, 2>(new Rosenbrock), nullptr, x);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 3;
  Printer printer;
  options.callbacks.push_back(&printer);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
}
CODE

run() {  # SUITE: compiles against that suite's Ceres, and runs with all of that suite's libraries
  local root=$folder/$1/root libraries
  libraries=$(find "$root" -name '*.so*' -printf '%h\n' | sort -u | paste -sd :)
  mkdir "$1/include"
  for part in ceres glog gflags eigen3; do cp -r "$root/usr/include/$part" "$1/include"; done
  g++ -O1 -w -std=c++17 -isystem "$1/include" -isystem "$1/include/eigen3" first.cc -o "$1/first" \
    "$root/usr/lib/x86_64-linux-gnu/libceres.so" "$root/usr/lib/x86_64-linux-gnu/libglog.so" \
    -Wl,--allow-shlib-undefined -Wl,-rpath-link,"$root/usr/lib/x86_64-linux-gnu"
  "$(find "$root" -name 'ld-linux-x86-64.so.2' | head -n 1)" --library-path "$libraries" "$1/first"
}

unpack bookworm '2.1.0+really2.1.0+dfsg-1'
unpack trixie '2.2.0+dfsg-4.1+b2'
echo 'Ceres 2.1.0:'; run bookworm | tee said-2.1
echo 'Ceres 2.2.0:'; run trixie | tee said-2.2

first='iteration 1: cost 2.944659, successful 1, step_norm'
grep -qxF "$first 0.549087" said-2.1
grep -qxF "$first 0.000000" said-2.2
cmp <(sed 1,2d said-2.1) <(sed 1,2d said-2.2)
echo 'As described: only the first step has another length.'
