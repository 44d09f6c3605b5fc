#!/usr/bin/env bash
# three.js r187 and parse-exr 1.0.2 misread colours and depths of an OpenEXR picture that also has a channel of whole numbers.
#
# UINT is one of OpenEXR's three pixel types ("Technical Introduction to OpenEXR"), meant for object identifiers and the like,
# such as a camera's labels beside its colours. Both readers count no bytes for such a channel, so they read the channels after
# it from the wrong place. The picture has the right size and format; only its values are wrong. OpenEXR's own library, which
# writes the file here, reads it correctly.
#
# Needs: curl, dpkg-deb, g++, npm and node (18 or later), Debian 12, x86-64. Downloads 6 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for path in o/openexr/libopenexr-dev_3.1.5-5 o/openexr/libopenexr-3-1-30_3.1.5-5 i/imath/libimath-dev_3.1.6-1 \
  i/imath/libimath-3-1-29_3.1.6-1; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/${path}_amd64.deb"
  dpkg-deb -x package.deb root
done
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 parse-exr@1.0.2 > /dev/null

cat > picture.cc <<'CODE'
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <cstdint>
#include <cstdio>
#include <string>

constexpr int width = 4, height = 3;

// NAME-OF-FILE WHAT: 3 rows of 4 pixels, each red 1, green .5, blue .25, and a label of 7 if WHAT is "labels"
int main(int, char** arguments) {
  float red[height][width], green[height][width], blue[height][width];
  std::uint32_t label[height][width];
  const bool labels = std::string(arguments[2]) == "labels";
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::FrameBuffer frame;
  const auto add = [&](const char* name, Imf::PixelType type, auto& values, auto value) {
    for (auto& row : values)
      for (auto& pixel : row) pixel = value;
    header.channels().insert(name, Imf::Channel(type));
    frame.insert(name, Imf::Slice(type, reinterpret_cast<char*>(values), sizeof values[0][0], sizeof values[0]));
  };
  add("R", Imf::FLOAT, red, 1.0F);
  add("G", Imf::FLOAT, green, 0.5F);
  add("B", Imf::FLOAT, blue, 0.25F);
  if (labels) add("label", Imf::UINT, label, 7U);
  {
    Imf::OutputFile file(arguments[1], header);
    file.setFrameBuffer(frame);
    file.writePixels(height);
  }
  for (auto& row : red)
    for (float& pixel : row) pixel = 0;
  Imf::InputFile file(arguments[1]);
  file.setFrameBuffer(frame);
  file.readPixels(0, height - 1);
  std::printf("  OpenEXR 3.1.5  ");
  for (int y = 0; y < height; ++y) std::printf(" (%g, %g, %g)", red[y][0], green[y][0], blue[y][0]);
  std::printf("\n");
}
CODE
library=root/usr/lib/x86_64-linux-gnu
g++ -O1 -w -std=c++17 -isystem root/usr/include/OpenEXR -isystem root/usr/include/Imath picture.cc -o picture \
  $library/libOpenEXR-3_1.so.30 $library/libImath-3_1.so.29 -Wl,--allow-shlib-undefined

cat > read.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import parseExr from 'parse-exr';
import { FloatType } from 'three';
import { EXRLoader } from 'three/examples/jsm/loaders/EXRLoader.js';

const bytes = () => Uint8Array.from(readFileSync(process.argv[2])).buffer;
for (const [reader, picture] of [['three.js r187  ', new EXRLoader().setDataType(FloatType).parse(bytes())],
                                 ['parse-exr 1.0.2', parseExr(bytes(), FloatType)]]) {
  const rows = Array.from({ length: picture.height }, (_, y) => [...picture.data.slice(4 * picture.width * y).slice(0, 3)]);
  console.log(`  ${reader} ${rows.map((row) => `(${row.map((value) => +value.toPrecision(3)).join(', ')})`).join(' ')}`);
}
CODE
for what in colours labels; do
  echo "$what: the first pixel of each row"
  LD_LIBRARY_PATH=$folder/$library ./picture picture.exr $what
  node read.mjs picture.exr
done | tee said

cat > expected <<'SAID'
colours: the first pixel of each row
  OpenEXR 3.1.5   (1, 0.5, 0.25) (1, 0.5, 0.25) (1, 0.5, 0.25)
  three.js r187   (1, 0.5, 0.25) (1, 0.5, 0.25) (1, 0.5, 0.25)
  parse-exr 1.0.2 (1, 0.5, 0.25) (1, 0.5, 0.25) (1, 0.5, 0.25)
labels: the first pixel of each row
  OpenEXR 3.1.5   (1, 0.5, 0.25) (1, 0.5, 0.25) (1, 0.5, 0.25)
  three.js r187   (0.25, 9.81e-45, 1) (0.5, 0.25, 9.81e-45) (1, 0.5, 0.25)
  parse-exr 1.0.2 (0.25, 9.81e-45, 1) (0.5, 0.25, 9.81e-45) (1, 0.5, 0.25)
SAID
diff expected said
echo 'The behaviour is as described.'
