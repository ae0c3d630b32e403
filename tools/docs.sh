#!/bin/sh
# docs.sh [DATA] - writes the generated parts of every README.md: what stands between `<!-- NAME -->` and `<!-- end -->`.
set -eu
data=${1:-} o=${O:-out}

. tools/part.sh
. tools/typed.sh

got=$(mktemp)
trap 'rm -f "$got"' EXIT

$o/fly --params=markdown >"$got"
part params <"$got"
$o/fly --logs >"$got"
part logs <"$got"
tools/report.sh
typed 'tools/cf.py test-flight --dry-run' | text | part cf
tools/demo.sh "$data" >"$got"
sed -E '/^pictures/,$d; s#/[^ ]*/##' "$got" | sed '$d' | text | part demo
tools/gap_demo.sh "$data" >"$got"
sed -E 's/, [0-9]+ x real time//' "$got" | text | part gap
[ -z "$data" ] || tools/recorded.sh "$data" | text | part recorded
tools/gap_seeds.sh >"$got"
text <"$got" | part seeds
tools/add_effect.sh >"$got"
text <"$got" | part cable
$o/bench >"$got"
text <"$got" | part bench
for gains in '1 5' '2 8'; do
  set -- $gains
  # shellcheck disable=SC2016 # awk's own
  typed "$o/fly closest-hover --set indiPos.kp=$1 --set indiPos.kd=$2 |"' awk '"'"'$1 == "gap" && $NF == 0 { mm = $2 } END { print mm " mm" }'"'"
done >"$got"
text <"$got" | part closest
tools/flights.sh >"$got"
sed -E '/^pictures/,$d' "$got" | sed '$d' | text | part flights
tools/identify.sh "$data" >"$got"
text <"$got" | part identify
tools/touches.sh >"$got"
text <"$got" | part touches
$o/exam 80001 200 >"$got"
text <"$got" | part exam
$o/slot "$data" >"$got"
text <"$got" | part slot
typed "$o/fly bias-hover | sed -n '/^bias/,/^contacts/{/^contacts/!p}'" >"$got"
typed "$o/fly hand-held | sed -n '/^ceiling_height/,/^contacts/{/^contacts/!p}'" >>"$got"
text <"$got" | part c3
FAULTS_TABLE=1 TEST_LONG=1 $o/release/bin/tests faults_of_the_list >"$got"
grep -v -e ' 100\.0 ' -e 'passed' -e 'FAILED' -e 'is false' "$got" | text | part faults
