#!/bin/sh
# setup.sh PACKAGE... - installs the Debian packages that are missing, or says how to.
missing=
for package in "$@"; do
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)
  [ "$status" = "install ok installed" ] || missing="$missing $package"
done
[ -z "$missing" ] && exit 0

if [ "$(id -u)" = 0 ]; then
  as_root=
elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
  as_root=sudo
else
  echo "packages are missing; type this once, then run make again:" >&2
  echo "  sudo sh -c 'apt-get update && apt-get install --no-install-recommends$missing'" >&2
  exit 1
fi
echo "installing$missing"
log=$(mktemp)
if $as_root apt-get update >"$log" 2>&1 &&
  DEBIAN_FRONTEND=noninteractive $as_root apt-get install -y --no-install-recommends $missing >>"$log" 2>&1; then
  rm -f "$log"
else
  tail -5 "$log" >&2
  echo "could not install$missing; the whole log is in $log" >&2
  exit 1
fi
