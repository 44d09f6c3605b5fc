#!/usr/bin/env bash
# pyrr 0.10.3's matrices turn a vector backwards if they come from a quaternion, and exchange the axes of pitch and yaw.
#
# matrix33.create_from_quaternion() makes, as its documentation says, a matrix with the same rotation as the quaternion.
# But matrix33.apply_to_vector() multiplies by the vector from the left, so that this matrix, and those of
# create_from_x_rotation(), y and z, turn it the other way. Those of create_from_axis_rotation() turn it as the
# quaternion does. Of the angles [roll, pitch, yaw], euler and quaternion take pitch about y and yaw about z; the matrix
# of the same angles takes pitch about z and yaw about y. So a skeleton's pose depends on whether its rotations pass
# through matrices.
#
# Needs: Debian's apt-get, x86-64. Downloads 34 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# Unpacks pyrr and the packages that it needs. apt-get finds these packages without changing this system.
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
apt-get -qq -y --download-only install python3-pyrr=0.10.3-5 python3-minimal > /dev/null
for package in apt/var/cache/apt/archives/*.deb; do dpkg-deb -x "$package" unpacked; done

libraries=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu)
LD_LIBRARY_PATH="$libraries:$libraries/blas:$libraries/lapack" PYTHONHOME="$folder/unpacked/usr" PYTHONPATH="$folder/unpacked/usr/lib/python3/dist-packages" \
  unpacked/usr/bin/python3.11 - <<'PY' | tee said
from math import pi
from pyrr import matrix33, quaternion

def show(what, vector):
    print(f"{what}: {' '.join(str(round(x)) for x in vector)}")

def by_matrix(matrix, vector):
    return matrix33.apply_to_vector(matrix, vector)

def by_quaternion(turn, vector):
    return quaternion.apply_to_vector(turn, vector)

x, y, z = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]
turn = quaternion.create_from_z_rotation(pi / 2)
print("x, turned by 90 degrees about z")
show("  quaternion", by_quaternion(turn, x))
show("  matrix from the quaternion", by_matrix(matrix33.create_from_quaternion(turn), x))
show("  matrix from z rotation", by_matrix(matrix33.create_from_z_rotation(pi / 2), x))
show("  matrix from axis rotation", by_matrix(matrix33.create_from_axis_rotation(z, pi / 2), x))
def axis_of(turned):
    return " ".join(name for name, axis in (("x", x), ("y", y), ("z", z)) if abs(turned(axis) - axis).max() < 1e-9)

for name, angles in (("roll", [0.5, 0, 0]), ("pitch", [0, 0.5, 0]), ("yaw", [0, 0, 0.5])):
    turn, matrix = quaternion.create_from_eulers(angles), matrix33.create_from_eulers(angles)
    about = [axis_of(lambda v: by_quaternion(turn, v)), axis_of(lambda v: by_matrix(matrix, v))]
    print(f"{name} turns about: quaternion {about[0]}, matrix {about[1]}")
PY

cat > expected <<'SAID'
x, turned by 90 degrees about z
  quaternion: 0 1 0
  matrix from the quaternion: 0 -1 0
  matrix from z rotation: 0 -1 0
  matrix from axis rotation: 0 1 0
roll turns about: quaternion x, matrix x
pitch turns about: quaternion y, matrix z
yaw turns about: quaternion z, matrix y
SAID
diff expected said
echo 'As described: matrices and quaternions differ.'
