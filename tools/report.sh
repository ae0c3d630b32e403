#!/bin/sh
# report.sh - writes the image's size (of the last `make firmware`) and the target's figures (make pil) into README.md.
set -eu
. tools/part.sh
if [ -f out/firmware/size ]; then
  text <out/firmware/size | part image
else
  echo "the image's size stays as it is: make firmware was not run" >&2
fi
tools/pil.sh >out/pil.txt
if grep -q '^skipped' out/pil.txt; then cat out/pil.txt >&2; else text <out/pil.txt | part pil; fi
