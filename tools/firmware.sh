#!/bin/sh
# firmware.sh build|cload BASE PROPELLERS - the app in the Crazyflie firmware at BASE, for legacy or plus propellers.
#
# The firmware's build leaves objects beside the sources, so that it gets a tree of links under out/.
set -eu
verb=$1 base=$2 propellers=$3
refuse() {
  echo "$*" >&2
  exit 2
}
if [ -z "$base" ]; then
  cat >&2 <<'EOF'
CRAZYFLIE_BASE is not set: the folder of the Crazyflie firmware, as absolute path. To get it, once:
  git clone --recursive --branch 2026.08 https://github.com/bitcraze/crazyflie-firmware.git
  make firmware CRAZYFLIE_BASE=$PWD/crazyflie-firmware
The cross compiler comes with: make setup-pil
EOF
  exit 2
fi
case $propellers in
legacy | plus) ;;
upgrade) refuse "PROPELLERS=upgrade: the thrust upgrade kit is not supported: curve, limits and inertia are not its; allowed is legacy or plus" ;;
brushless) refuse "PROPELLERS=brushless: the Crazyflie Brushless is not supported: curve, limits and inertia are not its; allowed is legacy or plus" ;;
*) refuse "PROPELLERS=$propellers: allowed is legacy or plus" ;;
esac
[ -f "$base/tools/make/oot.mk" ] || refuse "CRAZYFLIE_BASE=$base: not the Crazyflie firmware, it has no tools/make/oot.mk"
for file in CMSIS/CMSIS/Core/Include/core_cm4.h FreeRTOS/tasks.c libdw1000/inc/libdw1000.h; do
  [ -f "$base/vendor/$file" ] || refuse "CRAZYFLIE_BASE=$base: its submodules are missing; type: git -C $base submodule update --init --recursive"
done
command -v arm-none-eabi-gcc >/dev/null || { echo "arm-none-eabi-gcc is missing: make setup-pil installs it" >&2; exit 1; }
base=$(cd "$base" && pwd)
o=$(mkdir -p "${O:-out}" && cd "${O:-out}" && pwd)
loader=$o/cf/bin/python
[ "$verb" != cload ] || "$loader" -c 'import cfloader' 2>/dev/null ||
  { echo "cfloader is missing: make setup-cf installs it" >&2; exit 1; }

mkdir -p "$o/firmware/$propellers/src"
tree=$o/firmware/$propellers
rm -rf "$tree/src" "$tree/include" # links to what is no more
cp -rs "$PWD/src" "$PWD/include" "$tree"
ln -sf src/firmware/Kbuild "$tree/Kbuild"
cp src/firmware/app-config "$tree/app-config"
if [ "$propellers" = legacy ]; then
  printf '# CONFIG_CRAZYFLIE_21_PLUS is not set\nCONFIG_CRAZYFLIE_LEGACY_PROPELLERS=y\n' >>"$tree/app-config"
fi
# An old configuration would keep what this one does not name.
cmp -s "$tree/app-config" "$tree/app-config.built" || rm -f "$tree/build/.config"

APP_VERSION=$(tools/version.sh)
export APP_VERSION
oot() {
  env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL make -j"$(nproc)" -f "$base/tools/make/oot.mk" \
    CRAZYFLIE_BASE="$base" OOT="$tree" OOT_CONFIG="$tree/app-config" CLOAD_SCRIPT="$loader -m cfloader" "$@"
}
log=$tree/build.log
if ! oot >"$log" 2>&1; then
  tail -20 "$log" >&2
  echo "the firmware does not build; the whole log is $log" >&2
  exit 1
fi
cp "$tree/app-config" "$tree/app-config.built"
if grep -n 'warning:' "$log"; then
  echo "the firmware builds with warnings; the whole log is $log" >&2
  exit 1
fi
{
  echo "$propellers propellers: ${tree#"$PWD"/}/build/cf2.bin"
  grep -E '^(Flash|RAM|CCM) ' "$log" | sed -E 's/\|[^|]*$//; s/^/  /; s/ *$//'
} >"$tree/size"
cat "$tree/size"
[ "$verb" != cload ] || oot cload
