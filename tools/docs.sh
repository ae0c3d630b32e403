#!/bin/sh
# docs.sh [DATA] - writes the generated parts of README.md: what stands between `<!-- NAME -->` and `<!-- end -->`.
set -eu
data=${1:-}

. tools/part.sh

got=$(mktemp)
trap 'rm -f "$got"' EXIT

out/fly --params=markdown >"$got"
part params <"$got"
out/fly --logs >"$got"
part logs <"$got"
tools/report.sh
tools/cf.py test-flight --dry-run | text | part cf
tools/demo.sh "$data" >"$got"
sed -E '/^pictures/,$d; s#/[^ ]*/##' "$got" | sed '$d' | text | part demo
tools/gap_demo.sh "$data" >"$got"
text <"$got" | part gap
[ -z "$data" ] || tools/recorded.sh "$data" | text | part recorded
tools/gap_seeds.sh >"$got"
text <"$got" | part seeds
tools/add_effect.sh >"$got"
text <"$got" | part cable
out/bench >"$got"
text <"$got" | part bench
for gains in '1 5' '2 8'; do
  set -- $gains
  out/fly closest-hover --set indiPos.kp="$1" --set indiPos.kd="$2" >"$got.gains"
  awk -v g="$1, $2" '$1 == "gap" && $NF == 0 { nearest = $2 } END { printf "gains %s: %s mm\n", g, nearest }' "$got.gains"
done >"$got"
rm -f "$got.gains"
text <"$got" | part closest
tools/flights.sh >"$got"
sed -E '/^pictures/,$d' "$got" | sed '$d' | text | part flights
tools/identify.sh "$data" >"$got"
text <"$got" | part identify
tools/touches.sh >"$got"
text <"$got" | part touches
out/exam 80001 200 >"$got"
text <"$got" | part exam
out/slot "$data" >"$got"
text <"$got" | part slot
out/fly bias-hover --integrator rk4 >"$got"
sed -n -i '/^bias$/,/^contacts/p' "$got"
out/fly hand-held >>"$got"
sed -e '/^contacts/d' -e 's/^bias$/bias-hover/' -e 's/^ceiling_height$/hand-held/' "$got" | text | part c3
FAULTS_TABLE=1 TEST_LONG=1 out/release/bin/tests faults_of_the_list >"$got"
grep -v -e ' 100\.0 ' -e 'passed' -e 'FAILED' -e 'is false' "$got" | text | part faults
