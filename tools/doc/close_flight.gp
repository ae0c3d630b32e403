# close_flight.gp - one close flight of each controller, thesis figure 13: as picture, and in letters on standard output.
load "style.gp"
set terminal pngcairo size 1000,560 font "Sans,13"
set output "figure_13.png"
set title "Close flight, one flight of each controller (thesis figure 13)"
set xlabel "time, s"; set ylabel "height of the propellers, m"
set xrange [30:62]; set yrange [0.41:0.505]
set key at graph 0.02,0.86 left Left reverse
of(who) = "close.".who.".csv"
plot of("indi") u ($1/1e3):"sim.z" w l lw 2 lc rgb "#d55e00" t "standard INDI", \
     of("indi-rbf") u ($1/1e3):"sim.z" w l lw 2 lc rgb "#0072b2" t "RBF fitted to the theory", \
     of("indi-learned") u ($1/1e3):"sim.z" w l lw 2 lc rgb "#000000" t "learned RBF", \
     of("indi") u ($1/1e3):(column("sim.z")+column("sim.gap")) w l lw 3 lc rgb "#555555" t "ceiling"
unset grid
set terminal dumb noenhanced mono size 112,26
set output
replot
