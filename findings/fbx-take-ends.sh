#!/usr/bin/env bash
# three.js r187 and Assimp 5.2.5 cut an FBX take by dropping keys: a joint between two keys stands still or disappears
# from the clip, and Assimp adds a second before the take that the file does not contain.
#
# A take's LocalStart and LocalStop are times, not keys; the pose at either end follows from the keys around it. FBX2glTF
# 0.9.7 does not cut the take: its frames show the poses that the FBX SDK finds between the keys. Assimp, and three.js if
# its trimAnimationClips is set, drop every key outside of the take, so a joint that turns from a key before it to a key
# after it does not turn at all. In addition, Assimp keeps the first key of a rotation, however early it is. The clip then
# begins at a negative time, which glTF forbids, and a straight line replaces what the joint did until LocalStart: here it
# stands still where the file turns it by 90 degrees. There is no warning. Assimp 5.4.3 and 6.0.5 do the same.
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
ticks() {  # TENTHS-OF-A-SECOND...
  local tenth times=''
  for tenth in $1; do times+="${times:+,}$((second / 10 * tenth))"; done
  echo "$times"
}
curve() {  # ID TENTHS-OF-A-SECOND ANGLES
  local count
  count=$(wc -w <<< "$2")
  cat <<FBX
	AnimationCurve: $1, "AnimCurve::", "" {
		Default: 0
		KeyVer: 4008
		KeyTime: *$count {
			a: $(ticks "$2")
		}
		KeyValueFloat: *$count {
			a: ${3// /,}
		}
		KeyAttrFlags: *1 {
			a: 4
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

turn() {  # FROM TO TENTHS-OF-A-SECOND ANGLES: a joint that turns about Z, and a take
  local none
  none=$(sed 's/[0-9]\+/0/g' <<< "$4")
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
			P: "LocalStart", "KTime", "Time", "",$(ticks "$1")
			P: "LocalStop", "KTime", "Time", "",$(ticks "$2")
			P: "ReferenceStart", "KTime", "Time", "",$(ticks "$1")
			P: "ReferenceStop", "KTime", "Time", "",$(ticks "$2")
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
$(curve 5 "$3" "$none")
$(curve 6 "$3" "$none")
$(curve 7 "$3" "$4")
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

cat > angles.mjs <<'CODE'
import { readFileSync } from 'node:fs';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // what three.js expects of a browser
const start = Number(process.argv[2]) / 10, asked = process.argv[3].split(' ').map((tenths) => tenths / 10);
const bytes = (name) => Uint8Array.from(readFileSync(name)).buffer;
function say(reader, { animations: [clip] }, zero) {  // zero: the time in the file at which the clip's time is 0
  const track = clip.tracks.find(({ name }) => name === 'joint.quaternion');
  if (!track) return console.log(`  ${reader}: the clip does not move the joint`);
  const turn = track.createInterpolant();
  const angles = asked.map((seconds) => {
    const [, , z, w] = turn.evaluate(seconds - zero);
    return (Math.atan2(z, w) * 360 / Math.PI + 0).toFixed(0);
  });
  const keys = track.times.length > 5 ? 'one in each frame' : [...track.times].map((time) => `${+time.toFixed(3)} s`).join(', ');
  console.log(`  ${reader}: turned by ${angles.join(', ')} degrees; keys of the clip: ${keys}`);
}
say('FBX SDK              ', await new GLTFLoader().parseAsync(bytes('sdk.glb'), ''), 0);
say('three.js r187        ', new FBXLoader().parse(bytes('turn.fbx'), ''), 0);
const trimmer = new FBXLoader();
trimmer.trimAnimationClips = true;
say('three.js r187 trimmed', trimmer.parse(bytes('turn.fbx'), ''), start);
say('Assimp 5.2.5         ', await new GLTFLoader().parseAsync(bytes('assimp.glb'), ''), start);
CODE

try() {  # WHAT FROM TO TENTHS-OF-A-SECOND ANGLES ASKED
  turn "${@:2:4}" > turn.fbx
  node_modules/fbx2gltf/bin/Linux/FBX2glTF --binary --anim-framerate bake60 --input turn.fbx --output sdk > /dev/null
  LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) unpacked/usr/bin/assimp export turn.fbx assimp.glb -fglb2 > /dev/null
  echo "$1"
  node angles.mjs "$2" "$6"
}
{
  try 'keys at 0 and 2 s, a take from 0 to 2 s: the pose at 0, 1 and 2 s' 0 20 '0 20' '0 80' '0 10 20'
  try 'the same keys, a take from 0.5 to 1.5 s: the pose at 0.5, 1 and 1.5 s' 5 15 '0 20' '0 80' '5 10 15'
  try 'the same keys, a take from 0 to 1.5 s: the pose at 0, 1 and 1.5 s' 0 15 '0 20' '0 80' '0 10 15'
  try 'keys at 0, 0.5, 1 and 2 s, a take from 1 to 2 s: the pose at 0, 0.5, 1 and 2 s' 10 20 '0 5 10 20' '0 90 0 80' '0 5 10 20'
} | tee said

cat > expected <<'SAID'
keys at 0 and 2 s, a take from 0 to 2 s: the pose at 0, 1 and 2 s
  FBX SDK              : turned by 0, 40, 80 degrees; keys of the clip: one in each frame
  three.js r187        : turned by 0, 40, 80 degrees; keys of the clip: 0 s, 2 s
  three.js r187 trimmed: turned by 0, 40, 80 degrees; keys of the clip: 0 s, 2 s
  Assimp 5.2.5         : turned by 0, 40, 80 degrees; keys of the clip: 0 s, 2 s
the same keys, a take from 0.5 to 1.5 s: the pose at 0.5, 1 and 1.5 s
  FBX SDK              : turned by 20, 40, 60 degrees; keys of the clip: one in each frame
  three.js r187        : turned by 20, 40, 60 degrees; keys of the clip: 0 s, 2 s
  three.js r187 trimmed: the clip does not move the joint
  Assimp 5.2.5         : turned by 0, 0, 0 degrees; keys of the clip: -0.5 s
the same keys, a take from 0 to 1.5 s: the pose at 0, 1 and 1.5 s
  FBX SDK              : turned by 0, 40, 60 degrees; keys of the clip: one in each frame
  three.js r187        : turned by 0, 40, 60 degrees; keys of the clip: 0 s, 2 s
  three.js r187 trimmed: turned by 0, 0, 0 degrees; keys of the clip: 0 s
  Assimp 5.2.5         : turned by 0, 0, 0 degrees; keys of the clip: 0 s
keys at 0, 0.5, 1 and 2 s, a take from 1 to 2 s: the pose at 0, 0.5, 1 and 2 s
  FBX SDK              : turned by 0, 90, 0, 80 degrees; keys of the clip: one in each frame
  three.js r187        : turned by 0, 90, 0, 80 degrees; keys of the clip: 0 s, 0.5 s, 1 s, 2 s
  three.js r187 trimmed: turned by 0, 0, 0, 80 degrees; keys of the clip: 0 s, 1 s
  Assimp 5.2.5         : turned by 0, 0, 0, 80 degrees; keys of the clip: -1 s, 0 s, 1 s
SAID
diff expected said
echo 'The behaviour is as described.'
