#!/bin/sh
# report.sh - writes the image's size (of the last `make firmware`) and the target's figures (make pil) into README.md.
set -eu
part() {
  new=$(mktemp)
  awk -v start="<!-- $1 -->" -v body="$(echo '```'; cat; echo '```')" '
    $0 == start { print; print body; skip = 1; found = 1; next }
    $0 == "<!-- end -->" { skip = 0 }
    !skip { print }
    END { exit !found }' README.md >"$new" || { echo "report.sh: README.md has no part $1" >&2; exit 1; }
  cat "$new" >README.md
  rm -f "$new"
}
if [ -f out/firmware/size ]; then
  part image <out/firmware/size
else
  echo "the image's size stays as it is: make firmware was not run" >&2
fi
tools/pil.sh >out/pil.txt
if grep -q '^skipped' out/pil.txt; then cat out/pil.txt >&2; else part pil <out/pil.txt; fi
