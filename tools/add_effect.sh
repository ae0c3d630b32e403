#!/bin/sh
# add_effect.sh - tries what sim/effects/README.md says of adding an effect: its file goes into a copy of the tree, is hidden
# in four flights, and is looked for.
set -eu
o=${O:-out}
copy=$o/add-effect
rm -rf $copy
mkdir -p $copy/out
cp -a Makefile src include sim tools $copy
cp -a "$o/release" "$o/gen" $copy/out
awk '/^```c/ { code = 1; next } code && /^```/ { exit } code' sim/effects/README.md >$copy/fx.c
name=$(sed -n '1s|^// fx_\([a-z_]*\)\.c - .*|\1|p' $copy/fx.c)
mv $copy/fx.c "$copy/sim/effects/fx_$name.c"
make -C $copy O=out out/fly out/gap >/dev/null
cd $copy
{ echo 'ceiling_m = 0.5 # of the simulated room'; cat sim/vehicle/vehicles/cf21_legacy.toml; } >out/vehicle.toml
for seed in 1 2 3 4; do
  [ ! -t 2 ] || printf '\r  flying %d of 4' $seed >&2
  out/fly test-flight --controller indi-theory --effect none --effect rotor_drag:k=1.7e-6 \
    --effect "$name:k=0.03" --seed $seed --log "out/flight$seed.csv" --log-rate 500 >/dev/null
done
[ ! -t 2 ] || printf '\r%20s\r' '' >&2
out/gap --vehicle out/vehicle.toml --columns tools/columns/fly.toml out/flight?.csv >out/said
# What is named, and what the held-out flight flown again gained.
awk '/^(Missing|None|flown again)/ || named; { named = index($0, name ":") == 1 } named' name="$name" out/said
