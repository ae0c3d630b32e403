#!/bin/sh
# gap_seeds.sh - the README's example on other seeds: what is said where a ceiling alone is hidden, and where nothing is.
set -eu
o=${O:-out}
out=$o/seeds
rm -rf $out
mkdir -p $out
{ echo 'ceiling_m = 0.5 # of the simulated room'; cat sim/vehicle/vehicles/cf21_legacy.toml; } >$out/vehicle.toml
: >$out/table
for hidden in nothing exponential square-root; do
  effect=
  [ $hidden = nothing ] || effect="--effect ceiling:form=$hidden"
  for set in 1 2 3 4 5 6 7 8; do
    [ ! -t 2 ] || printf '\r  %s, set %d of 8 ' $hidden $set >&2
    for k in 1 2 3 4; do
      # shellcheck disable=SC2086
      "$o/fly" test-flight --controller indi-theory --effect none --effect rotor_drag:k=1.7e-6 $effect \
        --seed $((1000 * set + k)) --log "$out/flight$k.csv" --log-rate 500 >/dev/null
    done
    for cut in whole airborne; do
      [ $cut = whole ] || for k in 1 2 3 4; do
        awk -F, 'NR == 1 || $1 > 7000' "$out/flight$k.csv" >"$out/cut$k.csv" && mv "$out/cut$k.csv" "$out/flight$k.csv"
      done
      "$o/gap" --vehicle $out/vehicle.toml --columns tools/columns/fly.toml $out/flight?.csv >$out/said
      awk -v hidden=$hidden -v cut=$cut '
        /^Missing/ { sub(/.*: /, ""); sub(/\.$/, ""); names = $0 }
        /^Something/ { names = "no name, something unknown" }
        /^Nothing/ { names = "nothing" }
        END { sub(", and something that has no name", " + unknown", names); print hidden ", " cut ": " names }' $out/said >>$out/table
    done
  done
done
[ ! -t 2 ] || printf '\r%30s\r' '' >&2
sort $out/table | uniq -c | awk '{ n = $1; sub(/^ *[0-9]+ /, ""); split($0, part, ": "); printf "%-24s %-44s %d of 8\n", part[1], part[2], n }'
