#!/usr/bin/env bash
# OpenSceneGraph 3.6.5 reads the rotation channels of every BVH file as Z, X, Y, whatever its CHANNELS line says.
#
# A BVH joint lists its channels in the order in which they apply (University of Wisconsin, CS 838, 1999); files with X, Y, Z or
# Z, Y, X are common. The plugin counts the channels and never reads their names. The two files below differ in these names only and
# mean different rotations, but give the same quaternions to the last digit: those of Z, X, Y. The reader reports nothing.
#
# Needs: Debian's apt-get, dpkg-deb, python3, x86-64. Downloads 60 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Unpacks the program and the packages that it needs. apt-get finds these packages without changing this system.
mkdir -p apt/etc/apt/apt.conf.d apt/etc/apt/preferences.d apt/var/lib/apt/lists/partial apt/var/lib/dpkg apt/var/cache/apt/archives/partial
: > apt/var/lib/dpkg/status
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian bookworm main" > apt/etc/apt/sources.list
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
apt-get -qq -y --download-only install openscenegraph=3.6.5+dfsg1-8+b2 > /dev/null
for package in apt/var/cache/apt/archives/*.deb; do dpkg-deb -x "$package" unpacked; done

read_as() {  # ORDER CHANNEL CHANNEL CHANNEL: the chest's rotation (x y z w) of a file whose channels have these names
  cat > "$1.bvh" <<BVH
HIERARCHY
ROOT Hips
{
  OFFSET 0 90 0
  CHANNELS 6 Xposition Yposition Zposition $2 $3 $4
  JOINT Chest
  {
    OFFSET 0 20 0
    CHANNELS 3 $2 $3 $4
    End Site
    {
      OFFSET 0 30 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.0333333
0 90 0 0 0 0 40 50 60
0 90 0 0 0 0 40 50 60
BVH
  LD_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu) OSG_LIBRARY_PATH=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu/osgPlugins-*) \
    unpacked/usr/bin/osgconv "$1.bvh" "$1.osgt" > /dev/null
  grep -A4 QuatSphericalLinearChannel "$1.osgt" | tail -1 | awk '{print $2, $3, $4, $5}'
}

meant() {  # ORDER: the rotation that the channel names define: by 40, 50 and 60 degrees about these axes in turn
  python3 - "$1" <<'PY'
import math, sys
x, y, z, w = 0.0, 0.0, 0.0, 1.0
for axis, degrees in zip(sys.argv[1], (40, 50, 60)):
    s, c = math.sin(math.radians(degrees) / 2), math.cos(math.radians(degrees) / 2)
    a, b, d = (s * (axis == name) for name in "XYZ")
    x, y, z, w = w * a + x * c + y * d - z * b, w * b - x * d + y * c + z * a, w * d + x * b - y * a + z * c, w * c - x * a - y * b - z * d
print(*(f"{value:.6g}" for value in (x, y, z, w)))
PY
}

echo 'OpenSceneGraph 3.6.5 (Debian 12), the chest of a BVH file:'
zxy=$(read_as ZXY Zrotation Xrotation Yrotation)
xyz=$(read_as XYZ Xrotation Yrotation Zrotation)
printf 'channels %s: read %s, meant %s\n' Z,X,Y "$zxy" "$(meant ZXY)" X,Y,Z "$xyz" "$(meant XYZ)"

[ "$zxy" = "$(meant ZXY)" ] && [ "$xyz" = "$zxy" ] && [ "$xyz" != "$(meant XYZ)" ]
echo 'As described: the names of the channels make no difference.'
