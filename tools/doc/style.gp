# style.gp - what all pictures share: logs of the programs, and how axes look.
set datafile separator ","
set datafile missing "nan"
set key autotitle columnhead
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
