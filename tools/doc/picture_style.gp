# picture_style.gp - what the READMEs' pictures share; to: the file to write.
set terminal svg size 860,400 font "sans-serif,14" background "#ffffff"
set output to
set datafile separator ","
set datafile missing "nan"
set key autotitle columnhead
set grid lc rgb "#dddddd"
set border 3
set tics nomirror
