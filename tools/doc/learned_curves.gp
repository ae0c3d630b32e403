# learned_curves.gp - the curve of each learning flight (learned, one text of all weights), thesis figure 12.
load "style.gp"
load "curves.gp"
set terminal pngcairo size 1000,560 font "Sans,13"
set output "figure_12.png"
set title sprintf("The learned curve of %d learning flights beside the theory (thesis figure 12)", flights)
set xlabel "distance to the ceiling, m"; set ylabel "thrust ratio"
set xrange [0:0.11]; set yrange [0.9:1.5]; set samples 500
plot for [n=1:flights] rbf(x,learned,n) w l lc rgb "#56b4e9" t (n == 1 ? "learned, real sensors" : ""), \
     theory(x) w l lw 2 lc rgb "#555555" t "ceiling effect of the plant", \
     rbf(x,fitted,1) w l lw 2 dt 4 lc rgb "#d55e00" t "RBF fitted to it"
