#!/usr/bin/env bash
# Assimp 5.2.5 misreads the rotations that gltfpack 1.3.0 writes by default: it gets NaN and 1e37, and reports success.
#
# glTF 2.0 lets an animation's rotations be normalized bytes or shorts (section 3.11), and gltfpack stores them as
# shorts unless it is told otherwise. Assimp copies the bytes of such a key into floats without looking at the
# component type. A turn about Z by 90 degrees, in three keys of floats, is read right; once gltfpack has packed it,
# not one of the keys is a rotation. The file is valid.
#
# Needs: curl, dpkg-deb, g++, python3, npm and node (18 or later), Debian 12, x86-64. Downloads 7 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for path in a/assimp/libassimp-dev_5.2.5~ds0-1+b1 a/assimp/libassimp5_5.2.5~ds0-1+b1 d/draco/libdraco7_1.5.5+dfsg-2 \
  m/minizip/libminizip1_1.1-8+deb12u1; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/${path}_amd64.deb"
  dpkg-deb -x package.deb root
done
npm install --silent --no-audit --no-fund gltfpack@1.3.0 > /dev/null

python3 - <<'PY'
import base64, json, math, struct
angles = [math.radians(a) / 2 for a in (0, 30, 90)]
times, keys = struct.pack("<3f", 0, 0.5, 1), b"".join(struct.pack("<4f", 0, 0, math.sin(a), math.cos(a)) for a in angles)
triangle = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
data = times + keys + triangle
uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
views = [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in ((0, 12), (12, 48), (60, 36))]
accessors = [{"bufferView": view, "componentType": 5126, "count": 3, "type": kind} for view, kind in enumerate(("SCALAR", "VEC4", "VEC3"))]
accessors[0].update(min=[0], max=[1])
accessors[2].update(min=[0, 0, 0], max=[1, 1, 0])
json.dump({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"name": "arm", "mesh": 0}],
           "meshes": [{"primitives": [{"attributes": {"POSITION": 2}}]}],
           "animations": [{"samplers": [{"input": 0, "output": 1}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}],
           "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data), "uri": uri}]}, open("floats.gltf", "w"))
PY
node_modules/.bin/gltfpack -kn -i floats.gltf -o packed.gltf

cat > keys.cc <<'CODE'
#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <cmath>
#include <cstdio>

int main(int, char** file) {  // counts the keys of the only channel that are unit quaternions
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(file[1], 0);
  if (scene == nullptr) { std::printf("%s: refused: %s\n", file[1], importer.GetErrorString()); return 0; }
  const aiNodeAnim& channel = *scene->mAnimations[0]->mChannels[0];
  unsigned rotations = 0;
  for (unsigned k = 0; k < channel.mNumRotationKeys; ++k) {
    const aiQuaternion& q = channel.mRotationKeys[k].mValue;
    rotations += std::abs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) < 1e-3;
  }
  std::printf("%s: %u of %u keys are rotations, the last is %g %g %g %g\n", file[1], rotations, channel.mNumRotationKeys,
              channel.mRotationKeys[channel.mNumRotationKeys - 1].mValue.x, channel.mRotationKeys[channel.mNumRotationKeys - 1].mValue.y,
              channel.mRotationKeys[channel.mNumRotationKeys - 1].mValue.z, channel.mRotationKeys[channel.mNumRotationKeys - 1].mValue.w);
}
CODE
libraries=$(echo root/usr/lib/*-linux-gnu)
g++ -O1 -isystem root/usr/include keys.cc -o keys "$libraries"/libassimp.so.5 -Wl,--allow-shlib-undefined
echo 'Assimp 5.2.5 (Debian 12), keys as floats and as gltfpack 1.3.0 packs them:'
for file in floats packed; do LD_LIBRARY_PATH=$libraries ./keys $file.gltf; done | tee said

grep -q '^floats.gltf: 3 of 3 keys are rotations, the last is 0 0 0.707107 0.707107$' said
grep -q '^packed.gltf: 0 of 31 keys are rotations' said
python3 -c "import json; g = json.load(open('packed.gltf')); assert any(a['componentType'] == 5122 and a.get('normalized') for a in g['accessors'])"
echo 'As described: no key of the packed file is read as a rotation.'
