# picture_diagnosis.gp - what a held-out flight shows over the distance to the ceiling, before and after.
load "style.gp"
set terminal svg size 860,400 font "sans-serif,14" background "#ffffff"
set title "A ceiling effect that the vehicle file lacks: found in three simulated flights, shown on a fourth"
set xlabel "distance to the ceiling, cm"
set ylabel "measured less predicted, m/s^2"
set yrange [-0.05:*]
set key top right
cm(x) = 100 * x
plot "ceiling.csv" u (cm(column("at"))):"low":"high" w filledcurves lc rgb "#cfe3f2" t "95 % interval", \
     "" u (cm(column("at"))):"adds" w l lw 2 lc rgb "#0072b2" t "ceiling, as named", \
     "" u (cm(column("at"))):"before" w p pt 7 ps 0.8 lc rgb "#d55e00" t "before", \
     "" u (cm(column("at"))):"after" w p pt 7 ps 0.8 lc rgb "#009e73" t "after"
