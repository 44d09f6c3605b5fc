#!/usr/bin/env bash
# mat-for-js 1.1.0 puts the numbers of every MATLAB array of three dimensions in the wrong places; only the first frame
# of a motion is right.
#
# A MAT-file holds an array in column-major order: of a by b by c numbers, (i, j, k) is number i + a j + a b k (MAT-File
# Format, MathWorks). mat-for-js takes number i + a j + b k. Motions are often stored as axes by markers by frames. Of 3
# by 2 by 4, frame 1 begins at number 2 instead of 6: the z of the first marker in frame 0 is its x in frame 1. Half of
# the numbers are never read. The shape is right, and arrays of two dimensions are right. MATIO 1.5.23 (Debian 12)
# writes the file, and reads it correctly. The README lists limitations; this is none of them. There is no warning.
#
# Needs: Debian's apt-get, dpkg-deb, gcc, npm and node (18 or later), x86-64. Downloads 23 MB, writes to a temporary
# folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts mat-for-js@1.1.0 > /dev/null

# Unpacks MATIO and the packages that it needs. apt-get finds these packages without changing this system.
mkdir -p apt/etc/apt/apt.conf.d apt/etc/apt/preferences.d apt/var/lib/apt/lists/partial apt/var/lib/dpkg \
  apt/var/cache/apt/archives/partial
: > apt/var/lib/dpkg/status
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" \
  > apt/etc/apt/sources.list
cat > apt.conf <<CONF
Dir "$folder/apt";
Dir::State::status "$folder/apt/var/lib/dpkg/status";
APT::Architecture "amd64";
APT::Architectures { "amd64"; };
APT::Install-Recommends "false";
APT::Sandbox::User "$(id -un)";
CONF
export APT_CONFIG="$folder/apt.conf"
apt-get -qq update
apt-get -qq -y --download-only install libmatio11=1.5.23-2+deb12u1 > /dev/null
apt-get -qq download libmatio-dev=1.5.23-2+deb12u1 > /dev/null
for package in apt/var/cache/apt/archives/*.deb *.deb; do dpkg-deb -x "$package" unpacked; done

cat > motion.c <<'CODE'
#include <matio.h>
#include <stdio.h>

// Positions of 2 markers in 4 frames: 100 for each frame, 10 for each marker, 1 for each axis.
int main(void) {
  double values[24];
  for (int frame = 0; frame < 4; ++frame)
    for (int marker = 0; marker < 2; ++marker)
      for (int axis = 0; axis < 3; ++axis)
        values[axis + 3 * marker + 6 * frame] = 100 * frame + 10 * marker + axis;

  mat_t* file = Mat_CreateVer("motion.mat", NULL, MAT_FT_MAT5);
  size_t flat[] = {6, 4}, deep[] = {3, 2, 4};
  for (int packed = 0; packed < 2; ++packed) {
    matvar_t* motion = Mat_VarCreate(packed ? "packed" : "motion", MAT_C_DOUBLE, MAT_T_DOUBLE, 3, deep, values, 0);
    Mat_VarWrite(file, motion, packed ? MAT_COMPRESSION_ZLIB : MAT_COMPRESSION_NONE);
    Mat_VarFree(motion);
  }
  matvar_t* table = Mat_VarCreate("table", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, flat, values, 0);
  Mat_VarWrite(file, table, MAT_COMPRESSION_NONE);
  Mat_VarFree(table);
  Mat_Close(file);

  file = Mat_Open("motion.mat", MAT_ACC_RDONLY);
  matvar_t* read = Mat_VarRead(file, "motion");
  int start[] = {0, 0, 0}, stride[] = {1, 1, 1}, edge[] = {3, 2, 1};
  printf("MATIO:");
  for (start[2] = 0; start[2] < 4; ++start[2]) {
    double frame[6];
    Mat_VarReadData(file, read, frame, start, stride, edge);
    for (int i = 0; i < 6; ++i) printf("%s%.0f", i % 3 ? " " : i ? ", " : "\n  ", frame[i]);
  }
  printf("\n");
  Mat_VarFree(read);
  Mat_Close(file);
}
CODE
libraries=$(dirname "$(find unpacked -name 'libmatio.so.11')")
gcc -O1 -isystem unpacked/usr/include motion.c -o motion "$libraries/libmatio.so.11" -Wl,--allow-shlib-undefined
LD_LIBRARY_PATH=$libraries ./motion | tee said

cat > read.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import { read } from 'mat-for-js';

const { buffer, byteOffset, length } = readFileSync('motion.mat');
const { motion, packed, table } = read(buffer.slice(byteOffset, byteOffset + length)).data;
console.log(`mat-for-js, ${motion.length} by ${motion[0].length} by ${motion[0][0].length}:`);
for (const all of [motion, packed]) {
  for (const frame of [0, 1, 2, 3])
    console.log(`  ${[0, 1].map((marker) => all.map((axis) => axis[marker][frame]).join(' ')).join(', ')}`);
}
console.log(`frame 1 of a table of 6 by 4: ${table.map((row) => row[1]).join(' ')}`);
CODE
node read.mjs | tee -a said

cat > expected <<'SAID'
MATIO:
  0 1 2, 10 11 12
  100 101 102, 110 111 112
  200 201 202, 210 211 212
  300 301 302, 310 311 312
mat-for-js, 3 by 2 by 4:
  0 1 2, 10 11 12
  2 10 11, 12 100 101
  11 12 100, 101 102 110
  100 101 102, 110 111 112
  0 1 2, 10 11 12
  2 10 11, 12 100 101
  11 12 100, 101 102 110
  100 101 102, 110 111 112
frame 1 of a table of 6 by 4: 100 101 102 110 111 112
SAID
diff expected said
echo 'As described: only the first frame is right.'
