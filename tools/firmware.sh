#!/bin/sh
# firmware.sh build|cload BASE PROPELLERS - the app in the Crazyflie firmware at BASE, for legacy or plus propellers.
#
# The firmware's build leaves objects beside the sources: it gets a tree of links under out/.
set -eu
verb=$1 base=$2 propellers=$3
if [ -z "$base" ]; then
  cat >&2 <<'EOF'
CRAZYFLIE_BASE is not set: the folder of the Crazyflie firmware, as absolute path. To get it, once:
  git clone --recursive --branch 2026.08 https://github.com/bitcraze/crazyflie-firmware.git
  make firmware CRAZYFLIE_BASE=$PWD/crazyflie-firmware
The cross compiler comes with: make setup-pil
EOF
  exit 2
fi
[ -f "$base/tools/make/oot.mk" ] || { echo "CRAZYFLIE_BASE=$base: not the Crazyflie firmware, it has no tools/make/oot.mk" >&2; exit 2; }
command -v arm-none-eabi-gcc >/dev/null || { echo "arm-none-eabi-gcc is missing: make setup-pil installs it" >&2; exit 1; }
base=$(cd "$base" && pwd)
case $propellers in
legacy | plus) ;;
*) echo "PROPELLERS=$propellers: allowed is legacy or plus" >&2; exit 2 ;;
esac

mkdir -p "${O:-out}/firmware/$propellers/src"
tree=$(cd "${O:-out}/firmware/$propellers" && pwd)
rm -rf "$tree/src" "$tree/include" # links to what is no more
cp -rs "$PWD/src" "$PWD/include" "$tree"
ln -sf src/firmware/Kbuild "$tree/Kbuild"
cp src/firmware/app-config "$tree/app-config"
if [ "$propellers" = legacy ]; then
  printf '# CONFIG_CRAZYFLIE_21_PLUS is not set\nCONFIG_CRAZYFLIE_LEGACY_PROPELLERS=y\n' >>"$tree/app-config"
fi

oot() {
  env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL make -j"$(nproc)" -f "$base/tools/make/oot.mk" \
    CRAZYFLIE_BASE="$base" OOT="$tree" OOT_CONFIG="$tree/app-config" "$@"
}
if [ "$verb" = cload ]; then
  oot cload
  exit
fi
log=$tree/build.log
if ! oot >"$log" 2>&1; then
  tail -20 "$log" >&2
  echo "the firmware does not build; the whole log is $log" >&2
  exit 1
fi
if grep -n 'warning:' "$log"; then
  echo "the firmware builds with warnings; the whole log is $log" >&2
  exit 1
fi
{
  echo "$propellers propellers: out/firmware/$propellers/build/cf2.bin"
  grep -E '^(Flash|RAM|CCM) ' "$log" | sed -E 's/\|[^|]*$//; s/^/  /; s/ *$//'
} >"$tree/size"
cat "$tree/size"
