#!/usr/bin/env bash
# three.js r187 and Assimp 5.2.5 ignore how an FBX file interpolates between keys: a step becomes a gradual movement,
# a spline a straight line.
#
# Each key of a curve states its interpolation (KeyAttrFlags: constant, linear, cubic with automatic or given
# tangents), and the three curves of a rotation interpolate angles. The FBX SDK (in FBX2glTF 0.9.7) does so. The other
# two make a quaternion of each key and turn from one to the next along the shortest arc: a joint that should stand
# still until its next key is half-way there at half the time. Even if all keys are linear, a joint that turns about
# two axes takes another path than in the SDK. Files with a key in every frame hide this. There is no warning.
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

second=46186158000  # FBX's units of time
curve() {  # ID FLAGS ANGLE...: one curve, its keys spread over a second
  local id=$1 flags=$2 count=$(($# - 2)) times='' i
  shift 2
  for ((i = 0; i < count; ++i)); do times+="${times:+,}$((second * i / (count - 1)))"; done
  cat <<FBX
	AnimationCurve: $id, "AnimCurve::", "" {
		Default: 0
		KeyVer: 4008
		KeyTime: *$count {
			a: $times
		}
		KeyValueFloat: *$count {
			a: $(IFS=,; echo "$*")
		}
		KeyAttrFlags: *1 {
			a: $flags
		}
		KeyAttrDataFloat: *4 {
			a: 0,0,0,0
		}
		KeyAttrRefCount: *1 {
			a: $count
		}
	}
FBX
}

turn() {  # FLAGS ANGLES-ABOUT-X ANGLES-ABOUT-Y
  local none
  none=$(sed 's/[0-9]\+/0/g' <<< "$2")
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
	Count: 8
	ObjectType: "GlobalSettings" {
		Count: 1
	}
	ObjectType: "Model" {
		Count: 1
	}
	ObjectType: "NodeAttribute" {
		Count: 1
	}
	ObjectType: "AnimationStack" {
		Count: 1
	}
	ObjectType: "AnimationLayer" {
		Count: 1
	}
	ObjectType: "AnimationCurveNode" {
		Count: 1
	}
	ObjectType: "AnimationCurve" {
		Count: 3
	}
}
Objects:  {
	NodeAttribute: 11, "NodeAttribute::", "LimbNode" {
		TypeFlags: "Skeleton"
	}
	Model: 1, "Model::joint", "LimbNode" {
		Version: 232
		Properties70:  {
			P: "InheritType", "enum", "", "",1
			P: "Lcl Rotation", "Lcl Rotation", "", "A",0,0,0
		}
	}
	AnimationStack: 2, "AnimStack::take", "" {
		Properties70:  {
			P: "LocalStart", "KTime", "Time", "",0
			P: "LocalStop", "KTime", "Time", "",$second
			P: "ReferenceStart", "KTime", "Time", "",0
			P: "ReferenceStop", "KTime", "Time", "",$second
		}
	}
	AnimationLayer: 3, "AnimLayer::base", "" {
	}
	AnimationCurveNode: 4, "AnimCurveNode::R", "" {
		Properties70:  {
			P: "d|X", "Number", "", "A",0
			P: "d|Y", "Number", "", "A",0
			P: "d|Z", "Number", "", "A",0
		}
	}
$(curve 5 "$1" $2)
$(curve 6 "$1" $3)
$(curve 7 "$1" $none)
}
Connections:  {
	C: "OO",1,0
	C: "OO",11,1
	C: "OO",3,2
	C: "OO",4,3
	C: "OP",4,1, "Lcl Rotation"
	C: "OP",5,4, "d|X"
	C: "OP",6,4, "d|Y"
	C: "OP",7,4, "d|Z"
}
FBX
}

cat > apart.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import { AnimationMixer, LoopOnce } from 'three';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // what three.js expects of a browser
const bytes = (name) => Uint8Array.from(readFileSync(name)).buffer;
function poses(root, clip) {
  return [0, 0.25, 0.5, 0.75, 1].map((seconds) => {
    const mixer = new AnimationMixer(root), action = mixer.clipAction(clip).setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    mixer.setTime(seconds);
    return root.getObjectByName('joint').quaternion.clone();
  });
}
async function gltf(name) {
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes(name), '');
  return poses(scene, animations[0]);
}
const sdk = await gltf('sdk.glb'), three = new FBXLoader().parse(bytes('turn.fbx'), '');
for (const [reader, read] of [['three.js r187', poses(three, three.animations[0])], ['Assimp 5.2.5 ', await gltf('assimp.glb')]]) {
  const apart = read.map((pose, index) => (pose.angleTo(sdk[index]) * 180 / Math.PI).toFixed(1));
  console.log(`  ${reader}: degrees from the FBX SDK's pose, at each quarter of the time: ${apart.join(', ')}`);
}
CODE

try() {  # WHAT FLAGS ANGLES-ABOUT-X ANGLES-ABOUT-Y
  turn "$2" "$3" "$4" > turn.fbx
  node_modules/fbx2gltf/bin/Linux/FBX2glTF --binary --anim-framerate bake60 --input turn.fbx --output sdk > /dev/null
  LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) unpacked/usr/bin/assimp export turn.fbx assimp.glb -fglb2 > /dev/null
  echo "$1"
  node apart.mjs
}
{
  try 'linear, one axis' 4 '0 90' '0 0'
  try 'linear, two axes' 4 '0 90' '0 60'
  try 'constant, one axis' 2 '0 90' '0 0'
  try 'cubic with automatic tangents, one axis' 264 '0 50 50' '0 0 0'
} | tee said

cat > expected <<'SAID'
linear, one axis
  three.js r187: degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 0.0, 0.0, 0.0, 0.0
  Assimp 5.2.5 : degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 0.0, 0.0, 0.0, 0.0
linear, two axes
  three.js r187: degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 9.4, 12.7, 9.4, 0.0
  Assimp 5.2.5 : degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 9.4, 12.7, 9.4, 0.0
constant, one axis
  three.js r187: degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 22.5, 45.0, 67.5, 0.0
  Assimp 5.2.5 : degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 22.5, 45.0, 67.5, 0.0
cubic with automatic tangents, one axis
  three.js r187: degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 3.1, 0.0, 3.1, 0.0
  Assimp 5.2.5 : degrees from the FBX SDK's pose, at each quarter of the time: 0.0, 3.1, 0.0, 3.1, 0.0
SAID
diff expected said
echo 'The behaviour is as described.'
