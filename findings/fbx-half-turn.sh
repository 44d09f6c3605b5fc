#!/usr/bin/env bash
# three.js r187 loses the FBX key that follows a jump of 180 degrees or more: a half turn between two keys does not
# happen at all.
#
# An FBX file stores keys of Euler angles, and each angle is interpolated between its keys. If an angle changes by 180
# degrees or more between two keys, FBXLoader replaces this part of the curve by equally spaced keys of its own. They
# stop one step before the second key, which is lost. A turn from 0 to 180 degrees disappears; one from 0 to 270 goes
# backwards and ends at -60; and where a recorded angle passes from 179 to -172, as recorders write it, the clip ends
# before its last key. The FBX SDK (in FBX2glTF 0.9.7) and Assimp 5.2.5 read all keys.
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
curve() {  # ID ANGLE...: one linear curve, its keys spread over a second
  local id=$1 count=$(($# - 1)) times='' i
  shift
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

turn() {  # ANGLE...: a joint that turns about X
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
$(curve 5 "$@")
$(curve 6 "${@//*/0}")
$(curve 7 "${@//*/0}")
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
import { AnimationMixer, LoopOnce } from 'three';
import { FBXLoader } from 'three/examples/jsm/loaders/FBXLoader.js';
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js';

globalThis.self = globalThis;  // what three.js expects of a browser
const bytes = (name) => Uint8Array.from(readFileSync(name)).buffer;
function say(reader, root, clip) {
  const joint = root.getObjectByName('joint');
  const angles = [0, 0.25, 0.5, 0.75, 1].map((seconds) => {
    const mixer = new AnimationMixer(root), action = mixer.clipAction(clip).setLoop(LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    mixer.setTime(seconds);
    const angle = 2 * Math.atan2(joint.quaternion.x, joint.quaternion.w) * 180 / Math.PI;
    return ((Math.round(angle * 10) / 10 + 360) % 360).toFixed(1);
  });
  console.log(`  ${reader}: ${clip.duration.toFixed(2)} s, at each quarter ${angles.join(', ')}`);
}
const sdk = await new GLTFLoader().parseAsync(bytes('sdk.glb'), ''), assimp = await new GLTFLoader().parseAsync(bytes('assimp.glb'), '');
const three = new FBXLoader().parse(bytes('turn.fbx'), '');
say('FBX SDK      ', sdk.scene, sdk.animations[0]);
say('Assimp 5.2.5 ', assimp.scene, assimp.animations[0]);
say('three.js r187', three, three.animations[0]);
CODE

for keys in '0 160' '0 180' '0 270' '170 179 -172'; do
  turn $keys > turn.fbx
  node_modules/fbx2gltf/bin/Linux/FBX2glTF --binary --anim-framerate bake60 --input turn.fbx --output sdk > /dev/null
  LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) unpacked/usr/bin/assimp export turn.fbx assimp.glb -fglb2 > /dev/null
  echo "keys $keys"
  node angles.mjs
done | tee said

cat > expected <<'SAID'
keys 0 160
  FBX SDK      : 1.00 s, at each quarter 0.0, 40.0, 80.0, 120.0, 160.0
  Assimp 5.2.5 : 1.00 s, at each quarter 0.0, 40.0, 80.0, 120.0, 160.0
  three.js r187: 1.00 s, at each quarter 0.0, 40.0, 80.0, 120.0, 160.0
keys 0 180
  FBX SDK      : 1.00 s, at each quarter 0.0, 45.0, 90.0, 135.0, 180.0
  Assimp 5.2.5 : 1.00 s, at each quarter 0.0, 45.0, 90.0, 135.0, 180.0
  three.js r187: 0.00 s, at each quarter 0.0, 0.0, 0.0, 0.0, 0.0
keys 0 270
  FBX SDK      : 1.00 s, at each quarter 0.0, 67.5, 135.0, 202.5, 270.0
  Assimp 5.2.5 : 1.00 s, at each quarter 0.0, 67.5, 135.0, 202.5, 270.0
  three.js r187: 0.67 s, at each quarter 0.0, 337.5, 315.0, 300.0, 300.0
keys 170 179 -172
  FBX SDK      : 1.00 s, at each quarter 170.0, 174.5, 179.0, 3.5, 188.0
  Assimp 5.2.5 : 1.00 s, at each quarter 170.0, 174.5, 179.0, 3.5, 188.0
  three.js r187: 0.76 s, at each quarter 170.0, 174.5, 179.0, 183.5, 183.6
SAID
diff expected said
echo 'The behaviour is as described.'
