#!/bin/sh
# flights.sh - the thesis's flights (section 5.3): ten seeds of each controller, tables, pictures like figures 9 to 13.
set -eu
o=${O:-out}
out=$o/flights seeds=10 here=$PWD
rm -rf $out
mkdir -p $out
controllers='indi indi-theory indi-rbf indi-learned stock-pid stock-indi air-garage'

say() { [ ! -t 2 ] || printf '\r  flying %-40s' "$*" >&2; }
fly() { "$o/fly" "$@" --integrator rk4; }

# lines FILE: it must have one for each flight.
lines() {
  [ "$(wc -l <"$1")" = $seeds ] || { echo "flights.sh: $1: not the $seeds flights that were asked for" >&2; exit 1; }
}

# table SCENARIO: a row for each controller and distance, over all flights.
table() {
  for controller in $controllers; do
    say "$1, $controller"
    fly "$1" --controller "$controller" --from 1 --to $seeds --json "$out/$1.$controller.jsonl" >"$out/$1.$controller.txt"
    lines "$out/$1.$controller.jsonl"
  done
  # All touch at the last distance of the close flight.
  (cd $out && awk -v sd_of_free=$([ "$1" = test-flight ] && echo 1 || echo 0) -f "$here/tools/flights.awk" \
    $(printf "$1.%s.jsonl " $controllers))
}

# mean CONTROLLER: mean and standard deviation of the height over all flights, at each instant.
mean() {
  : >$out/logs.csv
  for seed in $(seq $seeds); do
    say "pictures, $1 $seed"
    fly test-flight --controller "$1" --seed "$seed" --log "$out/log.csv" >/dev/null
    cat $out/log.csv >>$out/logs.csv
  done
  awk -F, '
    $1 == "timestamp" { for (i = 1; i <= NF; i++) at[$i] = i; rest = -1; next }
    { if (rest < 0) { rest = $at["sim.z"]; ceiling = rest + $at["sim.gap"] }
      t = $1 / 1e3; z = $at["sim.z"]; top = $at["stateEstimate.z"] + $at["ceil.zc"] + rest
      n[t]++; sum[t] += z; sum2[t] += z * z; tops[t] += top; set[t] = $at["ctrltarget.z"] + rest }
    END { for (t in n) { m = sum[t] / n[t]; v = sum2[t] / n[t] - m * m
            printf "%.2f %.6f %.6f %.4f %.6f %.6f\n", t, m, sqrt(v > 0 ? v : 0), set[t], tops[t] / n[t], ceiling } }' \
    $out/logs.csv >$out/means.txt
  sort -n $out/means.txt >"$out/mean.$1.txt"
}

cat <<'T'
Six degrees of freedom, real sensors, ten flights each, 10 s at each distance, the last 5 s measured. Distances are from
the propellers to the ceiling, R is their radius. sd: over all flights and instants; oscillation: about each flight's own mean.
Each row: fly SCENARIO --controller CONTROLLER --integrator rk4 --from 1 --to 10, with what its table's head sets.

T
for scenario in test-flight close-flight; do
  [ $scenario = test-flight ] || echo
  echo "$scenario"
  table $scenario
done >$out/tables.txt
cat $out/tables.txt

for controller in indi indi-rbf indi-learned; do
  mean $controller
  say "pictures, $controller"
  fly close-flight --controller $controller --seed 1 --log $out/close.$controller.csv >/dev/null
done
rm -f $out/log.csv $out/logs.csv $out/means.txt

# Each seed learns from nothing: its curve, as gnuplot variables of a function of the distance.
say "pictures, learning"
fly learning-flight --from 1 --to $seeds --json $out/learned.jsonl >$out/learned.txt
lines $out/learned.jsonl
sed 's/.*"weights":\[\([^]]*\)\].*/\1/' $out/learned.jsonl >$out/learned.weights
fitted=$("$o/fly" --params | awk '/^ceil\.w[1-7]/ { printf "%s%s", comma, $2; comma = "," }')
[ ! -t 2 ] || printf '\r  %-48s\r' '' >&2

