#!/bin/sh
# venv.sh - makes out/cf (in $O), a Python environment with the stock cflib and cfloader. Fails where it cannot be had.
cd "$(dirname "$0")/../.." || exit 1
o=${O:-out}
# cfloader is part of the client's package, and needs none of the GUI packages that the rest of it needs.
wanted() { cat tools/cf/requirements.txt tools/cf/loader.txt; }
has() { [ -x "$o/cf/bin/python" ] && wanted | cmp -s - "$o/cf/has"; }
has && exit 0
mkdir -p "$o"
log=$(mktemp)
install() { "$o/cf/bin/python" -m pip install --disable-pip-version-check --retries 1 "$@" >>"$log" 2>&1; }
if python3 -m venv --clear "$o/cf" >"$log" 2>&1 && install -r tools/cf/requirements.txt &&
  install --no-deps -r tools/cf/loader.txt; then
  wanted >"$o/cf/has"
  rm -f "$log"
else
  tail -3 "$log" >&2
  rm -f "$log"
  echo "could not install $(wanted | tr '\n' ' ')" >&2
  exit 1
fi
