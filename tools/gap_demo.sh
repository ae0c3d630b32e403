#!/bin/sh
# gap_demo.sh [DATA] - flies with a hidden effect, lets the workflow find it, flies the model that it wrote; then real flights.
set -eu
data=${1:-}
out=out/demo/gap
rm -rf $out
mkdir -p $out

# What the workflow is given knows the ceiling's height, and nothing of what it does. What flies has a ceiling
# effect of another form than the ones that are tried.
{ echo 'ceiling_m = 0.5 # of the simulated room'; cat sim/vehicles/cf21_legacy.toml; } >$out/vehicle.toml
for seed in 1 2 3 4; do
  [ ! -t 2 ] || printf '\r  flying %d of 4' $seed >&2
  out/fly test-flight --controller indi-theory --effect none --effect rotor_drag:k=1.7e-6 \
    --effect ceiling:form=square-root --seed $seed --log "$out/flight$seed.csv" --log-rate 500 >/dev/null
done
[ ! -t 2 ] || printf '\r%20s\r' '' >&2
cd $out
echo '$ gap --vehicle vehicle.toml --columns fly.toml --out report flight?.csv'
../../gap --vehicle vehicle.toml --columns ../../../tools/columns/fly.toml --out report flight?.csv

awk -F, 'NR == 1 || $1 == "ceiling"' report/curves.csv >ceiling.csv
gnuplot <<'G'
set terminal dumb noenhanced mono size 100,22
set datafile separator ","
set xlabel "ceiling distance, m"
set title "What the ceiling adds to the vertical specific force, m/s2 (report.html, held-out flight)"
set border 3; set tics nomirror
set output "curve.txt"
plot "ceiling.csv" u "at":"adds" w l t "named effect", "" u "at":"measured" w p pt 7 t "measured"
G
echo
sed -e 's/[[:space:]]*$//' -e '/./,$!d' curve.txt

echo
echo '$ fly test-flight --vehicle report/model.toml'
../../fly test-flight --controller indi-theory --effect none --effect rotor_drag:k=1.7e-6 --vehicle report/model.toml | tail -n 1 | sed 's|, [0-9]* x real time||'
cd ../../..
if [ -n "$data" ] && [ -d "$data/ground_effect" ]; then
  echo
  echo '$ gap --hold-out 21_randomwalk_s_cf50_02.csv 21_randomwalk_s_cf50_*.csv   (real flights over the ground)'
  out/gap --vehicle sim/vehicles/cf21_neural_swarm.toml --columns tools/columns/neural_swarm.toml --out $out/ground \
    --hold-out "$data/ground_effect/21_randomwalk_s_cf50_02.csv" "$data"/ground_effect/21_randomwalk_s_cf50_*.csv
fi
