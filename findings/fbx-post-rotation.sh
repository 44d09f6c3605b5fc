#!/usr/bin/env bash
# Assimp 5.2.5 places an animated FBX joint wrongly if it has a post-rotation; and the cure for its pre-rotations turns
# post-rotations the wrong way.
#
# An FBX joint's rotation is pre-rotation, rotation, inverse post-rotation. The FBX SDK (in FBX2glTF 0.9.7) and three.js
# r187 follow this at rest and in motion. By default, Assimp's helper nodes above the joint hold its rest rotation,
# which is right; but if it has no pivots, the keys of the joint contain pre- and post-rotation once more, the latter
# not inverted. So a moving joint's pre-rotation counts twice, and a post-rotation about the motion's axis vanishes. If
# IMPORT_FBX_PRESERVE_PIVOTS is off, there are no helper nodes and pre-rotations are right, but no post-rotation is
# inverted: one of 40 degrees makes an error of 80. There is no warning. Assimp 5.4.3 does all this, too; in 6.0.5 the
# default is right, but not the setting.
#
# Needs: curl, dpkg-deb, python3, npm and node (18 or later), Debian 12 or later, x86-64. Downloads 23 MB, writes to a temporary folder only.
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
curve() {  # ID ANGLES: keys at 0 and 1 s
  cat <<FBX
	AnimationCurve: $1, "AnimCurve::", "" {
		Default: 0
		KeyVer: 4008
		KeyTime: *2 {
			a: 0,$second
		}
		KeyValueFloat: *2 {
			a: $2
		}
		KeyAttrFlags: *1 {
			a: 4
		}
		KeyAttrDataFloat: *4 {
			a: 0,0,0,0
		}
		KeyAttrRefCount: *1 {
			a: 2
		}
	}
FBX
}

stack_types() {
  cat <<FBX
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
FBX
}
take() {
  cat <<FBX
	AnimationStack: 8, "AnimStack::take", "" {
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
$(curve 5 0,0)
$(curve 6 0,0)
$(curve 7 0,80)
FBX
}
links() {
  cat <<FBX
	C: "OO",3,8
	C: "OO",4,3
	C: "OP",4,1, "Lcl Rotation"
	C: "OP",5,4, "d|X"
	C: "OP",6,4, "d|Y"
	C: "OP",7,4, "d|Z"
FBX
}

turn() {  # PROPERTY ANGLE MOVES: a joint with a pre- or post-rotation about Z, which turns by 80 degrees about Z if it MOVES
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
	Count: $((5 + 6 * $3))
	ObjectType: "GlobalSettings" {
		Count: 1
	}
	ObjectType: "Model" {
		Count: 2
	}
	ObjectType: "NodeAttribute" {
		Count: 2
	}
$(if (($3)); then stack_types; fi)
}
Objects:  {
	NodeAttribute: 11, "NodeAttribute::", "LimbNode" {
		TypeFlags: "Skeleton"
	}
	NodeAttribute: 12, "NodeAttribute::", "LimbNode" {
		TypeFlags: "Skeleton"
	}
	Model: 1, "Model::joint", "LimbNode" {
		Version: 232
		Properties70:  {
			P: "RotationActive", "bool", "", "",1
			P: "$1", "Vector3D", "Vector", "",0,0,$2
			P: "InheritType", "enum", "", "",1
			P: "Lcl Rotation", "Lcl Rotation", "", "A",0,0,0
		}
	}
	Model: 2, "Model::end", "LimbNode" {
		Version: 232
		Properties70:  {
			P: "InheritType", "enum", "", "",1
			P: "Lcl Translation", "Lcl Translation", "", "A",10,0,0
		}
	}
$(if (($3)); then take; fi)
}
Connections:  {
	C: "OO",1,0
	C: "OO",11,1
	C: "OO",2,1
	C: "OO",12,2
$(if (($3)); then links; fi)
}
FBX
}

cat > helpers.py <<'CODE'
import ctypes
import sys

