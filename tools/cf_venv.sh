#!/bin/sh
# cf_venv.sh - makes out/cf (in $O), a Python environment with the stock cflib. Fails where it cannot be had.
cd "$(dirname "$0")/.." || exit 1
o=${O:-out}
has() { [ -x "$o/cf/bin/python" ] && cmp -s tools/cf/requirements.txt "$o/cf/has"; }
has && exit 0
mkdir -p "$o"
log=$(mktemp)
if python3 -m venv --clear "$o/cf" >"$log" 2>&1 &&
  "$o/cf/bin/python" -m pip install --disable-pip-version-check --retries 1 -r tools/cf/requirements.txt >>"$log" 2>&1; then
  cp tools/cf/requirements.txt "$o/cf/has"
  rm -f "$log"
else
  tail -3 "$log" >&2
  rm -f "$log"
  echo "could not install $(cat tools/cf/requirements.txt)" >&2
  exit 1
fi
