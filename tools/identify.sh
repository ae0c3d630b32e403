#!/bin/sh
# identify.sh [DATA] - what out/effectiveness makes of a simulated flight, and of the firmware's own log where it is at hand.
set -eu
DATA=${1:-} o=${O:-out}
. tools/typed.sh

typed "$o/fly inner-loop --log $o/shaken.csv --log-rate 500 >$o/shaken.txt"
for options in '--lag 0.08 --delay 0.006' '--lag 0.08'; do
  typed "$o/effectiveness $o/shaken.csv $options"
  echo
done
if [ -n "$DATA" ]; then
  # shellcheck disable=SC2016 # the folder is the reader's
  typed "$o/effectiveness "'"$DATA/inner_loop_id/data_1901.csv" --as-stock'
else
  echo "$o/effectiveness data_1901.csv --as-stock: skipped, no measured data"
fi
