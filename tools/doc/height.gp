# height.gp - appendix A of the thesis, flights with one filter (cutoff, signals).
load "style.gp"
set terminal pngcairo size 1000,640 font "Sans,13"
set output "height_".cutoff.".png"
set title "Thesis appendix A, ".signals.": step to 2 cm below the ceiling"
set xlabel "time, s"; set ylabel "height, m"
set xrange [18:40]; set yrange [0.42:0.505]
set key bottom right
set arrow from 18,0.5 to 40,0.5 nohead lw 3 lc rgb "#555555"
set label "ceiling" at 18.3,0.5025
of(name) = name."_".cutoff.".csv"
plot of("a5") u ($1/1e3):"ctrltarget.z" w steps lc rgb "#999999" dt 2 t "set point", \
     of("a4") u ($1/1e3):"sim.z" w l lw 2 lc rgb "#009e73" t "no ceiling effect (A.4)", \
     of("a5") u ($1/1e3):"sim.z" w l lw 2 lc rgb "#d55e00" t "standard INDI (A.5)", \
     of("a8") u ($1/1e3):"sim.z" w l lw 2 lc rgb "#0072b2" t "theory, lead 0.3 s (A.8)", \
     of("a10") u ($1/1e3):"sim.z" w l lw 2 dt 4 lc rgb "#cc79a7" t "fitted RBF (A.10)", \
     of("learned") u ($1/1e3):"sim.z" w l lw 2 dt 2 lc rgb "#000000" t "learned RBF"
