#!/bin/sh
# pil.sh - the app's recorded calls on the host and on an emulated Cortex-M4F: the same bits, and what they cost.
#
# Without cross compiler or emulator it says so and is content: make setup-pil installs them.
set -eu
for program in arm-none-eabi-gcc qemu-system-arm; do
  command -v $program >/dev/null || { echo "skipped: no $program; make setup-pil installs it"; exit 0; }
done
out=out/pil
mkdir -p $out
app="src/*.c src/firmware/controller.c src/firmware/range_up.c src/firmware/settings.c src/firmware/telemetry.c src/firmware/units.c"
around="test/pil/around.c test/pil/pil.c sim/crazyflie/sections.c"
paths="-D_Thread_local= -Iinclude -Isrc -Isim/crazyflie -Isim"
# As the firmware compiles an app (its tools/make), and with its own -ffp-contract=off (src/firmware/Kbuild).
m4="-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -std=gnu11 -fno-math-errno -ffp-contract=off \
 -fno-strict-aliasing -ffunction-sections -fdata-sections -Wall -Wdouble-promotion -Werror"

build_target() { # LEVEL
  arm-none-eabi-gcc $m4 "$1" $paths $app $around test/pil/target.c -nostartfiles --specs=nosys.specs \
    -T test/pil/target.ld -Wl,--gc-sections -Wl,--no-warn-rwx-segments -o "$out/target$1.elf"
}
on_target() { # IMAGE IN OUT COST BATCH
  qemu-system-arm -M netduinoplus2 -nographic -monitor none -serial none -icount shift=7 -kernel "$1" \
    -semihosting-config enable=on,target=native,arg=target,arg="$2",arg="$3",arg="$4",arg="$5"
}
