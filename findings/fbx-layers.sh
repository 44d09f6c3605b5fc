#!/usr/bin/env bash
# Assimp 5.2.5 throws all animation layers of an FBX file together, and the last one wins: a layer that adds nothing to a
# motion ends the motion.
#
# A layer states how it changes the layers below it (BlendMode: added, the default, or in their place), how much (Weight,
# per cent), and whether it is silent (Mute). Animators put corrections into such a layer over a recorded motion. The FBX
# SDK (in FBX2glTF 0.9.7) follows all three. Assimp reads none of them: a correction of 30 degrees becomes the motion,
# and so does a layer of zeros, or one that is muted or has no weight. There is no warning. three.js r187 warns and reads
# only the first layer. Assimp 5.4.3 and 6.0.5 give the same poses as 5.2.5.
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
curve() {  # ID ANGLES: keys at 0, 0.5 and 1 s
  cat <<FBX
	AnimationCurve: $1, "AnimCurve::", "" {
		Default: 0
		KeyVer: 4008
		KeyTime: *3 {
			a: 0,$((second / 2)),$second
		}
		KeyValueFloat: *3 {
			a: $2
		}
		KeyAttrFlags: *1 {
			a: 4
		}
		KeyAttrDataFloat: *4 {
			a: 0,0,0,0
		}
		KeyAttrRefCount: *1 {
			a: 3
		}
	}
FBX
}
layer() {  # ID PROPERTIES ANGLES: a layer that turns the joint about Z
  cat <<FBX
	AnimationLayer: $1, "AnimLayer::layer$1", "" {
		Properties70:  {
$2
		}
	}
	AnimationCurveNode: $(($1 + 1)), "AnimCurveNode::R", "" {
		Properties70:  {
			P: "d|X", "Number", "", "A",0
			P: "d|Y", "Number", "", "A",0
			P: "d|Z", "Number", "", "A",0
		}
	}
$(curve $(($1 + 2)) 0,0,0)
$(curve $(($1 + 3)) 0,0,0)
$(curve $(($1 + 4)) "$3")
FBX
}
links() {  # ID
  cat <<FBX
	C: "OO",$1,2
	C: "OO",$(($1 + 1)),$1
	C: "OP",$(($1 + 1)),1, "Lcl Rotation"
	C: "OP",$(($1 + 2)),$(($1 + 1)), "d|X"
	C: "OP",$(($1 + 3)),$(($1 + 1)), "d|Y"
	C: "OP",$(($1 + 4)),$(($1 + 1)), "d|Z"
FBX
}

turn() {  # LAYERS [PROPERTIES ANGLES]: a joint that turns by 80 degrees in a second, and perhaps a second layer
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
	Count: $((4 + 5 * $1))
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
		Count: $1
	}
	ObjectType: "AnimationCurveNode" {
		Count: $1
	}
	ObjectType: "AnimationCurve" {
		Count: $((3 * $1))
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
$(layer 100 '' 0,40,80)
$(if (($1 > 1)); then layer 200 "$2" "$3"; fi)
}
Connections:  {
	C: "OO",1,0
	C: "OO",11,1
$(links 100)
$(if (($1 > 1)); then links 200; fi)
}
FBX
}

cat > angles.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // what three.js expects of a browser
let warned = '';
console.warn = (message) => { if (message.includes('multiple layers')) warned = '; it warns'; };
const bytes = (name) => Uint8Array.from(readFileSync(name)).buffer;
function say(reader, { animations: [clip] }, more) {
  const turn = clip.tracks.find((track) => track.name === 'joint.quaternion').createInterpolant();
  const angles = [0, 0.5, 1].map((seconds) => {
    const [, , z, w] = turn.evaluate(seconds);
    return (Math.atan2(z, w) * 360 / Math.PI + 0).toFixed(0);
  });
  console.log(`  ${reader}: turned by ${angles.join(', ')} degrees${more}`);
}
say('FBX SDK      ', await new GLTFLoader().parseAsync(bytes('sdk.glb'), ''), '');
const three = new FBXLoader().parse(bytes('turn.fbx'), '');
say('three.js r187', three, warned);
say('Assimp 5.2.5 ', await new GLTFLoader().parseAsync(bytes('assimp.glb'), ''), '');
CODE

try() {  # WHAT LAYERS [PROPERTIES ANGLES]
  turn "${@:2}" > turn.fbx
  node_modules/fbx2gltf/bin/Linux/FBX2glTF --binary --anim-framerate bake60 --input turn.fbx --output sdk > /dev/null
  LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) unpacked/usr/bin/assimp export turn.fbx assimp.glb -fglb2 > /dev/null
  echo "$1"
  node angles.mjs
}
{
  try 'one layer' 1
  try 'a layer of zeros is added' 2 '' 0,0,0
  try 'a layer of 30 degrees is added' 2 '' 30,30,30
  try 'the same, with a weight of 0' 2 '			P: "Weight", "Number", "", "A",0' 30,30,30
  try 'the same, muted' 2 '			P: "Mute", "bool", "", "",1' 30,30,30
  try 'the same, in place of the motion' 2 '			P: "BlendMode", "enum", "", "",1' 30,30,30
} | tee said

cat > expected <<'SAID'
one layer
  FBX SDK      : turned by 0, 40, 80 degrees
  three.js r187: turned by 0, 40, 80 degrees
  Assimp 5.2.5 : turned by 0, 40, 80 degrees
a layer of zeros is added
  FBX SDK      : turned by 0, 40, 80 degrees
  three.js r187: turned by 0, 40, 80 degrees; it warns
  Assimp 5.2.5 : turned by 0, 0, 0 degrees
a layer of 30 degrees is added
  FBX SDK      : turned by 30, 70, 110 degrees
  three.js r187: turned by 0, 40, 80 degrees; it warns
  Assimp 5.2.5 : turned by 30, 30, 30 degrees
the same, with a weight of 0
  FBX SDK      : turned by 0, 40, 80 degrees
  three.js r187: turned by 0, 40, 80 degrees; it warns
  Assimp 5.2.5 : turned by 30, 30, 30 degrees
the same, muted
  FBX SDK      : turned by 0, 40, 80 degrees
  three.js r187: turned by 0, 40, 80 degrees; it warns
  Assimp 5.2.5 : turned by 30, 30, 30 degrees
the same, in place of the motion
  FBX SDK      : turned by 30, 30, 30 degrees
  three.js r187: turned by 0, 40, 80 degrees; it warns
  Assimp 5.2.5 : turned by 30, 30, 30 degrees
SAID
diff expected said
echo 'The behaviour is as described.'
