#!/bin/sh
# touches.sh [FLIGHTS] - how often the thesis's flights touch the ceiling: many seeds of each, real noise.
set -eu
flights=${1:-1000}
o=${O:-out}
out=$o/touches
mkdir -p $out

# touching DISTANCE_M FILE: flights that touched while that far below the ceiling was commanded, and all.
touching() {
  awk -v wanted="$1" '
    { ceiling = number($0, "ceiling_m"); n = split($0, part, "}")
      for (i = 1; i <= n; i++)
        if (index(part[i], "\"setpoint_m\"")) {
          d = ceiling - number(part[i], "setpoint_m") - wanted
          if (d < 1e-6 && d > -1e-6) { seen++; hit += number(part[i], "contacts") > 0 }
        } }
    function number(s, key) {
      if (!match(s, "\"" key "\":-?[0-9.e+-]*")) exit failed = 1
      return substr(s, RSTART + length(key) + 3, RLENGTH - length(key) - 3) + 0
    }
    END { if (failed || seen != NR || NR == 0) exit 1; printf "%d of %d", hit, NR }' "$2"
}

# row DISTANCE_M SCENARIO CONTROLLER OPTIONS...
row() {
  distance=$1 scenario=$2 controller=$3
  shift 3
  [ ! -t 2 ] || printf '\r  flying %-50s' "$scenario, $controller" >&2
  "$o/fly" "$scenario" --controller "$controller" "$@" --integrator rk4 --from 1 --to $flights --json $out/all.jsonl >/dev/null
  share=$(touching "$distance" $out/all.jsonl) || { echo "touches.sh: $out/all.jsonl: not what was asked for" >&2; exit 1; }
  [ ! -t 2 ] || printf '\r%-60s\r' '' >&2
  printf '%-13s %-13s %4.0f mm  %-13s  %s\n' "$scenario" "$controller" "$(echo "$distance" | awk '{ print 1e3 * $1 }')" "$share" "$*" |
    sed 's/ *$//'
}

"$o/fly" close-flight --integrator rk4 | sed -n 's/^parameters .*/&; the second row: motors as the thesis has them/p'
echo 'flight        controller    ordered  touched there  besides'
row 0.03 test-flight indi
row 0.03 test-flight indi --effect motor_lag:add=-0.0175 --set indiPos.tauMot=0.0625
for controller in indi-theory indi-rbf indi-learned; do
  row 0.02 close-flight $controller
done
