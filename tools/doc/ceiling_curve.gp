# ceiling_curve.gp - what the workflow found of the ceiling, in letters on standard output.
load "style.gp"
unset grid
set terminal dumb noenhanced mono size 100,22
set xlabel "ceiling distance, m"
set title "What the ceiling adds to the vertical specific force, m/s2 (report.html, held-out flight)"
set border 3; plot "ceiling.csv" u "at":"adds" w l t "named effect", "" u "at":"measured" w p pt 7 t "measured"
