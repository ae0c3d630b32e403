#!/bin/sh
# identify.sh [DATA] - what out/effectiveness makes of a simulated flight, and of the firmware's own log where it is at hand.
set -eu
data=${1:-}
log=$(mktemp)
trap 'rm -f "$log"' EXIT

out/fly inner-loop --integrator rk4 --log "$log" --log-rate 500 >/dev/null
for options in '--lag 0.08 --delay 0.006' '--lag 0.08'; do
  echo "\$ effectiveness flight.csv $options"
  out/effectiveness "$log" $options
  echo
done
echo '$ effectiveness data_1901.csv --as-stock'
if [ -n "$data" ]; then
  out/effectiveness "$data/inner_loop_id/data_1901.csv" --as-stock
else
  echo 'skipped, no measured data'
fi
