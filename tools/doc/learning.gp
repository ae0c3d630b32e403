# learning.gp - what a simulated flight learned (learned): the curve, and the weights and their variances over time.
load "style.gp"
load "curves.gp"
set terminal pngcairo size 1000,640 font "Sans,13"
fitted = "1.43142386 0.15021046 -0.09754395 -0.07601899 -0.26694495 -0.30407099 -0.37406497"

set output "curve.png"
set title "Thrust ratio learned in a simulated flight (10 to 2 cm, noise N1)"
set xlabel "distance to the ceiling, m"; set ylabel "thrust ratio"
set xrange [0:0.11]; set yrange [0.85:1.5]
set samples 500
plot "learning.csv" u "ceil.zc":"rls.y" w p pt 7 ps 0.25 lc rgb "#56b4e9" t "measured in flight", \
     theory(x) w l lw 2 lc rgb "#555555" t "ceiling effect of the plant", \
     rbf(x,fitted,1) w l lw 2 dt 4 lc rgb "#cc79a7" t "RBF fitted to it", \
     rbf(x,learned,1) w l lw 2 lc rgb "#d55e00" t "RBF learned, from nothing"

set xlabel "time, s"; set key outside right
set xrange [0:60]; set yrange [*:*]
set output "weights.png"
set title "Weights while they are learned"; set ylabel "weight"
plot for [i=1:7] "learning.csv" u ($1/1e3):(column("rls.w".i) - (i == 1)) w l lw 2 t "w".i.(i == 1 ? " - 1" : "")
set output "covariance.png"
set title "Variance of the weights: it falls when the flight comes near a centre"; set ylabel "variance"
plot for [i=1:7] "learning.csv" u ($1/1e3):(column("rls.p".i)) w l lw 2 t "p".i
