#!/bin/sh
# plots.sh DIR - draws what demo.sh flew into DIR.
set -eu
here=$PWD
cd "$1"

# The learned weights of fly's output as gnuplot variables.
weights() { awk '/ceil\.w/ { printf "w%d=%s;", ++n, $NF }' "$1"; }

cat >style.gp <<G
set terminal pngcairo size 1000,640 font "Sans,13"
set datafile separator ","
set datafile missing "nan"
set key autotitle columnhead
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
load "$here/tools/curves.gp"
G

for cutoff in 0 8; do
  [ $cutoff = 0 ] && signals='signals not filtered' || signals='8 Hz filter'
  cat >height.gp <<G
load "style.gp"
set output "height_$cutoff.png"
set title "Thesis appendix A, $signals: step to 2 cm below the ceiling"
set xlabel "time, s"; set ylabel "height, m"
set xrange [18:40]; set yrange [0.42:0.505]
set key bottom right
set arrow from 18,0.5 to 40,0.5 nohead lw 3 lc rgb "#555555"
set label "ceiling" at 18.3,0.5025
plot "a5_$cutoff.csv" u (\$1/1e3):"ctrltarget.z" w steps lc rgb "#999999" dt 2 t "set point", \
     "a4_$cutoff.csv" u (\$1/1e3):"sim.z" w l lw 2 lc rgb "#009e73" t "no ceiling effect (A.4)", \
     "a5_$cutoff.csv" u (\$1/1e3):"sim.z" w l lw 2 lc rgb "#d55e00" t "standard INDI (A.5)", \
     "a8_$cutoff.csv" u (\$1/1e3):"sim.z" w l lw 2 lc rgb "#0072b2" t "theory, lead 0.3 s (A.8)", \
     "a10_$cutoff.csv" u (\$1/1e3):"sim.z" w l lw 2 dt 4 lc rgb "#cc79a7" t "fitted RBF (A.10)", \
     "learned_$cutoff.csv" u (\$1/1e3):"sim.z" w l lw 2 dt 2 lc rgb "#000000" t "learned RBF"
G
  gnuplot height.gp
done

cat >curve.gp <<G
load "style.gp"
$(weights learning.txt)
set output "curve.png"
set title "Thrust ratio learned in a simulated flight (10 to 2 cm, noise N1)"
set xlabel "distance to the ceiling, m"; set ylabel "thrust ratio"
set xrange [0:0.11]; set yrange [0.85:1.5]
set samples 500
plot "learning.csv" u "ceil.zc":"rls.y" w p pt 7 ps 0.25 lc rgb "#56b4e9" t "measured in flight", \
     theory(x) w l lw 2 lc rgb "#555555" t "ceiling effect of the plant", \
     rbf(x,1.43142386,0.15021046,-0.09754395,-0.07601899,-0.26694495,-0.30407099,-0.37406497) \
       w l lw 2 dt 4 lc rgb "#cc79a7" t "RBF fitted to it", \
     [0:0.11] rbf(x,w1,w2,w3,w4,w5,w6,w7) w l lw 2 lc rgb "#d55e00" t "RBF learned, from nothing"
G
gnuplot curve.gp

# history FILE.png COLUMN-PREFIX TITLE LABEL FIRST: seven columns over time, FIRST taken off the first.
history() {
  {
    echo 'load "style.gp"'
    echo "set output \"$1\"; set title \"$3\"; set xlabel \"time, s\"; set ylabel \"$4\"; set key outside right"
    echo "set xrange [0:60]"
    printf 'plot '
    for i in 1 2 3 4 5 6 7; do
      [ $i = 1 ] || printf ', '
      off=0 name=$2$i
      [ $i = 1 ] && [ "$5" != 0 ] && off=$5 name="$2$i - $5"
      printf '"learning.csv" u ($1/1e3):(column("rls.%s%d") - %s) w l lw 2 t "%s"' "$2" $i $off "$name"
    done
    echo
  } >history.gp
  gnuplot history.gp
}
history weights.png w "Weights while they are learned" "weight" 1
history covariance.png p "Variance of the weights: it falls when the flight comes near a centre" "variance" 0

if [ -f ground_points.csv ]; then
  cat >ground.gp <<G
load "style.gp"
$(tr -d '[:space:]' <ground.json | sed -E 's/.*"weights":\[([^]]*)\].*/\1/' | awk -F, '{ for (i = 1; i <= 7; i++) printf "w%d=%s;", i, $i }')
set output "ground.png"
set title "Thrust ratio over the ground, learned from two real flights"
set xlabel "clearance, m"; set ylabel "thrust ratio"
set xrange [0:0.2]; set yrange [0.85:1.3]
set samples 500
plot "ground_points.csv" u "distance_m":"ratio" w p pt 7 ps 0.25 lc rgb "#56b4e9" t "measured", \
     1 w l lc rgb "#999999" t "free air", \
     rbf(x,w1,w2,w3,w4,w5,w6,w7) w l lw 3 lc rgb "#d55e00" t "learned"
G
  gnuplot ground.gp
fi
rm -f ./*.gp
