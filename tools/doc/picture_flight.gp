# picture_flight.gp - the distance to the ceiling, one flight with the ceiling term and one without it.
load "style.gp"
set terminal svg size 860,400 font "sans-serif,14" background "#ffffff"
set title "Steps to 2 cm below a ceiling, six degrees of freedom, noise of real sensors (simulated)"
set xlabel "time, s"
set ylabel "propellers below the ceiling, cm"
set xrange [30:60]
set yrange [9:0]
set key top left Left reverse
gap(x) = 100 * x
# What is ordered counts from the vehicle at rest, whose propellers are 3 cm over the floor.
ordered(x) = 100 * (0.5 - 0.03 - x)
every_100_ms = 10
plot "indi.csv" every every_100_ms u ($1/1e3):(ordered(column("ctrltarget.z"))) w steps lw 1.5 dt 2 lc rgb "#555555" t "ordered", \
     "indi.csv" every every_100_ms u ($1/1e3):(gap(column("sim.gap"))) w l lw 2 lc rgb "#d55e00" t "standard INDI", \
     "indi-theory.csv" every every_100_ms u ($1/1e3):(gap(column("sim.gap"))) w l lw 2 lc rgb "#0072b2" t "with the ceiling term"
