#!/bin/sh
# run.sh PACKAGES WORD - the tests of the desk's page whose name has WORD ("": all), in a Chromium without a window; skipped
# where there is none.
cd "$(dirname "$0")/../.." || exit 1
export PYTHONDONTWRITEBYTECODE=1
if ! command -v chromium >/dev/null && ! tools/setup.sh $1; then
  echo "skipped: no Chromium"
  exit 0
fi
# The library that takes off; those tests that need it are skipped without.
tools/cf/venv.sh && python=${O:-out}/cf/bin/python || python=python3
"$python" -m unittest discover -s test/desk -p 'test_*.py' ${2:+-k "$2"}