assimp = ctypes.CDLL("libassimp.so.5")
assimp.aiCreatePropertyStore.restype = ctypes.c_void_p
assimp.aiSetImportPropertyInteger.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_int]
assimp.aiImportFileExWithProperties.argtypes = [ctypes.c_char_p, ctypes.c_uint, ctypes.c_void_p, ctypes.c_void_p]
assimp.aiImportFileExWithProperties.restype = ctypes.c_void_p
assimp.aiExportScene.argtypes = [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_char_p, ctypes.c_uint]
for setting, name in enumerate([b"off.glb", b"default.glb"]):  # the setting is on by default
    properties = assimp.aiCreatePropertyStore()
    assimp.aiSetImportPropertyInteger(properties, b"IMPORT_FBX_PRESERVE_PIVOTS", setting)
    scene = assimp.aiImportFileExWithProperties(b"turn.fbx", 0, None, properties)
    if not scene or assimp.aiExportScene(scene, b"glb2", name, 0) != 0:
        sys.exit("Assimp fails")
CODE
cat > angles.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import { AnimationMixer, LoopOnce, Vector3 } from 'three';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // what three.js expects of a browser
const bytes = (name) => Uint8Array.from(readFileSync(name)).buffer;
function direction(root) {
  root.updateMatrixWorld(true);
  const [joint, end] = ['joint', 'end'].map((name) => new Vector3().setFromMatrixPosition(root.getObjectByName(name).matrixWorld));
  return (Math.atan2(end.y - joint.y, end.x - joint.x) * 180 / Math.PI).toFixed(0);
}
function say(reader, root, [clip]) {
  const angles = !clip ? [direction(root)] : [0, 0.5, 1].map((seconds) => {
    const mixer = new AnimationMixer(root), action = mixer.clipAction(clip).setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    mixer.setTime(seconds);
    return direction(root);
  });
  console.log(`  ${reader}: the joint points to ${angles.join(', ').replace(/-0\b/g, '0')} degrees`);
}
async function sayGltf(reader, name) {
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes(name), '');
  say(reader, scene, animations);
}
await sayGltf('FBX SDK                  ', 'sdk.glb');
const three = new FBXLoader().parse(bytes('turn.fbx'), '');
say('three.js r187            ', three, three.animations);
await sayGltf('Assimp 5.2.5             ', 'default.glb');
await sayGltf('Assimp 5.2.5, setting off', 'off.glb');
CODE

try() {  # WHAT PROPERTY ANGLE MOVES
  turn "${@:2}" > turn.fbx
  node_modules/fbx2gltf/bin/Linux/FBX2glTF --binary --anim-framerate bake60 --input turn.fbx --output sdk > /dev/null
  LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) python3 helpers.py
  echo "$1"
  node angles.mjs
}
{
  try 'no pre- or post-rotation, in motion' PreRotation 0 1
  try 'post-rotation of 40 degrees, at rest' PostRotation 40 0
  try 'post-rotation of 40 degrees, in motion' PostRotation 40 1
  try 'pre-rotation of 40 degrees, at rest' PreRotation 40 0
  try 'pre-rotation of 40 degrees, in motion' PreRotation 40 1
} | tee said

cat > expected <<'SAID'
no pre- or post-rotation, in motion
  FBX SDK                  : the joint points to 0, 40, 80 degrees
  three.js r187            : the joint points to 0, 40, 80 degrees
  Assimp 5.2.5             : the joint points to 0, 40, 80 degrees
  Assimp 5.2.5, setting off: the joint points to 0, 40, 80 degrees
post-rotation of 40 degrees, at rest
  FBX SDK                  : the joint points to -40 degrees
  three.js r187            : the joint points to -40 degrees
  Assimp 5.2.5             : the joint points to -40 degrees
  Assimp 5.2.5, setting off: the joint points to 40 degrees
post-rotation of 40 degrees, in motion
  FBX SDK                  : the joint points to -40, 0, 40 degrees
  three.js r187            : the joint points to -40, 0, 40 degrees
  Assimp 5.2.5             : the joint points to 0, 40, 80 degrees
  Assimp 5.2.5, setting off: the joint points to 40, 80, 120 degrees
pre-rotation of 40 degrees, at rest
  FBX SDK                  : the joint points to 40 degrees
  three.js r187            : the joint points to 40 degrees
  Assimp 5.2.5             : the joint points to 40 degrees
  Assimp 5.2.5, setting off: the joint points to 40 degrees
pre-rotation of 40 degrees, in motion
  FBX SDK                  : the joint points to 40, 80, 120 degrees
  three.js r187            : the joint points to 40, 80, 120 degrees
  Assimp 5.2.5             : the joint points to 80, 120, 160 degrees
  Assimp 5.2.5, setting off: the joint points to 40, 80, 120 degrees
SAID
diff expected said
echo 'The behaviour is as described.'