cd $out
# name CONTROLLER: as people call it.
name() {
  case $1 in
  indi) echo 'standard INDI' ;;
  indi-rbf) echo 'INDI with the RBF fitted to the theory' ;;
  indi-learned) echo 'INDI with the learned RBF' ;;
  esac
}
figure=9
for controller in indi indi-rbf indi-learned; do
  gnuplot <<G
set terminal pngcairo size 1000,560 font "Sans,13"
set output "figure_$figure.png"
set title "Test flight, $(name $controller): mean and one standard deviation of $seeds flights (thesis figure $figure)"
set xlabel "time, s"; set ylabel "height of the propellers, m"
set xrange [20:42]; set yrange [0.40:0.51]
set grid lc rgb "#dddddd"; set border 3; set tics nomirror; set key at graph 0.02,0.86 left Left reverse
plot "mean.$controller.txt" u 1:(\$2-\$3):(\$2+\$3) w filledcurves lc rgb "#9ecae1" t "one standard deviation", \
     "" u 1:2 w l lw 2 lc rgb "#08519c" t "mean", "" u 1:4 w steps lw 2 dt 2 lc rgb "#333333" t "command", \
     "" u 1:5 w l lw 2 lc rgb "#d55e00" t "ceiling, estimated", "" u 1:6 w l lw 3 lc rgb "#555555" t "ceiling"
G
  figure=$((figure + 1))
done

gnuplot <<G
load "$here/tools/curves.gp"
set terminal pngcairo size 1000,560 font "Sans,13"
set output "figure_12.png"
set title "The learned curve of $seeds learning flights beside the theory (thesis figure 12)"
set xlabel "distance to the ceiling, m"; set ylabel "thrust ratio"
set xrange [0:0.11]; set yrange [0.9:1.5]; set samples 500
set grid lc rgb "#dddddd"; set border 3; set tics nomirror
plot $(awk '{ printf "rbf(x,%s) w l lc rgb \"#56b4e9\" %s, ", $0, NR == 1 ? "t \"learned, real sensors\"" : "notitle" }' learned.weights) \
     theory(x) w l lw 2 lc rgb "#555555" t "ceiling effect of the plant", \
     rbf(x,$fitted) w l lw 2 dt 4 lc rgb "#d55e00" t "RBF fitted to it"
G

# close TERMINAL FILE: figure 13.
close() {
  gnuplot <<G
set terminal $1
set output "$2"
set datafile separator ","
set key autotitle columnhead
set title "Close flight, one flight of each controller (thesis figure 13)"
set xlabel "time, s"; set ylabel "height of the propellers, m"
set xrange [30:62]; set yrange [0.41:0.505]
set border 3; set tics nomirror; set key at graph 0.02,0.86 left Left reverse
$3
plot "close.indi.csv" u (\$1/1e3):"sim.z" w l lw 2 lc rgb "#d55e00" t "standard INDI", \
     "close.indi-rbf.csv" u (\$1/1e3):"sim.z" w l lw 2 lc rgb "#0072b2" t "RBF fitted to the theory", \
     "close.indi-learned.csv" u (\$1/1e3):"sim.z" w l lw 2 lc rgb "#000000" t "learned RBF", \
     "close.indi.csv" u (\$1/1e3):(column("sim.z")+column("sim.gap")) w l lw 3 lc rgb "#555555" t "ceiling"
G
}
close 'pngcairo size 1000,560 font "Sans,13"' figure_13.png 'set grid lc rgb "#dddddd"'
close 'dumb noenhanced mono size 112,26' figure_13.txt ''
echo
sed -e 's/[[:space:]]*$//' -e '/./,$!d' figure_13.txt
echo
echo "pictures:"
ls ./*.png | sed "s#^\./#  $out/#"
