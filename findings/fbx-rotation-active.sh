#!/usr/bin/env bash
# An FBX joint without RotationActive has no rotation order and no pre-rotation; three.js r187 and Assimp 5.2.5 apply
# both all the same.
#
# Autodesk's reference of FbxNode::SetRotationActive: when the flag is false, as it is by default, rotation order,
# pre- and post-rotation and limits should be ignored. The FBX SDK (in FBX2glTF 0.9.7) does so. The other two readers
# never look at the flag; both give the same pose, which is not the SDK's. If the flag is true, all three agree.
#
# Needs: curl, dpkg-deb, npm and node (18 or later), Debian 12 or later, x86-64. Downloads 23 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

for path in a/assimp/assimp-utils_5.2.5~ds0-1+b1 a/assimp/libassimp5_5.2.5~ds0-1+b1 d/draco/libdraco7_1.5.5+dfsg-2 \
  m/minizip/libminizip1_1.1-8+deb12u1; do
  curl -sSfo package.deb "http://deb.debian.org/debian/pool/main/${path}_amd64.deb"
  dpkg-deb -x package.deb unpacked
done
npm install --silent --no-audit --no-fund --ignore-scripts three@0.187.0 fbx2gltf@0.9.7 > /dev/null
chmod +x node_modules/fbx2gltf/bin/Linux/FBX2glTF

pose() {  # ACTIVE: two joints, the upper one turned about all axes in the order ZYX, after a pre-rotation of 30 degrees
  cat <<FBX
; FBX 7.4.0 project file
FBXHeaderExtension:  {
	FBXHeaderVersion: 1003
	FBXVersion: 7400
}
GlobalSettings:  {
	Version: 1000
	Properties70:  {
		P: "UpAxis", "int", "Integer", "",1
		P: "FrontAxis", "int", "Integer", "",2
		P: "CoordAxis", "int", "Integer", "",0
		P: "UnitScaleFactor", "double", "Number", "",1
	}
}
Definitions:  {
	Version: 100
	Count: 5
	ObjectType: "GlobalSettings" {
		Count: 1
	}
	ObjectType: "Model" {
		Count: 2
	}
	ObjectType: "NodeAttribute" {
		Count: 2
	}
}
Objects:  {
	NodeAttribute: 11, "NodeAttribute::", "LimbNode" {
		TypeFlags: "Skeleton"
	}
	NodeAttribute: 12, "NodeAttribute::", "LimbNode" {
		TypeFlags: "Skeleton"
	}
	Model: 1, "Model::hip", "LimbNode" {
		Version: 232
		Properties70:  {
			P: "RotationActive", "bool", "", "",$1
			P: "RotationOrder", "enum", "", "",5
			P: "PreRotation", "Vector3D", "Vector", "",0,0,30
			P: "InheritType", "enum", "", "",1
			P: "Lcl Rotation", "Lcl Rotation", "", "A",40,50,60
		}
	}
	Model: 2, "Model::knee", "LimbNode" {
		Version: 232
		Properties70:  {
			P: "InheritType", "enum", "", "",1
			P: "Lcl Translation", "Lcl Translation", "", "A",0,-40,0
		}
	}
}
Connections:  {
	C: "OO",1,0
	C: "OO",2,1
	C: "OO",11,1
	C: "OO",12,2
}
FBX
}

cat > knee.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import { Vector3 } from 'three';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // what three.js expects of a browser
const bytes = (name) => Uint8Array.from(readFileSync(name)).buffer;
function say(reader, root) {
  root.updateMatrixWorld(true);
  const [hip, knee] = ['hip', 'knee'].map((name) => new Vector3().setFromMatrixPosition(root.getObjectByName(name).matrixWorld));
  const way = knee.sub(hip).normalize().toArray().map((x) => x.toFixed(3));
  console.log(`  ${reader}: the knee lies towards (${way.join(', ')})`);
}
say('FBX SDK      ', (await new GLTFLoader().parseAsync(bytes('sdk.glb'), '')).scene);
say('three.js r187', new FBXLoader().parse(bytes('pose.fbx'), ''));
say('Assimp 5.2.5 ', (await new GLTFLoader().parseAsync(bytes('assimp.glb'), '')).scene);
CODE

for active in 0 1; do
  pose "$active" > pose.fbx
  node_modules/fbx2gltf/bin/Linux/FBX2glTF --binary --input pose.fbx --output sdk > /dev/null
  LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) unpacked/usr/bin/assimp export pose.fbx assimp.glb -fglb2 > /dev/null
  echo "RotationActive $active"
  node knee.mjs
done | tee said

cat > expected <<'SAID'
RotationActive 0
  FBX SDK      : the knee lies towards (0.417, -0.809, -0.413)
  three.js r187: the knee lies towards (0.460, 0.316, -0.830)
  Assimp 5.2.5 : the knee lies towards (0.460, 0.316, -0.830)
RotationActive 1
  FBX SDK      : the knee lies towards (0.460, 0.316, -0.830)
  three.js r187: the knee lies towards (0.460, 0.316, -0.830)
  Assimp 5.2.5 : the knee lies towards (0.460, 0.316, -0.830)
SAID
diff expected said
echo 'The behaviour is as described.'
