#!/bin/sh
# demo.sh [DATA] - flies the thesis's appendix A, learns the curve in simulation and from real flights, draws pictures.
set -eu
data=${1:-}
o=${O:-out}
out=$o/demo
rm -rf $out
mkdir -p $out

# fly NAME LABEL options...: one flight of appendix A; a row of the table and a log.
fly() {
  name=$1 label=$2
  shift 2
  [ ! -t 2 ] || printf '\r  flying %-40s' "$label" >&2
  "$o/fly" appendix-a --log "$out/$name.csv" "$@" >"$out/$name.txt"
  awk -v label="$label" '
    function mm(x) { return x < 0.005 ? "0" : sprintf("%.2f", x) }
    $1 == "0.48" { printf "  %-34s %12s %8s %10s %9s\n", label, mm($2), $4 == "-" ? "-" : sprintf("%.2f", $4), sprintf("%.1f", $9), $10 }' \
    "$out/$name.txt" >>$out/table.txt
}

printf '  %-34s %12s %8s %10s %9s\n' 'step from 43 to 48 cm, ceiling 50' 'overshoot mm' 't90 s' 'gap mm' 'contacts' >$out/table.txt
for cutoff in 0 8; do
  [ $cutoff = 0 ] && signals='not filtered' || signals='8 Hz filter'
  set -- --set indiPos.cutoff=$cutoff
  fly a4_$cutoff "no ceiling effect, $signals" "$@" --effect none
  fly a5_$cutoff "standard INDI, $signals" "$@"
  fly a6_$cutoff "theory, lead 0.01 s, $signals" "$@" --controller indi-theory --set ceil.kz=0.01
  fly a8_$cutoff "theory, lead 0.3 s, $signals" "$@" --controller indi-theory
  fly a10_$cutoff "fitted RBF, $signals" "$@" --controller indi-rbf
  fly learned_$cutoff "learned RBF, $signals" "$@" --controller indi-learned
done
[ ! -t 2 ] || printf '\r  %-48s\r' '' >&2
echo "Appendix A of the thesis, flown by the flight code"
cat $out/table.txt

"$o/fly" learning-1d --log $out/learning.csv >$out/learning.txt
echo
echo "Learning flight, 10 to 2 cm in steps of 2 cm, noise N1: weights learned from nothing"
awk '/ceil\.w/ { printf "  %s = %s\n", $1, $2 }' $out/learning.txt

flights=$data/ground_effect
if [ -n "$data" ] && [ -d "$flights" ]; then
  echo
  echo "Real flights over the ground (two to learn from, one held out)"
  "$o/learn" "$flights/21_randomwalk_s_cf50_00.csv" "$flights/21_randomwalk_s_cf50_04.csv" \
    --hold-out "$flights/21_randomwalk_s_cf50_02.csv" --columns tools/columns/neural_swarm.toml \
    --vehicle sim/vehicle/vehicles/cf21_neural_swarm.toml --surface ground --points $out/ground_points.csv \
    --json $out/ground.json
elif [ -n "$data" ]; then
  echo "skipped: no ground_effect folder in $data"
else
  echo
  echo "skipped: no measured data (make demo DATA=DIR learns from real flights)"
fi

tools/plots.sh $out
echo
echo "pictures:"
ls $out/*.png | sed 's/^/  /'
