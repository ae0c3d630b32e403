#!/bin/sh
# outside.sh SEED SETS PACKAGES - flies vehicles of rotorpy, diagnoses them with `gap`, and marks the answers: out/flown_outside (in $O).
# Skips with one line where rotorpy cannot be had.
cd "$(dirname "$0")/.." || exit 1
o=${O:-out} seed=$1 sets=$2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
install() {
  [ -x "$o/outside/bin/python" ] && cmp -s tools/outside/requirements.txt "$o/outside/has" && return
  python3 -m venv --clear "$o/outside" >"$log" 2>&1 &&
    "$o/outside/bin/python" -m pip install --disable-pip-version-check --retries 1 -r tools/outside/requirements.txt \
      >>"$log" 2>&1 && cp tools/outside/requirements.txt "$o/outside/has"
}
if ! tools/setup.sh "$3" || ! install; then
  echo "skipped: no $(head -n 1 tools/outside/requirements.txt) ($(tail -n 1 "$log"))"
  exit 0
fi
rm -rf "$o/flown_outside"
mkdir -p "$o/flown_outside"
PYTHONDONTWRITEBYTECODE=1 python3 -m unittest discover -q -s test/outside || exit 1
# One thread for numpy, because the sets are flown side by side.
OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONDONTWRITEBYTECODE=1 \
  "$o/outside/bin/python" tools/outside/outside.py "$seed" "$sets" "$o/gap" "$o/flown_outside"
