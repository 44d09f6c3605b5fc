#!/usr/bin/env bash
# h5wasm 0.10.3 returns numbers that are not in the file if it cannot decode a dataset: h5py's own compression "lzf" is enough.
#
# LZF comes with h5py (one of its three documented ways to compress), and pose tracks are stored in such files. h5wasm has no LZF
# filter. HDF5 notices that and prints an error trace, but Dataset.value ignores the error: it returns an array of the right length and
# type with the previous content of its buffer. It throws nothing. The same numbers compressed with gzip are read correctly.
#
# Needs: Debian's apt-get, dpkg-deb, npm and node (18 or later), x86-64. Downloads 50 MB, writes to a temporary folder only.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --ignore-scripts h5wasm@0.10.3 > /dev/null

# Unpacks h5py and the packages that it needs. apt-get finds these packages without changing this system.
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
apt-get -qq -y --download-only install python3-h5py=3.7.0-8 python3-minimal > /dev/null
for package in apt/var/cache/apt/archives/*.deb; do dpkg-deb -x "$package" unpacked; done

libraries=$(echo "$folder"/unpacked/usr/lib/*-linux-gnu)
LD_LIBRARY_PATH="$libraries:$libraries/blas:$libraries/lapack" PYTHONHOME="$folder/unpacked/usr" PYTHONPATH="$folder/unpacked/usr/lib/python3/dist-packages" \
  unpacked/usr/bin/python3.11 - <<'PY'
import h5py, numpy
with h5py.File("tracks.h5", "w") as file:
    for compression in ("gzip", "lzf"):
        file.create_dataset(compression, data=numpy.arange(10.0), chunks=(4,), compression=compression)
    assert (file["lzf"][:] == numpy.arange(10.0)).all()
PY

cat > read.mjs <<'CODE'
import h5wasm from 'h5wasm/node';
await h5wasm.ready;
const file = new h5wasm.File('tracks.h5', 'r');
for (const name of ['gzip', 'lzf']) {
  let said;
  try {
    const values = file.get(name).value;
    said = `${values.length} numbers, ${values.every((value, i) => value === i) ? 'right' : 'none of them an error, but not those of the file'}`;
  } catch (error) {
    said = `an exception: ${error.message}`;
  }
  console.log(`${name}: ${said}`);
}
CODE
echo 'h5wasm 0.10.3 on a file by h5py 3.7.0 (Debian 12):'
node read.mjs 2> trace | tee said

diff - said <<'EXPECTED'
gzip: 10 numbers, right
lzf: 10 numbers, none of them an error, but not those of the file
EXPECTED
grep -q "required filter 'lzf' is not registered" trace
echo 'As described: HDF5 prints a trace, and the caller gets numbers.'
