#!/bin/sh
# gap_demo.sh [DATA] - flies with a hidden effect, lets the workflow find it, flies the model that it wrote; then real flights.
set -eu
DATA=${1:-} o=${O:-out}
. tools/typed.sh
d=$o/demo/gap
rm -rf "$d"
mkdir -p "$d"

# What the workflow is given knows the ceiling's height, and nothing of what it does. What flies has a ceiling
# effect of another form than the ones that are tried.
{ echo 'ceiling_m = 0.5 # of the simulated room'; cat sim/vehicle/vehicles/cf21_legacy.toml; } >"$d/vehicle.toml"
typed "for seed in 1 2 3 4; do
    $o/fly test-flight --controller indi-theory --effect none --effect rotor_drag:k=1.7e-6 --effect ceiling:form=square-root \\
      --seed \$seed --log $d/flight\$seed.csv --log-rate 500 >/dev/null
  done"
typed "$o/gap --vehicle $d/vehicle.toml --columns tools/columns/fly.toml --out $d/report $d/flight?.csv"

awk -F, 'NR == 1 || $1 == "ceiling"' "$d/report/curves.csv" >"$d/ceiling.csv"
gnuplot <<G
set terminal dumb noenhanced mono size 100,22
set datafile separator ","
set xlabel "ceiling distance, m"
set title "What the ceiling adds to the vertical specific force, m/s2 (report.html, held-out flight)"
set border 3; set tics nomirror
set output "$d/curve.txt"
plot "$d/ceiling.csv" u "at":"adds" w l t "named effect", "" u "at":"measured" w p pt 7 t "measured"
G
echo
sed -e 's/[[:space:]]*$//' -e '/./,$!d' "$d/curve.txt"

echo
typed "$o/fly test-flight --controller indi-theory --effect none --effect rotor_drag:k=1.7e-6 \\
    --vehicle $d/report/model.toml | tail -n 1"
if [ -n "$DATA" ] && [ -d "$DATA/ground_effect" ]; then
  echo
  echo 'Real flights over the ground:'
  # shellcheck disable=SC2016 # the folder is the reader's
  typed "$o/gap --vehicle sim/vehicle/vehicles/cf21_neural_swarm.toml --columns tools/columns/neural_swarm.toml --out $d/ground "'\
    --hold-out "$DATA/ground_effect/21_randomwalk_s_cf50_02.csv" "$DATA"/ground_effect/21_randomwalk_s_cf50_*.csv'
fi
