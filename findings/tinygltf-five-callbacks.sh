#!/usr/bin/env bash
# tinygltf 2.9.5 needs a fifth file callback; a program that sets only the four of 2.7.0 loads files with the built-in
# reader.
#
# FsCallbacks has gained GetFileSizeInBytes, and SetFsCallbacks has gained a result. A program that sets the four
# callbacks of 2.7.0 by name and calls SetFsCallbacks still compiles. The call now returns false and the loader keeps
# its built-in callbacks: files that the program meant to serve from memory are read from the disk, its callbacks are
# never called, and loading succeeds.
#
# Needs: curl, dpkg-deb and g++. Downloads 0.5 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

cat > load.cc <<'CODE'
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_JSON
#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include <cstdio>

static int asked = 0;

int main() {
  tinygltf::FsCallbacks callbacks = {};
  callbacks.FileExists = [](const std::string&, void*) { return ++asked > 0; };
  callbacks.ExpandFilePath = [](const std::string& path, void*) { return path; };
  callbacks.ReadWholeFile = [](std::vector<unsigned char>* bytes, std::string*, const std::string&, void*) {
    ++asked;
    bytes->assign(4, 'm');
    return true;
  };
  callbacks.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(callbacks);
  const std::string text = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "four.bin"}]})";
  tinygltf::Model model;
  std::string error, warning;
  const bool loaded = loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), ".");
  std::printf("loaded %d, callbacks called %s, bytes of the %s\n", loaded, asked > 0 ? "yes" : "never",
              model.buffers.empty() || model.buffers[0].data[0] != 'd' ? "memory" : "disk");
}
CODE
printf dddd > four.bin

fetch() {  # PATH FOLDER
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/$1"
  dpkg-deb -x package.deb "$2"
}
fetch n/nlohmann-json3/nlohmann-json3-dev_3.11.3-2.1_all.deb json
for version in 2.7.0+dfsg-2 2.9.5+dfsg-1; do
  name=${version%%+*}
  fetch "t/tinygltf/libtinygltf-dev_${version}_amd64.deb" "$name"
  g++ -O0 -w -std=c++17 -I json/usr/include -I "$name/usr/include" load.cc -o "load-$name"
  echo "tinygltf $name: $("./load-$name")" | tee "said-$name"
done

grep -qxF 'tinygltf 2.7.0: loaded 1, callbacks called yes, bytes of the memory' said-2.7.0
grep -qxF 'tinygltf 2.9.5: loaded 1, callbacks called never, bytes of the disk' said-2.9.5
echo 'The behaviour is as described.'
