# mean_flight.gp - the test flights of one controller (who, as people call it: name), thesis figures 9 to 11 (figure).
load "style.gp"
set terminal pngcairo size 1000,560 font "Sans,13"
set output sprintf("figure_%d.png", figure)
set title sprintf("Test flight, %s: mean and one standard deviation of %d flights (thesis figure %d)", name, flights, figure)
set xlabel "time, s"; set ylabel "height of the propellers, m"
set xrange [20:42]; set yrange [0.40:0.51]
set key at graph 0.02,0.86 left Left reverse
plot "mean.".who.".csv" u 1:($2-$3):($2+$3) w filledcurves lc rgb "#9ecae1" t "one standard deviation", \
     "" u 1:2 w l lw 2 lc rgb "#08519c" t "mean", "" u 1:4 w steps lw 2 dt 2 lc rgb "#333333" t "command", \
     "" u 1:5 w l lw 2 lc rgb "#d55e00" t "ceiling, estimated", "" u 1:6 w l lw 3 lc rgb "#555555" t "ceiling"
