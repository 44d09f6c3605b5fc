#!/usr/bin/env bash
# yaml-cpp 0.7.0 reads the scalar 010 as 8 for an int and as 10 for a double, and the octal number of YAML 1.2, 0o10,
# as neither.
#
# In YAML 1.2.2's core schema (section 10.3.2) 010 is ten and 0o10 is eight. yaml-cpp is a YAML 1.2 parser, but passes
# scalars to a C++ stream, which reads a number with a leading zero as octal if the result is an integer. One setting
# then has two values, depending on the type that the program asks for: as an integer, frame 012 becomes 10, and 008
# and 009 are refused; as a double, they are 12, 8 and 9. Hexadecimal numbers are the reverse: they are read as
# integers, but not as doubles.
#
# Needs: curl, dpkg-deb and g++, Debian 12 or later, x86-64. Downloads 0.3 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for package in libyaml-cpp-dev libyaml-cpp0.7; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/y/yaml-cpp/${package}_0.7.0+dfsg-8+b1_amd64.deb"
  dpkg-deb -x package.deb root
done
cat > numbers.cc <<'CODE'
#include <yaml-cpp/yaml.h>

#include <iostream>

template <typename T>
static void Say(const char* type, const YAML::Node& node) {
  std::cout << "  " << type << ' ';
  try {
    std::cout << node.as<T>();
  } catch (const YAML::BadConversion&) {
    std::cout << "refused";
  }
}

int main() {
  for (const auto& node : YAML::Load("[10, 010, 012, 008, 0o10, 0x10]")) {
    std::cout << node.Scalar() << ':';
    Say<int>("int", node);
    Say<std::size_t>("size_t", node);
    Say<double>("double", node);
    std::cout << '\n';
  }
}
CODE
library=root/usr/lib/x86_64-linux-gnu
g++ -O1 -w -std=c++17 -isystem root/usr/include numbers.cc -o numbers $library/libyaml-cpp.so.0.7
echo 'yaml-cpp 0.7.0 (Debian 12):'
LD_LIBRARY_PATH=$folder/$library ./numbers | tee said

cat > expected <<'SAID'
10:  int 10  size_t 10  double 10
010:  int 8  size_t 8  double 10
012:  int 10  size_t 10  double 12
008:  int refused  size_t refused  double 8
0o10:  int refused  size_t refused  double refused
0x10:  int 16  size_t 16  double refused
SAID
diff expected said
echo 'The behaviour is as described.'
