#!/bin/sh
# report.sh - writes the image's size (of the last `make firmware`) and the target's figures (make pil) into the READMEs.
set -eu
o=${O:-out}
. tools/part.sh
if [ -f "$o/firmware/size" ]; then
  text <"$o/firmware/size" | part image
else
  echo "the image's size stays as it is: make firmware was not run" >&2
fi
test/pil/pil.sh >"$o/pil.txt"
if grep -q '^skipped' "$o/pil.txt"; then cat "$o/pil.txt" >&2; else text <"$o/pil.txt" | part pil; fi
