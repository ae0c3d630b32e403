#!/bin/sh
# run.sh PACKAGES WORD - the tests of tools/cf.py whose name has WORD ("": all), over a fake link with the stock
# cflib. Where it cannot be had, those that need none.
cd "$(dirname "$0")/../.." || exit 1
export PYTHONDONTWRITEBYTECODE=1
export OPENBLAS_NUM_THREADS=1 # its threads wait for each other thirty times longer than these small fits take
which='test_*.py'
if tools/setup.sh $1 && tools/cf/venv.sh; then
  python=${O:-out}/cf/bin/python
  [ -d "${FIRMWARE_TREE:-.}/src/firmware" ] || echo "skipped: no src/firmware, so nothing is declared"
else
  python=python3
  which=test_dry.py
  echo "skipped: no cflib"
fi
"$python" -m unittest discover -s test/cf -p "$which" ${2:+-k "$2"}
