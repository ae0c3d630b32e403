#!/bin/sh
# pictures.sh - draws the READMEs' pictures into .doc: a flight, a diagnosis (of the last `make demo`), the rooms.
set -eu
o=${O:-out}
dir=$o/pictures
mkdir -p "$dir"
for controller in indi indi-theory; do
  "$o/fly" close-flight --controller $controller --integrator rk4 --seed 1 --log "$dir/$controller.csv" >/dev/null
done
gnuplot -e "to='.doc/flight.svg'; from='$dir'" tools/doc/picture_flight.gp
gnuplot -e "to='.doc/diagnosis.svg'; from='$o/demo/gap/ceiling.csv'" tools/doc/picture_diagnosis.gp
PYTHONDONTWRITEBYTECODE=1 python3 tools/lint/arrows.py --svg >.doc/rooms.svg
