#!/bin/sh
# pil.sh [objects] - the app for the Crazyflie's processor: what its objects call, its bits, what a call costs.
#
#   objects: no libm, no double, no heap, no fused multiply-add in what flies; that alone if asked for
#   bits:    recorded calls, spoiled ones among them, answered alike by the host (compilers, levels, sanitizers)
#            and by an emulated Cortex-M4F; and a flight whose every call is answered by the latter
#   cost:    instructions and stack of each call, exact by the emulator's counter
#
# Without cross compiler or emulator it says so and is content: make setup-pil installs them.
set -eu
for program in arm-none-eabi-gcc qemu-system-arm; do
  command -v $program >/dev/null || { echo "skipped: no $program; make setup-pil installs it"; exit 0; }
done
o=${O:-out}
out=$o/pil
mkdir -p $out/objects
app="src/*.c src/firmware/battery_cap.c src/firmware/controller.c src/firmware/range_up.c src/firmware/recorder.c src/firmware/settings.c src/firmware/telemetry.c src/firmware/units.c"
around="test/pil/around.c test/pil/pil.c sim/crazyflie/stand_in_vehicle.c sim/crazyflie/sections.c"
paths="-D_Thread_local= -Iinclude -Isrc -Isim/crazyflie -Isim -Itest"
# As the firmware compiles an app (its tools/make), and with what the app adds to that: no fused multiply-add.
own=$(sed -nE 's/^ccflags-y \+= (-f[^ ]*) .*/\1/p' src/firmware/Kbuild)
bits="-std=gnu11 -fno-math-errno $own"
m4="-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 $bits -fno-strict-aliasing -ffunction-sections \
 -fdata-sections -Wall -Wdouble-promotion -Werror"
fail() {
  echo "pil: $*" >&2
  exit 1
}

# --- objects ------------------------------------------------------------------------------------------------

rm -f $out/objects/*
for file in $app; do
  arm-none-eabi-gcc $m4 -Os $paths -c "$file" -o $out/objects/"$(basename "$file" .c)".o || fail "$file does not build"
done
arm-none-eabi-nm $out/objects/*.o | sed -nE 's/^[0-9a-f]+ [A-TV-Z] //p' | sort -u >$out/defined
arm-none-eabi-nm -u $out/objects/*.o | sed -nE 's/^ +U //p' | sort -u | grep -vxFf $out/defined >$out/called || true
allowed='^(memcpy|memcmp|memset|strcmp|rangeGet|controllerPid|controllerPidInit|supervisorCanFly|supervisorIsFlying|supervisorAreMotorsAllowedToRun|client_wrote|usddeckLoggingEnabled|eventTrigger|motorsGetRatio|pmGetBatteryVoltage|stand_in)$'
! grep -vE "$allowed" $out/called || fail "flight code calls what stands above: libm, double, heap or unknown"
! arm-none-eabi-objdump -d $out/objects/*.o | grep -E 'vfma|vfms|vfnma|vfnms|\.f64' || fail "flight code has a fused or double operation"
echo "objects: no libm, no double, no heap, no fused operation ($(wc -l <$out/called) functions called from outside)"
[ "${1:-}" = objects ] && exit 0

# --- bits ---------------------------------------------------------------------------------------------------

make -s O="$o" "$o/release/bin/pil-record"
"$o/release/bin/pil-record" $out/trace

for row in "gcc -O0" "gcc -O2" "gcc -O3" "gcc -O1 -fsanitize=address,undefined -fno-sanitize-recover=all" "clang -O2" "clang -O3 -march=haswell"; do
  command -v ${row%% *} >/dev/null || continue
  $row $bits $paths $app $around test/pil/replay.c -lm -o $out/replay
  $out/replay $out/trace $out/host.now >$out/said
  [ -f $out/host.out ] && [ "$row" != "gcc -O0" ] || mv $out/host.now $out/host.out
  [ ! -f $out/host.now ] || cmp $out/host.out $out/host.now || fail "$row gives other bits than gcc -O0"
  rm -f $out/host.now
  echo "bits: host $row: $(cat $out/said)"
done

[ "$(sed "s/.*, \([0-9]*\) floats.*/\1/" $out/said)" -ge 10000000 ] || fail "fewer than 10,000,000 floats are compared"

on_target() { # LEVEL IN OUT COST BATCH
  qemu-system-arm -M netduinoplus2 -nographic -monitor none -serial none -icount shift=7 -kernel "$out/target$1.elf" \
    -semihosting-config enable=on,target=native,arg=target,arg="$2",arg="$3",arg="$4",arg="$5"
}
for level in -Os -O2; do
  arm-none-eabi-gcc $m4 $level $paths $app $around test/pil/target.c -nostartfiles --specs=nosys.specs -T test/pil/target.ld \
    -Wl,--gc-sections -Wl,--no-warn-rwx-segments -o "$out/target$level.elf" 2>$out/link || { cat $out/link >&2; fail "the image does not build"; }
  on_target $level $out/trace $out/target.out $out/cost$level 64
  cmp $out/host.out $out/target.out || fail "Cortex-M4F $level gives other bits than the host"
  echo "bits: Cortex-M4F $level: the same"
done
rm -f $out/to $out/from
mkfifo $out/to $out/from
on_target -Os $out/to $out/from - 1 &
target=$!
"$o/release/bin/pil-record" $out/to $out/from >$out/said || { kill $target; fail "in the loop: $(cat $out/said)"; }
wait $target || fail "the target did not end well"
echo "in the loop, flown by the Cortex-M4F: $(cat $out/said)"

# --- cost ---------------------------------------------------------------------------------------------------

for level in -Os -O2; do
  od -An -v -tu4 -w8 $out/cost$level | awk -v level=$level -f test/pil/cost.awk ||
    fail "more than 4,000 instructions a tick in flights as shipped, in that of the ground, 4,600 in spoiled ones, 672 for the inner loop (729 with -O2), or 512 bytes of stack"
done
