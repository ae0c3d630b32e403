# ground.gp - what two real flights over the ground learned.
load "style.gp"
load "curves.gp"
set terminal pngcairo size 1000,640 font "Sans,13"
set output "ground.png"
set title "Thrust ratio over the ground, learned from two real flights"
set xlabel "clearance, m"; set ylabel "thrust ratio"
set xrange [0:0.2]; set yrange [0.85:1.3]
set samples 500
plot "ground_points.csv" u "distance_m":"ratio" w p pt 7 ps 0.25 lc rgb "#56b4e9" t "measured", \
     1 w l lc rgb "#999999" t "free air", \
     rbf(x,learned,1) w l lw 3 lc rgb "#d55e00" t "learned"
